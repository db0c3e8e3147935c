#include "estimate/object/object_estimator.hpp"

#include <cmath>

#include "estimate/factor/size_prior.hpp"
#include "estimate/object/object_starts.hpp"
#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr double kMaxPlausibleSpeed = 90.0;  // m/s
constexpr double kMinStereoDisparity_px = 2.0;
constexpr double kDoubtfulViews = 2.0;  // over the window
constexpr double kBetterBy = 0.5;       // of the cost: equal starts do not take turns
constexpr int kTrialsBlind = 3;
constexpr int kYoungFrames = 9;         // of the window
constexpr double kDoubtfulSize2 = 6.0;  // |r|^2 of the size prior, three degrees of freedom

bool finite_state(const ObjectState& x) {
    return std::isfinite(x.p(0)) && std::isfinite(x.p(1)) && std::isfinite(x.p(2)) && std::isfinite(x.theta) &&
           std::isfinite(x.v) && std::isfinite(x.delta) && std::fabs(x.v) < kMaxPlausibleSpeed;
}

}  // namespace

void ObjectEstimator::init(const Calibration& calibration, const Config& config) {
    calibration_ = calibration;
    options_.cues = config.cues;
}

void ObjectEstimator::run(ObjectWindow& window, bool standing, NormalEquations& system, SolverStep& step) {
    options_.standing = standing;
    options_.hold_heading = standing;
    problem_.begin(window, calibration_, options_);
    lm_ = levenberg_marquardt(problem_, lm_options_, system, step);
}

// Moving or standing, whatever explains the window better; a vehicle that has stood needs several frames to start.
// true: standing; the problem holds the chosen solution.
bool ObjectEstimator::choose_hypothesis(ObjectWindow& window, ObjectSolveReport& report, NormalEquations& system,
                                        SolverStep& step) {
    const bool rests = class_prior(window.object_class).has_heading && window.stood >= kStoodLong &&
                       std::fabs(window.newest().state.v) < kRestSpeed;
    run(window, false, system, step);
    const LmReport moving = lm_;
    moving_ = problem_.variables();
    const int last = window.frames.size() - 1;
    const double speed = std::fabs(moving_.state[static_cast<std::size_t>(last)].v);
    const bool slow = speed < (window.standing ? kStandingMaxSpeedKeep : kStandingMaxSpeed);
    const bool starts = rests && speed > kRestSpeed;
    if (!options_.cues.motion || last < 1 || !(slow || starts)) {
        return false;
    }
    run(window, true, system, step);
    report.standing_gain = 2.0 * (lm_.final_cost - moving.final_cost);
    const bool explained = slow && report.standing_gain < (window.standing ? kStandingGainKeep : kStandingGain);
    window.contradicted = explained || !starts ? 0 : window.contradicted + (window.newest().box.valid ? 1 : 0);
    if (explained || (starts && window.contradicted < kStartFrames)) {
        return true;
    }
    options_.standing = options_.hold_heading = false;
    problem_.begin(window, calibration_, options_);
    problem_.set(moving_);
    lm_ = moving;
    return false;
}

