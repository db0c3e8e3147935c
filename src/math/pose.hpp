// Rigid transforms. T_a_b maps coordinates in b to a, so T_a_c = T_a_b * T_b_c reads like dominoes.
#ifndef SEMTRACK_MATH_POSE_HPP
#define SEMTRACK_MATH_POSE_HPP

#include "math/eigen.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct Pose {
    Mat3 R{Mat3::Identity()};
    Vec3 t{Vec3::Zero()};

    [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
    [[nodiscard]] Pose operator*(const Pose& b) const { return {R * b.R, R * b.t + t}; }
    [[nodiscard]] Vec3 operator*(const Vec3& x) const { return R * x + t; }
};

[[nodiscard]] Pose to_pose(const RigidTransform& T);
[[nodiscard]] RigidTransform to_rigid_transform(const Pose& T);
[[nodiscard]] bool is_finite(const Pose& T);

}  // namespace semtrack

#endif
