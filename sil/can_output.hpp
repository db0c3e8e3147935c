// What a replay publishes: every list into can.log, and the same frames on a CAN interface when one is named. The log
// does not depend on how the bus does.
#ifndef SEMTRACK_SIL_CAN_OUTPUT_HPP
#define SEMTRACK_SIL_CAN_OUTPUT_HPP

#include <cstdio>
#include <memory>
#include <string>

#include "hal/loopback/can_log.hpp"
#include "semtrack/can_encoder.hpp"
#include "semtrack/cycle.hpp"
#include "sil/metrics/metrics_json.hpp"

namespace semtrack::sil {

class CanOutput final : public CanTx {
public:
    /// interface: empty: the log only. InputError: there is no such interface, it does not carry the dialect, or the
    /// program was built without SocketCAN.
    CanOutput(std::FILE* log, const std::string& interface, CanDialect dialect);
    ~CanOutput();
    CanOutput(const CanOutput&) = delete;
    CanOutput& operator=(const CanOutput&) = delete;

    /// Always kSent: the log takes every list.
    [[nodiscard]] Result begin_list(int frames, std::int64_t time_us) noexcept override;
    [[nodiscard]] Result send(const CanFrame& frame, std::int64_t time_us) noexcept override;
    [[nodiscard]] CanState state() const noexcept override;
    [[nodiscard]] std::uint32_t lists_lost() const noexcept override;

    /// Gives the bus up to timeout_ms for what is left of the list.
    void service(int timeout_ms);
    [[nodiscard]] bool failed() const { return log_.failed(); }
    /// Of the bus when there is one, else of the log.
    [[nodiscard]] RunCounts counts(const CycleCounters& cycle) const;
    /// One line about lists that did not get onto the bus; empty: all did.
    [[nodiscard]] std::string complaint() const;

private:
    struct Bus;
    hal::CanLog log_;
    std::string interface_;
    std::unique_ptr<Bus> bus_;
};

}  // namespace semtrack::sil

#endif
