// The road near the vehicle at one frame, a plane given relative to the camera in L (z up):
//   z_road(x, y) = z_c - h + s_f f + s_l l,   f, l: how far (x, y) lies ahead and to the left of the camera    [m]
#ifndef SEMTRACK_MODEL_GROUND_PLANE_HPP
#define SEMTRACK_MODEL_GROUND_PLANE_HPP

#include "math/eigen.hpp"
#include "math/pose.hpp"

namespace semtrack {

struct GroundPlane {
    bool valid{false};
    double height_m{0};                 ///< h: of the camera above the road
    double slope_forward{0};            ///< s_f: rise per metre ahead
    double slope_left{0};               ///< s_l
    Mat3 covariance{Mat3::Identity()};  ///< of (h, s_f, s_l)
};

/// The camera's axis in L, level, of length 1. A camera that looks straight down has none: then L's x.
[[nodiscard]] Vec3 ahead_of(const Pose& T_c_l);
/// (-1, f, l): derivative of z_road by (h, s_f, s_l) at the point x_l.
[[nodiscard]] Vec3 ground_row(const Pose& T_c_l, const Vec3& x_l);

}  // namespace semtrack

#endif
