// Rotations of 3D space: exponential, logarithm, re-orthonormalisation.
#ifndef SEMTRACK_MATH_SO3_HPP
#define SEMTRACK_MATH_SO3_HPP

#include "math/eigen.hpp"
#include "math/pose.hpp"

namespace semtrack {

/// [w]_x with [w]_x y = w x y.
[[nodiscard]] Mat3 skew(const Vec3& w);
/// exp([w]_x), Rodrigues; exact to rounding for |w| up to pi.
[[nodiscard]] Mat3 so3_exp(const Vec3& w);
/// w with so3_exp(w) = R, |w| <= pi.
[[nodiscard]] Vec3 so3_log(const Mat3& R);
/// Nearest rotation to a slightly drifted one (two Newton steps of R <- R (3 I - R^T R) / 2).
[[nodiscard]] Mat3 orthonormalised(const Mat3& R);
/// Rotation about z by a heading given as angle.
[[nodiscard]] Mat3 rot_z(double angle_rad);
/// Perturbation of a camera-from-world pose: x_c' = exp(xi_rot) x_c + xi_trans; xi = (translation, rotation).
[[nodiscard]] Pose perturbed_left(const Pose& T_c_w, const Vec6& xi);

}  // namespace semtrack

#endif
