// What the ego vehicle's own sensors say in a scenario: exact motion with the errors of wheel speed and yaw rate.
#ifndef SEMTRACK_SIL_WORLD_VEHICLE_MOTION_HPP
#define SEMTRACK_SIL_WORLD_VEHICLE_MOTION_HPP

#include <cstdint>
#include <map>

#include "semtrack/types.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

/// Standard deviations; the constant ones are drawn once a drive.
inline constexpr double kWheelScale = 0.005;         ///< share of the speed, constant: tyre radius
inline constexpr double kWheelNoise_mps = 0.03;      ///< from row to row
inline constexpr double kYawRateBias_radps = 0.002;  ///< constant
inline constexpr double kYawRateNoise_radps = 0.003;

/// Of every frame, by its time, as it is at that moment (not its mean since the last one). Speed of the rear axle, yaw
/// rate positive to the left; the sigmas are VehicleMotion's own. Repeatable by the scenario's seed.
[[nodiscard]] std::map<std::int64_t, VehicleMotion> vehicle_motion(const Scene& scene);

}  // namespace semtrack::sil::world

#endif
