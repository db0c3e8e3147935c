// Vehicle speed and yaw rate from SocketCAN: the message VehicleMotion of docs/can/*.dbc, end-to-end checked. Never
// waits, never fails a cycle: without news there is no motion. No thread, no heap, no exception.
#ifndef SEMTRACK_HAL_LINUX_SOCKETCAN_RX_HPP
#define SEMTRACK_HAL_LINUX_SOCKETCAN_RX_HPP

#include <array>
#include <cstdint>

#include "hal/linux/can_socket.hpp"
#include "semtrack/can_encoder.hpp"
#include "semtrack/hal/sources.hpp"
#include "semtrack/vehicle_motion_frame.hpp"

namespace semtrack::hal {

/// Only grow.
struct SocketCanRxCounters {
    std::array<std::uint32_t, static_cast<std::size_t>(kE2eStates)> frames{};  ///< by E2eState
    std::uint32_t not_available{0};  ///< the sender does not know speed or yaw rate
    std::uint32_t timeouts{0};       ///< polls at which motion had just become too old
    std::uint32_t downs{0};          ///< the interface went down or vanished
    std::uint32_t reopened{0};
};

class SocketCanRx final : public VehicleMotionSource {
public:
    /// A motion received longer ago is none.
    static constexpr std::int64_t kTimeout_us = 200000;
    /// Frames read in one poll: what a sender of 100 Hz sends in half a second, more than the time-out lets live.
    static constexpr int kMaxReads = 50;

    explicit SocketCanRx(SocketCalls& calls) : calls_(calls), socket_(calls) {}

    /// Dialect and base id as the message is sent. clock_offset_us: the images' clock minus CLOCK_REALTIME.
    [[nodiscard]] CanOpen open(const char* interface, const CanConfig& config,
                               std::int64_t clock_offset_us = 0) noexcept;
    /// kOk: the newest motion whose check was right, received at motion.time_us of the images' clock and not longer
    /// than the time-out ago. Else kNone. now_us is not used: age is that since reception.
    [[nodiscard]] SourceResult poll(std::int64_t now_us, VehicleMotion& motion) noexcept override;
    [[nodiscard]] const SocketCanRxCounters& counters() const { return counters_; }

private:
    [[nodiscard]] bool read_one(std::int64_t now_us, std::int64_t realtime_minus_monotonic_us) noexcept;
    void take(const canfd_frame& frame, int size, std::int64_t stamp_us, std::int64_t received_us) noexcept;

    SocketCalls& calls_;
    CanSocket socket_;
    CanConfig config_{};
    std::int64_t clock_offset_us_{0};
    E2eCheck check_{};
    VehicleMotion motion_{};
    std::int64_t received_us_{0};  // CLOCK_MONOTONIC
    bool fresh_{false};            // motion_ is there and not too old
    bool gone_{true};
    SocketCanRxCounters counters_{};
};

}  // namespace semtrack::hal

#endif
