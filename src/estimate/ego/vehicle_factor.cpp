#include "estimate/ego/vehicle_factor.hpp"

#include "math/cholesky6.hpp"
#include "math/so3.hpp"

namespace semtrack {

VehicleStep vehicle_step(const MotionPrediction& prediction) {
    VehicleStep out;
    out.T_cur_prev = prediction.T_cur_prev;
    out.valid = is_finite(prediction.T_cur_prev) && inverse6(prediction.covariance, out.information);
    return out;
}

void vehicle_residual(const Pose& T_now, const Pose& T_before, const VehicleStep& step, Vec6& e, Mat6& J_now,
                      Mat6& J_before) {
    const Pose T_now_before = T_now * T_before.inverse();
    const Pose E = T_now_before * step.T_cur_prev.inverse();
    const Vec3 w = so3_log(orthonormalised(E.R));
    e << E.t, w;
    const Mat3 W = skew(w);
    J_now.setIdentity();
    J_now.topRightCorner<3, 3>() = -skew(E.t);
    // Inverse of the left Jacobian of the rotations; the next term is of the fourth order.
    J_now.bottomRightCorner<3, 3>() += -0.5 * W + (1.0 / 12.0) * W * W;
    J_before = -J_now * adjoint(T_now_before);
}

}  // namespace semtrack
