#include "estimate/object/object_estimator.hpp"

#include <cmath>

#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/so3.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

// Five iterations, warm-started: converging further was no more accurate on 200 random problems and cost four times
// as much in the tail.
constexpr int kObjectIterations = 5;
constexpr double kMaxPlausibleSpeed = 90.0;  // m/s
constexpr double kMinStereoDisparity_px = 2.0;

bool finite_state(const ObjectState& x) {
    return std::isfinite(x.p(0)) && std::isfinite(x.p(1)) && std::isfinite(x.p(2)) && std::isfinite(x.theta) &&
           std::isfinite(x.v) && std::isfinite(x.delta) && std::fabs(x.v) < kMaxPlausibleSpeed;
}

}  // namespace

void ObjectEstimator::init(const Calibration& calibration, const Config& config) {
    calibration_ = calibration;
    options_.cues = config.cues;
    options_.ground.valid = config.cues.ground;
    options_.ground.camera_height_m = config.camera_height_m;
    options_.ground.camera_height_sigma_m = config.camera_height_sigma_m;
}

void ObjectEstimator::run(ObjectWindow& window, bool standing, NormalEquations& system, SolverStep& step) {
    options_.standing = standing;
    problem_.begin(window, calibration_, options_);
    LmOptions lm;
    lm.iterations = kObjectIterations;
    lm_ = levenberg_marquardt(problem_, lm, system, step);
}

ObjectSolveReport ObjectEstimator::solve(ObjectWindow& window, NormalEquations& system, SolverStep& step) {
    ObjectSolveReport report;
    run(window, false, system, step);
    const LmReport moving = lm_;
    moving_ = problem_.variables();
    const int last = window.frames.size() - 1;
    const bool slow = std::fabs(moving_.state[static_cast<std::size_t>(last)].v) < kStandingMaxSpeed;
    bool standing = false;
    if (options_.cues.motion && slow && last >= 1) {
        run(window, true, system, step);
        report.standing_gain = 2.0 * (lm_.final_cost - moving.final_cost);
        standing = report.standing_gain < (window.standing ? kStandingGainKeep : kStandingGain);
        if (!standing) {
            options_.standing = false;
            problem_.begin(window, calibration_, options_);
            problem_.set(moving_);
            lm_ = moving;
        }
    }
    report.reason = lm_.reason;
    report.cost = lm_.final_cost;
    if (lm_.reason == LmReason::kInvalidCost || lm_.reason == LmReason::kNotObservable ||
        !finite_state(problem_.variables().state[static_cast<std::size_t>(last)])) {
        return report;
    }
    problem_.store(window);
    window.standing = standing;
    if (standing) {
        window.newest().state.v = 0.0;
    }
    // Covariance where the solve ended: one more linearisation, no more step.
    (void)problem_.linearise(system);
    Mat6 covariance;
    if (system.covariance(last, covariance) == Status::kOk) {
        window.covariance = covariance;
    }
    Mat3 size_covariance;
    if (system.shared_covariance(size_covariance) == Status::kOk) {
        window.size_covariance = size_covariance;
    }
    report.solved = true;
    cull(window, report);
    for (const std::int16_t slot : report.culled) {
        window.landmarks[static_cast<std::size_t>(slot)].valid = false;
        for (ObjectFrame& frame : window.frames) {
            frame.features[static_cast<std::size_t>(slot)].valid = false;
        }
    }
    give_birth(window);
    return report;
}

void ObjectEstimator::cull(const ObjectWindow& window, ObjectSolveReport& report) const {
    const int last = window.frames.size() - 1;
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        if (!window.landmarks[slot].valid || !window.frames[last].features[slot].valid) {
            continue;
        }
        const double r2 = problem_.feature_residual2(last, s);
        if (r2 < 0.0 || r2 > kFeatureCull * kFeatureCull) {
            (void)report.culled.try_push_back(static_cast<std::int16_t>(s));
        }
    }
}

void ObjectEstimator::give_birth(ObjectWindow& window) const {
    const ObjectFrame& frame = window.newest();
    const Mat3 R_l_o = class_prior(window.object_class).has_heading ? rot_z(frame.state.theta) : Mat3(Mat3::Identity());
    const Pose T_l_c = frame.T_c_l.inverse();
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        const FeatureObservation& o = frame.features[slot];
        ObjectLandmark& landmark = window.landmarks[slot];
        if (landmark.valid || !o.valid || !o.stereo) {
            continue;
        }
        const double d = disparity(calibration_, static_cast<double>(o.u), static_cast<double>(o.u_right));
        if (!(d > kMinStereoDisparity_px)) {
            continue;
        }
        const Vec3 x_c = bearing(calibration_.left, static_cast<double>(o.u), static_cast<double>(o.v)) *
                         depth_from_disparity(calibration_, d);
        landmark.f_o = R_l_o.transpose() * (T_l_c * x_c - frame.state.p);
        landmark.valid = true;
    }
}

}  // namespace semtrack
