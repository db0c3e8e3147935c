// CAN frames into a log file as candump writes it: `(SECONDS.MICROSECONDS) can0 ID#DATA`, FD `ID##1DATA` (1 = bit-rate
// switch). The time is the image's, so the same drive gives the same bytes.
#ifndef SEMTRACK_HAL_LOOPBACK_CAN_LOG_HPP
#define SEMTRACK_HAL_LOOPBACK_CAN_LOG_HPP

#include <array>
#include <cstdint>
#include <cstdio>

#include "semtrack/hal/can_tx.hpp"

namespace semtrack::hal {

/// Longest line: time 22, interface 17, id 8, "##1", 128 digits, newline.
using CanLogLine = std::array<char, 192>;

/// One line with its newline; returns its length. interface: at most 16 characters are used.
/// 0: a length that the dialect does not have, or an id beyond 11 (29 when extended) bits.
[[nodiscard]] std::size_t can_log_line(const CanFrame& frame, std::int64_t time_us, const char* interface,
                                       CanLogLine& line);

class CanLog final : public CanTx {
public:
    /// file: owned by the caller and open for writing as long as this log is used.
    explicit CanLog(std::FILE* file, const char* interface = "can0") : file_(file), interface_(interface) {}
    /// kBusOff: the file cannot be written (failed() stays true then).
    [[nodiscard]] Result send(const CanFrame& frame, std::int64_t time_us) noexcept override;
    [[nodiscard]] bool failed() const { return failed_; }

private:
    std::FILE* file_;
    const char* interface_;
    CanLogLine line_{};
    bool failed_{false};
};

}  // namespace semtrack::hal

#endif
