// The vehicle's own speed and yaw rate on CAN: the one message that semtrack receives (VehicleMotion in docs/can/*.dbc,
// behind the object list's: CAN id base_id + 2 in the FD dialect, base_id + 11 in the classic one; E2E data id 0x0600
// plus the same number). No heap, no exceptions, constant cost (about 64 bytes of CRC).
#ifndef SEMTRACK_VEHICLE_MOTION_FRAME_HPP
#define SEMTRACK_VEHICLE_MOTION_FRAME_HPP

#include <cstdint>

#include "semtrack/can_encoder.hpp"
#include "semtrack/can_frame.hpp"
#include "semtrack/received.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// Ranges: speed -100 to 227.67 m/s in steps of 0.005, yaw rate -3.2 to 3.3534 rad/s in steps of 0.0001, sigmas up to
/// 5.08 m/s (0.02) and 0.254 rad/s (0.001). A sender says "not available" (all ones) for a value that it does not know
/// or that lies outside its range; it never wraps or clamps.
struct VehicleMotionSignals {
    Received<double> speed{};           ///< m/s along V's x axis; negative: reversing
    Received<double> yaw_rate{};        ///< rad/s, positive to the left
    Received<double> sigma_speed{};     ///< m/s, standard deviation
    Received<double> sigma_yaw_rate{};  ///< rad/s, standard deviation
};

/// CAN id of the message for these settings (11 bits, or 29 with config.extended).
[[nodiscard]] std::uint32_t vehicle_motion_id(const CanConfig& config);

/// Checks and decodes one frame. kNoNewData: another message's frame (id or id width differ; `check` untouched).
/// `signals` is written only when the result is usable(). `check` starts as E2eCheck{} and is to be reset to that after
/// a time-out. Time of validity is the frame's reception, which the caller stamps: the message holds no time.
[[nodiscard]] E2eState decode_vehicle_motion(const CanConfig& config, const CanFrame& frame, E2eCheck& check,
                                             VehicleMotionSignals& signals);

/// What Input::motion takes: false, and `motion` untouched, unless speed and yaw rate are both there. A sigma that is
/// not available or 0 keeps VehicleMotion's default.
[[nodiscard]] bool to_vehicle_motion(const VehicleMotionSignals& signals, std::int64_t time_us, VehicleMotion& motion);

/// The sender's side, for gateways and tests. counter: one more for each frame, 0..255 (FD) or 0..14 (classic).
/// Values that are not valid, not finite or outside their range are sent as not available.
void encode_vehicle_motion(const CanConfig& config, const VehicleMotionSignals& signals, std::uint8_t counter,
                           CanFrame& frame);

}  // namespace semtrack

#endif
