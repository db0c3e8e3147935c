// Motion programmes turned into states per frame: the bicycle model at the rear axle, integrated in steps of 1 ms.
#ifndef SEMTRACK_SIL_WORLD_MOTION_HPP
#define SEMTRACK_SIL_WORLD_MOTION_HPP

#include <cstdint>
#include <vector>

#include "math/pose.hpp"
#include "sil/world/scenario.hpp"

namespace semtrack::sil::world {

inline constexpr std::int64_t kFrame_us = 100000;
inline constexpr double kCameraHeight_m = 1.65;
inline constexpr double kRearAxleToCamera_m = 1.7;

struct PathState {
    double x{0};  ///< N: middle of the box (ego: camera)
    double z{0};
    double heading{0};    ///< from +z towards +x, not wrapped
    double speed{0};      ///< of the rear axle, signed
    double turn_rate{0};  ///< d heading / dt, positive to the right
    double travelled{0};  ///< path length, m, for gait and bumps
};

/// One state per frame 0..frames-1. reference_m: from the rear axle forward to the point that is stated.
[[nodiscard]] std::vector<PathState> integrate(const Motion& motion, double reference_m, int frames);
/// Distance from the rear axle to the middle of the box.
[[nodiscard]] double rear_axle_to_middle(const RoadUser& user);

/// Height of the road (upwards) and its slope (rise over run along z).
[[nodiscard]] double road_height(const Street& street, double z);
[[nodiscard]] double road_slope(const Street& street, double z);

/// T_n_c: the camera 1.65 m above the road, with the bumps' pitch, roll and height.
[[nodiscard]] Pose camera_pose(const Scenario& scenario, const PathState& ego, int frame);
/// T_n_m of a road user's box (M: middle of the bottom, x forward, y left, z up).
[[nodiscard]] Pose user_pose(const Street& street, const PathState& state);

}  // namespace semtrack::sil::world

#endif
