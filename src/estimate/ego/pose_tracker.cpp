#include "estimate/ego/pose_tracker.hpp"

#include <cmath>

#include "math/cholesky6.hpp"
#include "math/robust.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kMinMatches = 6;

struct Round {
    int iterations;
    double scale;  // sigmas are multiplied by it
    int kernel;    // 0 Cauchy, 1 Huber, 2 Tukey
};
constexpr Round kRounds[] = {{6, 4.0, 0}, {4, 2.0, 1}, {4, 1.0, 2}};
constexpr double kTukeyPose = 5.0;

Robust kernel(int kind, double r2) {
    if (kind == 0) {
        return cauchy(r2, 1.0);
    }
    return kind == 1 ? huber(r2, 1.5) : tukey(r2, kTukeyPose);
}

/// H and g of one round at T; returns the matches in front of the camera.
int accumulate(const EgoWindow& window, int column, const Calibration& calibration, const Pose& T, const Round& round,
               Mat6& H, Vec6& g) {
    H.setZero();
    g.setZero();
    int used = 0;
    const double scale2 = 1.0 / (round.scale * round.scale);
    for (const EgoLandmark& landmark : window.landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(column)];
        if (!landmark.valid || !o.valid) {
            continue;
        }
        const Vec3 x_c = T * landmark.x_w;
        StereoPointResidual z;
        if (stereo_point_residual(calibration, x_c, o.measurement(), true, z) != Status::kOk) {
            continue;
        }
        const Robust rho = kernel(round.kernel, scale2 * z.r.dot(z.r));
        Mat3x6 J;
        J.leftCols<3>() = z.J;
        J.rightCols<3>() = -(z.J * skew(x_c));
        H += (rho.weight * scale2) * (J.transpose() * J);
        g += (rho.weight * scale2) * (J.transpose() * z.r);
        ++used;
    }
    return used;
}

}  // namespace

bool fit_pose(const EgoWindow& window, int column, const Calibration& calibration, Pose& T_c_w, PoseFit& fit) {
    fit = PoseFit{};
    Pose T = T_c_w;
    Mat6 H;
    Vec6 g;
    for (const Round& round : kRounds) {
        for (int k = 0; k < round.iterations; ++k) {
            fit.matches = accumulate(window, column, calibration, T, round, H, g);
            Vec6 step;
            if (fit.matches < kMinMatches || !solve6(H, g, step)) {
                return false;
            }
            T = perturbed_left(T, -step);
        }
    }
    if (!is_finite(T)) {
        return false;
    }
    (void)accumulate(window, column, calibration, T, kRounds[2], H, g);
    if (!inverse6(H, fit.covariance)) {
        return false;
    }
    for (const EgoLandmark& landmark : window.landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(column)];
        if (!landmark.valid || !o.valid) {
            continue;
        }
        StereoPointResidual z;
        const bool ahead =
            stereo_point_residual(calibration, T * landmark.x_w, o.measurement(), false, z) == Status::kOk;
        fit.inliers += ahead && z.r.dot(z.r) < kPoseGate * kPoseGate ? 1 : 0;
    }
    T_c_w = T;
    return true;
}

}  // namespace semtrack
