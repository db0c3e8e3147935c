#include "estimate/ego/pose_tracker.hpp"

#include "math/cholesky6.hpp"
#include "math/robust.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kMinMatches = 6;
constexpr double kCauchy = 1.0;  // each in sigmas, after the round's scale
constexpr double kHuber = 1.5;
constexpr double kTukey = 5.0;

enum class Kernel { kWide, kMiddle, kNarrow };

struct Round {
    int iterations;
    double scale;  // sigmas are multiplied by it
    Kernel kernel;
};
constexpr std::array<Round, 5> kRounds{{{3, 64.0, Kernel::kWide},
                                        {3, 16.0, Kernel::kWide},
                                        {6, 4.0, Kernel::kWide},
                                        {4, 2.0, Kernel::kMiddle},
                                        {4, 1.0, Kernel::kNarrow}}};
constexpr std::size_t kFineRound = 2;  // where a good prediction starts: the wide rounds follow outliers away from it
constexpr double kAgreement = 0.6;     // inliers of the matches; below, the prediction was no good

Robust robust(Kernel kernel, double r2) {
    switch (kernel) {
        case Kernel::kWide:
            return cauchy(r2, kCauchy);
        case Kernel::kMiddle:
            return huber(r2, kHuber);
        case Kernel::kNarrow:
            break;
    }
    return tukey(r2, kTukey);
}

/// H and g of one round at T; returns the matches in front of the camera.
int accumulate(const EgoWindow& window, const EgoFrame& frame, const Calibration& calibration, const Pose& T,
               const Round& round, Mat6& H, Vec6& g) {
    H.setZero();
    g.setZero();
    int used = 0;
    const double scale2 = 1.0 / (round.scale * round.scale);
    for (const EgoLandmark& landmark : window.landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
        if (!landmark.valid || !o.valid) {
            continue;
        }
        const Vec3 x_c = T * landmark.x_w;
        StereoPointResidual z;
        if (stereo_point_residual(calibration, x_c, o.measurement(), true, z) != Status::kOk) {
            continue;
        }
        ++used;
        const double weight = robust(round.kernel, scale2 * z.r.dot(z.r)).weight * scale2;
        if (!(weight > 0.0)) {
            continue;
        }
        const Mat3x6 J = pose_jacobian(z.J, x_c);
        const Mat3x6 wJ = weight * J;
        H += J.transpose() * wJ;
        g += wJ.transpose() * z.r;
    }
    return used;
}

int count_inliers(const EgoWindow& window, const EgoFrame& frame, const Calibration& calibration, const Pose& T) {
    int inliers = 0;
    for (const EgoLandmark& landmark : window.landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
        if (!landmark.valid || !o.valid) {
            continue;
        }
        StereoPointResidual z;
        const bool ahead =
            stereo_point_residual(calibration, T * landmark.x_w, o.measurement(), false, z) == Status::kOk;
        inliers += ahead && z.r.dot(z.r) < kPoseGate * kPoseGate ? 1 : 0;
    }
    return inliers;
}

bool fit_from(const EgoWindow& window, const EgoFrame& frame, const Calibration& calibration, std::size_t first_round,
              Pose& T_c_w, PoseFit& fit) {
    fit = PoseFit{};
    Pose T = T_c_w;
    Mat6 H;
    Vec6 g;
    for (std::size_t i = first_round; i < kRounds.size(); ++i) {
        for (int k = 0; k < kRounds[i].iterations; ++k) {
            fit.matches = accumulate(window, frame, calibration, T, kRounds[i], H, g);
            Vec6 step;
            if (fit.matches < kMinMatches || !solve6(H, g, step)) {
                return false;
            }
            T = perturbed_left(T, -step);
            if (!is_finite(T)) {
                return false;
            }
        }
    }
    (void)accumulate(window, frame, calibration, T, kRounds.back(), H, g);
    if (!inverse6(H, fit.covariance)) {
        return false;
    }
    fit.inliers = count_inliers(window, frame, calibration, T);
    T_c_w = T;
    return true;
}

}  // namespace

bool fit_pose(const EgoWindow& window, const EgoFrame& frame, const Calibration& calibration, Pose& T_c_w,
              PoseFit& fit) {
    Pose T = T_c_w;
    bool found = fit_from(window, frame, calibration, kFineRound, T, fit);
    if (!found || fit.inliers < kAgreement * fit.matches) {
        Pose T_wide = T_c_w;
        PoseFit wide;
        if (fit_from(window, frame, calibration, 0, T_wide, wide) && (!found || wide.inliers > fit.inliers)) {
            found = true;
            T = T_wide;
            fit = wide;
        }
    }
    if (found) {
        T_c_w = T;
    }
    return found;
}

}  // namespace semtrack
