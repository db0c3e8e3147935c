// Where an object of its class's mean size stands, from its 2D box and a known heading: the planes of its edges as in
// front/box with the corners of the pose it is thought to have,
//   a_e . (p + R_c_l R_z(theta) C_e d) = 0,  e = top, bottom, and the mean of left and right:  three equations for p.
// Evidence for the road (ground contact G) that owes nothing to what is believed of the road already.
#ifndef SEMTRACK_MODEL_STAND_POINT_HPP
#define SEMTRACK_MODEL_STAND_POINT_HPP

#include <array>

#include "math/pose.hpp"
#include "model/box_geometry.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

struct StandPoint {
    Vec3 p_d{Vec3::Zero()};  ///< middle of the bottom face, detection camera
    double sigma_m{0};       ///< of its height above the camera's
};

/// T_d_o: the pose so far (its heading and which corners it shows are taken over). sigma_px: of the edges, all four
/// must be the object's own (> 0). kNotObservable otherwise, or when the result is not in front of the camera.
[[nodiscard]] Status stand_point(const PinholeCamera& camera, const Box2d& box, const std::array<double, 4>& sigma_px,
                                 const Pose& T_d_o, const Vec3& size_m, double height_sigma_m, StandPoint& out);

}  // namespace semtrack

#endif
