// Sends CAN frames: SocketCAN, a loopback or a log.
#ifndef SEMTRACK_HAL_CAN_TX_HPP
#define SEMTRACK_HAL_CAN_TX_HPP

#include <cstdint>

#include "semtrack/can_frame.hpp"

namespace semtrack {

class CanTx {
public:
    enum class Result : std::uint8_t { kSent, kBusy, kBusOff, kInvalidFrame };
    /// Queues one frame of the list made for the image of time_us, without blocking, and keeps no reference to it.
    /// kBusy: the caller counts and goes on.
    [[nodiscard]] virtual Result send(const CanFrame& frame, std::int64_t time_us) noexcept = 0;

protected:
    ~CanTx() = default;
};

}  // namespace semtrack

#endif
