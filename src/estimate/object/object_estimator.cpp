#include "estimate/object/object_estimator.hpp"

#include <cmath>

#include "estimate/factor/size_prior.hpp"
#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

// Five iterations, warm-started: converging further was no more accurate on 200 random problems and cost four times
// as much in the tail.
constexpr int kObjectIterations = 5;
constexpr double kMaxPlausibleSpeed = 90.0;  // m/s
constexpr double kMinStereoDisparity_px = 2.0;
constexpr double kWrongViewCost = 2.0;  // of a frame whose faces are others than the detector says
constexpr double kNextViewCost = 0.5;   // ... by one class
constexpr double kMaxTurn_rad = 1.2;    // to a twin
constexpr double kDoubtfulViews = 2.0;  // over the window
constexpr double kDoubtfulSize2 = 6.0;  // |r|^2 of the size prior, three degrees of freedom

bool finite_state(const ObjectState& x) {
    return std::isfinite(x.p(0)) && std::isfinite(x.p(1)) && std::isfinite(x.p(2)) && std::isfinite(x.theta) &&
           std::isfinite(x.v) && std::isfinite(x.delta) && std::fabs(x.v) < kMaxPlausibleSpeed;
}

/// Wrong faces over the window; an adjacent class is often the detector's error. Bounded, so that a few wrong classes
/// do not hold a heading that the edges contradict.
double view_cost(const ObjectWindow& window, const ObjectVariables& x) {
    double cost = 0.0;
    for (int k = 0; k < window.frames.size(); ++k) {
        const ObjectFrame& frame = window.frames[k];
        if (!frame.box.valid || frame.box.viewpoint.horizontal < 0) {
            continue;
        }
        const ObjectState& state = x.state[static_cast<std::size_t>(k)];
        const int seen = visible_faces(frame.T_c_l * state.T_l_o(), x.size_m).horizontal;
        const int apart = seen > frame.box.viewpoint.horizontal ? seen - frame.box.viewpoint.horizontal
                                                                : frame.box.viewpoint.horizontal - seen;
        const int steps = apart > 4 ? 8 - apart : apart;
        cost += steps == 0 ? 0.0 : steps == 1 ? kNextViewCost : kWrongViewCost;
    }
    return cost;
}

/// The turn to a second heading whose box is nearly as wide in the image: mirrored about the line of sight, or, with
/// the same two faces, on the other side of the heading at which the box is widest.
double turn_to_twin(const ObjectFrame& frame, const Vec3& size_m, bool mirrored) {
    const Vec3 camera_l = frame.T_c_l.inverse().t;
    const Vec3 ray = frame.state.p - camera_l;
    const double off = wrap_angle(frame.state.theta - atan2_rad(ray(1), ray(0)));
    if (mirrored) {
        return -2.0 * off;
    }
    // Within its quarter: widest where tan = length / width.
    const double quarter = off >= 0.5 * kPi    ? off - 0.5 * kPi
                           : off >= 0.0        ? off
                           : off >= -0.5 * kPi ? off + 0.5 * kPi
                                               : off + kPi;
    const bool across = (off >= 0.5 * kPi) || (off < 0.0 && off >= -0.5 * kPi);
    const double widest = across ? atan2_rad(size_m(1), size_m(0)) : atan2_rad(size_m(0), size_m(1));
    return 2.0 * (widest - quarter);
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
    if (window.frames.empty()) {
        return report;
    }
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
    try_other_heading(window, standing, system, step);
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

// Five iterations do not leave the wrong one of two headings; by the time the features contradict it, the size has
// given way. In doubt one of the twins is tried a frame, and the cheaper one stays.
void ObjectEstimator::try_other_heading(const ObjectWindow& window, bool standing, NormalEquations& system,
                                        SolverStep& step) {
    chosen_ = problem_.variables();
    const double views = view_cost(window, chosen_);
    const bool young = window.frames.size() <= kObjectDenseFrames;
    const double size2 = size_prior_cost(size_prior(window.object_class), chosen_.size_m);
    if (!standing || !class_prior(window.object_class).has_heading ||
        !(young || size2 > kDoubtfulSize2 || views > kDoubtfulViews)) {
        return;
    }
    const LmReport chosen = lm_;
    const int last = window.frames.size() - 1;
    ObjectFrame now;
    now.T_c_l = window.newest().T_c_l;
    now.state = chosen_.state[static_cast<std::size_t>(last)];
    const double turn = turn_to_twin(now, chosen_.size_m, window.newest().frame % 2U == 0U);
    if (std::fabs(turn) > kMaxTurn_rad) {
        return;  // other faces: the detector's class would have told
    }
    moving_ = chosen_;
    const Mat3 R_back = rot_z(-turn);
    for (int k = 0; k <= last; ++k) {
        ObjectState& x = moving_.state[static_cast<std::size_t>(k)];
        x.theta = wrap_angle(x.theta + turn);
    }
    for (Vec3& f : moving_.f_o) {
        f = R_back * f;  // stays where it is in the world
    }
    options_.standing = standing;
    problem_.begin(window, calibration_, options_);
    problem_.set(moving_);
    LmOptions lm;
    lm.iterations = kObjectIterations;
    lm_ = levenberg_marquardt(problem_, lm, system, step);
    if (!(lm_.final_cost + view_cost(window, problem_.variables()) < chosen.final_cost + views)) {
        problem_.set(chosen_);
        lm_ = chosen;
    }
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
