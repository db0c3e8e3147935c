// Sparse feature observation r_Z, paper Eq. (11)-(12) [eq:feature-factor], of a point given in the left camera frame:
//   r = [ (pi(x_c) - z_l) / sigma ; (pi(x_c + t_r_l)_u - z_r,u) / sigma_r ]      [px / px]
// The pair is rectified: the right image's row carries nothing new, so it is left out. For the background x_c is
// T_c_w f_w, for an object T_c_w T_w_o f_o; by f_w the derivative is J R_c_w, by the pose pose_jacobian().
#ifndef SEMTRACK_ESTIMATE_FACTOR_STEREO_POINT_HPP
#define SEMTRACK_ESTIMATE_FACTOR_STEREO_POINT_HPP

#include "math/camera.hpp"
#include "math/eigen.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

struct StereoPointMeasurement {
    double u{0};
    double v{0};
    double u_right{0};
    double sigma_px{1};        ///< of u and v
    double sigma_right_px{1};  ///< of u_right
    bool stereo{false};        ///< false: the third row is zero
};

struct StereoPointResidual {
    Vec3 r{Vec3::Zero()};
    Mat3 J{Mat3::Zero()};  ///< by x_c
};

/// kBehindCamera: depth below kMinDepth_m; out is untouched. J only with derivatives. Constant cost.
[[nodiscard]] inline Status stereo_point_residual(const Calibration& c, const Vec3& x_c,
                                                  const StereoPointMeasurement& z, bool derivatives,
                                                  StereoPointResidual& out) {
    if (!(x_c(2) >= kMinDepth_m)) {
        return Status::kBehindCamera;
    }
    const double inv_z = 1.0 / x_c(2);
    const double x = x_c(0) * inv_z;
    const double y = x_c(1) * inv_z;
    const double w = 1.0 / z.sigma_px;
    const double w_r = z.stereo ? 1.0 / z.sigma_right_px : 0.0;
    const double x_r = x - c.baseline_m * inv_z;
    out.r(0) = w * (c.left.fx * x + c.left.cx - z.u);
    out.r(1) = w * (c.left.fy * y + c.left.cy - z.v);
    out.r(2) = w_r * (c.left.fx * x_r + c.right.cx - z.u_right);
    if (!derivatives) {
        return Status::kOk;
    }
    const double gx = w * c.left.fx * inv_z;
    const double gy = w * c.left.fy * inv_z;
    const double gr = w_r * c.left.fx * inv_z;
    out.J << gx, 0.0, -gx * x, 0.0, gy, -gy * y, gr, 0.0, -gr * x_r;
    return Status::kOk;
}

/// The same residual by the camera pose: x_c' = exp(w) x_c + t, columns (t, w) as in perturbed_left(). J: by x_c.
[[nodiscard]] inline Mat3x6 pose_jacobian(const Mat3& J, const Vec3& x_c) {
    Mat3x6 out;
    for (int r = 0; r < 3; ++r) {
        out(r, 0) = J(r, 0);
        out(r, 1) = J(r, 1);
        out(r, 2) = J(r, 2);
        // -J [x_c]_x, row by row: x_c x (row)
        out(r, 3) = x_c(1) * J(r, 2) - x_c(2) * J(r, 1);
        out(r, 4) = x_c(2) * J(r, 0) - x_c(0) * J(r, 2);
        out(r, 5) = x_c(0) * J(r, 1) - x_c(1) * J(r, 0);
    }
    return out;
}

}  // namespace semtrack

#endif
