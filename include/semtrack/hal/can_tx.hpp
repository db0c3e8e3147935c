// Sends object lists as CAN frames: SocketCAN, a loopback or a log.
#ifndef SEMTRACK_HAL_CAN_TX_HPP
#define SEMTRACK_HAL_CAN_TX_HPP

#include <cstdint>

#include "semtrack/can_frame.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

class CanTx {
public:
    enum class Result : std::uint8_t {
        kSent,
        kBusy,         ///< no room now
        kBusOff,       ///< the controller is off the bus, or the interface is down
        kInvalidFrame  ///< a length or an id that CAN does not have, or not for this interface
    };
    /// Before the first frame of a list of `frames` frames, made for the image of time_us. kSent: the list may follow;
    /// anything else: none of it may, so that lists on the bus are whole or absent. Does not block.
    [[nodiscard]] virtual Result begin_list(int /*frames*/, std::int64_t /*time_us*/) noexcept { return Result::kSent; }
    /// Takes over one frame of the list made for the image of time_us, without blocking, and keeps no reference to it.
    /// Not kSent: the rest of the list is not to be sent; the caller counts and goes on.
    [[nodiscard]] virtual Result send(const CanFrame& frame, std::int64_t time_us) noexcept = 0;
    [[nodiscard]] virtual CanState state() const noexcept { return CanState::kActive; }
    /// Lists that were taken over and did not get onto the bus whole after all. Only grows.
    [[nodiscard]] virtual std::uint32_t lists_lost() const noexcept { return 0; }

protected:
    ~CanTx() = default;
};

}  // namespace semtrack

#endif
