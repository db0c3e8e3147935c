#include "estimate/ego/calibration_error.hpp"

#include "math/cholesky6.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kMinLandmarks = 10;
constexpr double kGate = 4.0;  // sigmas

/// 1, x, y of the place where a point is seen.
Vec3 modes_at(const Calibration& c, const Vec3& x_c) {
    const Vec2 p = project(c.left, x_c);
    return {1.0, 2.0 * p(0) / c.width - 1.0, 2.0 * p(1) / c.height - 1.0};
}

}  // namespace

DisparityResponse motion_response(const EgoWindow& window, const EgoFrame& before, const EgoFrame& now,
                                  const Calibration& calibration) {
    DisparityResponse out;
    out.fill(Vec6::Zero());
    const Pose T_now_before = now.T_c_w * before.T_c_w.inverse();
    const double fb = calibration.left.fx * calibration.baseline_m;
    Mat6 H = Mat6::Zero();
    Eigen::Matrix<double, 6, 3> g = Eigen::Matrix<double, 6, 3>::Zero();
    int used = 0;
    for (const EgoLandmark& landmark : window.landmarks) {
        const EgoObservation& then = landmark.seen[static_cast<std::size_t>(before.column)];
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(now.column)];
        const Vec3 x_before = before.T_c_w * landmark.x_w;
        StereoPointResidual z;
        if (!landmark.valid || !then.valid || !o.valid || !o.stereo || !(x_before(2) > kMinDepth_m) ||
            stereo_point_residual(calibration, now.T_c_w * landmark.x_w, o.measurement(), true, z) != Status::kOk ||
            !(z.r.dot(z.r) < kGate * kGate)) {
            continue;
        }
        ++used;
        const Vec3 x_now = now.T_c_w * landmark.x_w;
        const Mat3x6 J = pose_jacobian(z.J, x_now);
        // Too large a disparity by 1 px: the landmark comes nearer along its ray by 1 / disparity ...
        const Vec3 by_landmark = z.J * (T_now_before.R * Vec3(-x_before(2) / fb * x_before));
        // ... and its place in the right image lies 1 px further to the left.
        const Vec3 by_sight(0.0, 0.0, 1.0 / static_cast<double>(o.sigma_right_px));
        const Mat3 r = by_landmark * modes_at(calibration, x_before).transpose() +
                       by_sight * modes_at(calibration, x_now).transpose();
        H += J.transpose() * J;
        g += J.transpose() * r;
    }
    Mat6 inverse;
    if (used < kMinLandmarks || !inverse6(H, inverse)) {
        return out;
    }
    for (std::size_t k = 0; k < kDisparityModes; ++k) {
        out[k] = inverse * g.col(static_cast<Eigen::Index>(k));
    }
    return out;
}

Mat6 covariance_of(const DisparityResponse& response) {
    Mat6 out = Mat6::Zero();
    for (const Vec6& mode : response) {
        out += kDisparityError_px * kDisparityError_px * mode * mode.transpose();
    }
    return out;
}

}  // namespace semtrack