ObjectSolveReport ObjectEstimator::solve(ObjectWindow& window, NormalEquations& system, SolverStep& step,
                                         const SolveShare& share) {
    ObjectSolveReport report;
    if (window.frames.empty()) {
        return report;
    }
    lm_options_.iterations = share.iterations;
    const int last = window.frames.size() - 1;
    bool standing = window.standing;
    if (share.trials) {
        standing = choose_hypothesis(window, report, system, step);
        try_other_starts(window, standing, system, step);
    } else {
        run(window, standing, system, step);
    }
    if (turning_cost(window, problem_.variables()) >= kTurningMost) {
        window.heading_information = 0.0;  // it was of another heading
    }
    report.reason = lm_.reason;
    report.cost = lm_.final_cost;
    if (lm_.reason == LmReason::kInvalidCost || lm_.reason == LmReason::kNotObservable ||
        !finite_state(problem_.variables().state[static_cast<std::size_t>(last)])) {
        return report;
    }
    problem_.store(window);
    window.standing = standing;
    window.stood += standing ? 1 : 0;
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
    carry_size(window);
    carry_heading(window);
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

// Five iterations do not leave the wrong one of two headings, or the wrong depth of an object that entered half
// outside the image; by the time the features contradict it, the size has given way. In doubt other starts are tried,
// another one each frame, and the cheapest solution stays. Without landmarks a start costs little: three a frame.
// Landmarks of a car that stands hold its heading, unless the viewpoints contradict it.
void ObjectEstimator::try_other_starts(const ObjectWindow& window, bool standing, NormalEquations& system,
                                       SolverStep& step) {
    if (!class_prior(window.object_class).has_heading) {
        return;
    }
    const ObjectVariables start = problem_.variables();
    const bool blind = problem_.landmarks() == 0;
    other_ = start;
    if (!standing && landmark_start(window, other_)) {
        keep_better(window, standing, system, step);
        return;
    }
    const bool young = window.frames.size() <= kYoungFrames;
    const double size2 = size_prior_cost(size_prior(window.object_class), start.size_m);
    const bool contradicted = heading_cost(window, start) > kDoubtfulViews;
    const bool doubtful = young || size2 > kDoubtfulSize2 || contradicted;
    if (!blind && (!doubtful || (standing && !contradicted))) {
        return;
    }
    const bool viewed = window.newest().box.valid && window.newest().box.viewpoint.horizontal >= 0;
    const int options = 2 + (viewed ? kFreshStarts : kFreshStartsBlind);
    const int trials = blind ? kTrialsBlind : 1;
    for (int t = 0; t < trials; ++t) {
        const int option = static_cast<int>(
            (window.newest().frame * static_cast<std::uint32_t>(trials) + static_cast<std::uint32_t>(t)) %
            static_cast<std::uint32_t>(options));
        other_ = start;
        const bool made = option < 2 ? twin_start(window, option == 1, other_)
                                     : fresh_start(window, calibration_, option - 2, other_);
        const auto newest = static_cast<std::size_t>(window.frames.size() - 1);
        const double turn = wrap_angle(other_.state[newest].theta - start.state[newest].theta);
        const bool turned = turn > 0.5 * kPi || turn < -0.5 * kPi;
        // Of one that stood without any viewpoint nothing tells front from rear better than before.
        if (made && !(turned && !viewed && window.stood >= kStoodLong)) {
            keep_better(window, standing, system, step);
        }
    }
}

void ObjectEstimator::keep_better(const ObjectWindow& window, bool standing, NormalEquations& system,
                                  SolverStep& step) {
    chosen_ = problem_.variables();
    const LmReport chosen = lm_;
    // What earlier frames said holds within their heading's reach; the twin pays for contradicting them.
    const bool within = turning_cost(window, other_) < kTurningMost;
    const double cost = chosen.final_cost + heading_cost(window, chosen_) + outside_cost(window, chosen_);
    options_.standing = standing;
    problem_.begin(window, calibration_, options_);
    problem_.hold_heading(standing && within);
    problem_.set(other_);
    lm_ = levenberg_marquardt(problem_, lm_options_, system, step);
    const ObjectVariables& x = problem_.variables();
    const double other = lm_.final_cost + heading_cost(window, x) + outside_cost(window, x) +
                         (standing && !within ? turning_cost(window, x) : 0.0);
    if (!(other < cost - kBetterBy)) {
        problem_.hold_heading(options_.hold_heading);
        problem_.set(chosen_);
        lm_ = chosen;
    }
}

// The size is the track's, the window is short: once all its frames are newer than those the prior has used, what
// they say of the size becomes the prior. Nothing is used twice.
void ObjectEstimator::carry_size(ObjectWindow& window) {
    if (window.frames[0].frame <= window.prior_frame) {
        return;
    }
    window.prior_frame = window.newest().frame;
    window.prior_size_m = window.size_m;
    window.prior_size_covariance = window.size_covariance;
    for (int i = 0; i < 3; ++i) {  // errors of a detector's boxes that stay for a track's whole life
        const double floor = kSizeFloor * window.size_m(i);
        window.prior_size_covariance(i, i) += floor * floor;
    }
}

// A standing car does not turn. Every window says something of its heading with what it sees; of that the newest frame
// is new.
void ObjectEstimator::carry_heading(ObjectWindow& window) {
    double& known = window.heading_information;
    if (!window.standing) {
        known /= 1.0 + known * kHeadingTurned_rad * kHeadingTurned_rad;
        return;
    }
    const double anchor = 1.0 / (kAnchorHeading_rad * kAnchorHeading_rad);
    const double variance = window.covariance(3, 3);
    const double of_window = variance > 0.0 ? 1.0 / variance - known - anchor : 0.0;
    known += of_window > 0.0 ? of_window / static_cast<double>(window.frames.size()) : 0.0;
    // Where the edges say nothing, nothing turns it: the longer it stood, the less.
    const int stood = window.stood < kHeadingHoldFrames ? window.stood : kHeadingHoldFrames;
    const double least = static_cast<double>(stood) / (kHeadingHoldFrames * kHeadingHold_rad * kHeadingHold_rad);
    known = known > least ? known : least;
    constexpr double kMost = 1.0 / (kHeadingFloor_rad * kHeadingFloor_rad);
    known = known < kMost ? known : kMost;
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
