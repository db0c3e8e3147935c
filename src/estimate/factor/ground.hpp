// Ground contact G (ours, beside the paper's cues): the bottom of the box lies on the local road,
//   r = (p_z - d_h / 2 - z_road(p)) / sigma,   z_road: model/ground_plane.hpp, from the other objects and the road
//   sigma^2 = (0.06 + 0.004 distance)^2 + a Sigma a^T,   a: ground_row(),  Sigma: the plane's covariance
// Bottoms of labelled cars scatter by 0.08 to 0.19 m about a plane fitted to the other cars of the frame.
#ifndef SEMTRACK_ESTIMATE_FACTOR_GROUND_HPP
#define SEMTRACK_ESTIMATE_FACTOR_GROUND_HPP

#include "model/object_window.hpp"

namespace semtrack {

struct GroundResidual {
    double r{0};
    Vec3 J_p{Vec3::Zero()};
    double J_height{0};  ///< by size(2)
};

/// The plane must be valid. sigma is held at x: its derivative is left out.
[[nodiscard]] GroundResidual ground_residual(const ObjectState& x, double height_m, const Pose& T_c_l,
                                             const GroundPlane& plane);

}  // namespace semtrack

#endif
