#include "estimate/ego/ego_estimator.hpp"

#include <cmath>

#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kMinInliers = 10;
constexpr int kWindowIterations = 5;
constexpr std::uint32_t kKeyframeDistance = 3;  // frames
constexpr double kKeyframeSurvival = 0.7;
constexpr double kKeyframeFlow_px = 2.0;  // a standing camera makes no keyframes
constexpr double kCull = 5.0;             // sigmas
constexpr double kOutlier = 4.0;          // sigmas: no part of the noise
// The sigmas of the measurements are bounds for bad light; what the residuals scatter says more. Worth so many degrees
// of freedom, the sigmas count as measured, too.
constexpr double kPriorFreedom = 30.0;

}  // namespace

void EgoEstimator::init(const Calibration& calibration) {
    calibration_ = calibration;
    T_v_c_ = to_pose(calibration.T_v_c);
    window_.clear();
    history_.reset();
    started_ = false;
    frame_ = 0;
    time_us_ = 0;
    T_w_c_ = Pose{};
    T_cur_prev_ = Pose{};
    dt_s_ = 0.0;
    covariance_.setZero();
    response_.fill(Vec6::Zero());
    heading_.reset();
    given_ = false;
    given_T_w_c_ = Pose{};
    noise_ = 1.0;
    keyframe_landmarks_ = 0;
}

MotionPrediction EgoEstimator::predict(std::int64_t time_us, const VehicleMotion* motion) const {
    const double dt_s = 1e-6 * static_cast<double>(time_us - time_us_);
    if (!started_ || !(dt_s > 0.0)) {
        return MotionPrediction{};
    }
    if (motion != nullptr) {
        return predict_from_vehicle(*motion, T_v_c_, dt_s);
    }
    return predict_constant(T_cur_prev_, dt_s_, dt_s);
}

Pose EgoEstimator::predicted_motion(std::int64_t time_us, const VehicleMotion* motion) const {
    return predict(time_us, motion).T_cur_prev;
}

bool EgoEstimator::acceptable(const EgoInput& input) const {
    if (started_ && (input.time_us <= time_us_ || input.frame <= frame_)) {
        return false;
    }
    return input.given_T_w_c == nullptr || is_finite(*input.given_T_w_c);
}

// The frame that leaves the window follows the keyframe before it from now on.
void EgoEstimator::push_frame(std::uint32_t frame, const Pose& T_c_w) {
    const int leaving = window_.leaving();
    if (leaving >= 0) {
        const EgoFrame& gone = window_.frames[leaving];
        if (!gone.keyframe) {
            history_.hang(gone.frame, window_.frames[leaving > 0 ? leaving - 1 : leaving + 1].frame);
        }
        window_.drop(leaving);
    }
    window_.push(frame, T_c_w);
}

// Nothing of the old window is seen any more: a new one starts at the predicted pose.
void EgoEstimator::restart(const EgoInput& input, const Pose& T_c_w) {
    window_.clear();
    window_.push(input.frame, T_c_w);
    window_.take(*input.features, calibration_);
    window_.give_birth(calibration_);
}

bool EgoEstimator::track(const EgoInput& input, const MotionPrediction& predicted, NormalEquations& system,
                         SolverStep& step, EgoResult& out, Mat6& covariance) {
    push_frame(input.frame, predicted.T_cur_prev * T_w_c_.inverse());
    if (input.motion != nullptr) {
        VehicleStep& vehicle = window_.frames.back().step;
        vehicle = vehicle_step(predicted);
        vehicle.information *= noise_;  // residuals are in stated sigmas, which are larger than the noise
        window_.frames.back().step_from = frame_;
    }
    window_.take(*input.features, calibration_);
    EgoFrame& now = window_.frames.back();
    PoseFit fit;
    if (!fit_pose(window_, now, calibration_, now.T_c_w, fit) || fit.inliers < kMinInliers) {
        return false;
    }
    covariance = fit.covariance;
    solve_window(system, step, covariance);
    cull(out);
    window_.give_birth(calibration_);
    return true;
}

void EgoEstimator::solve_window(NormalEquations& system, SolverStep& step, Mat6& covariance) {
    problem_.begin(window_, calibration_);
    if (problem_.free_frames() < 1 || problem_.landmarks() < kMinInliers) {
        return;
    }
    LmOptions options;
    options.iterations = kWindowIterations;
    const LmReport report = levenberg_marquardt(problem_, options, system, step);
    if (report.accepted == 0) {
        return;
    }
    problem_.store(window_);
    Mat6 newest;
    if (problem_.newest_block() >= 0 && system.covariance(problem_.newest_block(), newest) == Status::kOk) {
        covariance = newest;
    }
    noise_ = residual_variance();
    covariance *= noise_;
}

// Of the window's residuals, in sigmas of the measurements.
double EgoEstimator::residual_variance() const {
    double sum = kPriorFreedom;
    double freedom = kPriorFreedom;
    for (const EgoLandmark& landmark : window_.landmarks) {
        double square = 0.0;
        int rows = 0;
        for (const EgoFrame& frame : window_.frames) {
            const EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
            StereoPointResidual z;
            if (landmark.valid && o.valid &&
                stereo_point_residual(calibration_, frame.T_c_w * landmark.x_w, o.measurement(), false, z) ==
                    Status::kOk &&
                z.r.dot(z.r) < kOutlier * kOutlier) {
                square += z.r.dot(z.r);
                rows += o.stereo ? 3 : 2;
            }
        }
        if (rows > 3) {  // a landmark takes three
            sum += square;
            freedom += rows - 3;
        }
    }
    return sum / freedom;
}

void EgoEstimator::cull(EgoResult& out) {
    const EgoFrame& now = window_.frames.back();
    for (int l = 0; l < kEgoLandmarks; ++l) {
        EgoLandmark& landmark = window_.landmarks[static_cast<std::size_t>(l)];
        if (!landmark.valid) {
            continue;
        }
        const bool seen_now = window_.seen(l, now).valid;
        for (const EgoFrame& frame : window_.frames) {
            EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
            StereoPointResidual z;
            if (o.valid && (stereo_point_residual(calibration_, frame.T_c_w * landmark.x_w, o.measurement(), false,
                                                  z) != Status::kOk ||
                            !(z.r.dot(z.r) < kCull * kCull))) {
                o.valid = false;
            }
        }
        if (window_.seen(l, now).valid) {
            ++out.inliers;
        } else if (seen_now) {
            landmark.forget();
            (void)out.outliers.try_push_back(landmark.slot);
        }
    }
}

bool EgoEstimator::needs_keyframe() const {
    const int last = window_.last_keyframe();
    if (last < 0) {
        return true;
    }
    const EgoFrame& now = window_.frames.back();
    const EgoFrame& key = window_.frames[last];
    int shared = 0;
    double flow = 0.0;
    for (int l = 0; l < kEgoLandmarks; ++l) {
        const EgoObservation& a = window_.seen(l, key);
        const EgoObservation& b = window_.seen(l, now);
        if (window_.landmarks[static_cast<std::size_t>(l)].valid && a.valid && b.valid) {
            ++shared;
            flow += std::fabs(static_cast<double>(a.u - b.u)) + std::fabs(static_cast<double>(a.v - b.v));
        }
    }
    if (shared < kKeyframeSurvival * keyframe_landmarks_) {
        return true;
    }
    return now.frame - key.frame >= kKeyframeDistance && flow > kKeyframeFlow_px * shared;
}

void EgoEstimator::make_keyframe() {
    EgoFrame& now = window_.frames.back();
    now.keyframe = true;
    keyframe_landmarks_ = 0;
    for (int l = 0; l < kEgoLandmarks; ++l) {
        const bool valid = window_.landmarks[static_cast<std::size_t>(l)].valid;
        keyframe_landmarks_ += valid && window_.seen(l, now).valid ? 1 : 0;
    }
}

// The new frame, and what the window has revised of the older ones. A frame without images hangs on the window's
// newest.
void EgoEstimator::remember(const EgoInput& input, const Pose& T_w_c) {
    history_.add(input.frame, input.time_us, T_w_c);
    for (const EgoFrame& frame : window_.frames) {
        if (frame.frame != input.frame) {
            history_.revise(frame.frame, frame.T_c_w.inverse());
        }
    }
    if (!window_.frames.empty() && window_.frames.back().frame != input.frame) {
        history_.hang(input.frame, window_.frames.back().frame);
    }
}

void EgoEstimator::finish(const EgoInput& input, EgoStatus status, const Pose& T_w_c, const Mat6& motion_covariance,
                          const DisparityResponse& response, EgoResult& out) {
    out.status = status;
    out.dt_s = started_ ? 1e-6 * static_cast<double>(input.time_us - time_us_) : 0.0;
    out.T_w_c = T_w_c;
    out.T_w_camera = T_w_c;
    out.T_prev_cur = started_ ? T_w_c_.inverse() * T_w_c : Pose{};
    T_cur_prev_ = out.T_prev_cur.inverse();
    dt_s_ = out.dt_s;
    const Mat6 A = adjoint(T_cur_prev_);
    covariance_ = A * covariance_ * A.transpose() + motion_covariance;
    for (std::size_t k = 0; k < kDisparityModes; ++k) {
        response_[k] = A * response_[k] + response[k];
    }
    if (status == EgoStatus::kGiven) {
        covariance_.setZero();
        response_.fill(Vec6::Zero());
    }
    out.motion_covariance = motion_covariance + covariance_of(response);
    out.covariance = covariance_ + covariance_of(response_);
    T_w_c_ = T_w_c;
    time_us_ = input.time_us;
    frame_ = input.frame;
    started_ = true;
}

Pose EgoEstimator::camera_pose(const Pose& given_T_w_c) const {
    return {orthonormalised(given_T_w_c.R) * heading_.correction(T_v_c_.R), given_T_w_c.t};
}

// What the step says of the given heading turns the poses before it, too: an object's window spans many of them.
Pose EgoEstimator::take_given(const EgoInput& input) {
    const Pose given{orthonormalised(input.given_T_w_c->R), input.given_T_w_c->t};
    if (given_) {
        const Mat3 before = heading_.correction(T_v_c_.R);
        heading_.update(given_T_w_c_.inverse() * given, T_v_c_.R);
        const Mat3 change = before.transpose() * heading_.correction(T_v_c_.R);
        history_.turn(change);
        T_w_c_.R = orthonormalised(T_w_c_.R * change);
    }
    given_ = true;
    given_T_w_c_ = given;
    const Pose T_w_c = camera_pose(given);
    history_.add(input.frame, input.time_us, T_w_c);
    return T_w_c;
}

Status EgoEstimator::process(const EgoInput& input, NormalEquations& system, SolverStep& step, EgoResult& out) {
    if (!acceptable(input)) {
        return Status::kInvalidArgument;
    }
    out.outliers.clear();
    out.features = 0;
    out.inliers = 0;
    DisparityResponse response;
    response.fill(Vec6::Zero());
    if (input.given_T_w_c != nullptr) {
        window_.clear();
        const Pose T_w_c = take_given(input);
        finish(input, EgoStatus::kGiven, T_w_c, Mat6::Zero(), response, out);
        out.T_w_c = given_T_w_c_;
        return Status::kOk;
    }
    given_ = false;
    const MotionPrediction predicted = predict(input.time_us, input.motion);
    const Pose T_c_w_predicted = predicted.T_cur_prev * T_w_c_.inverse();
    Pose T_w_c = T_c_w_predicted.inverse();
    Mat6 motion_covariance = predicted.covariance;
    const bool images = input.has_images && input.features != nullptr;
    bool tracked = false;
    if (images) {
        for (const FeatureMeasurement& m : *input.features) {
            out.features += m.owner == kBackground && m.tracked ? 1 : 0;
        }
        Mat6 covariance;
        tracked = track(input, predicted, system, step, out, covariance);
        if (tracked) {
            T_w_c = window_.frames.back().T_c_w.inverse();
            motion_covariance = covariance;
            const int last = window_.frames.size() - 2;
            if (last >= 0) {
                response = motion_response(window_, window_.frames[last], window_.frames.back(), calibration_);
            }
        } else {
            restart(input, T_c_w_predicted);
        }
        if (needs_keyframe()) {
            make_keyframe();
        }
    }
    T_w_c.R = orthonormalised(T_w_c.R);
    remember(input, T_w_c);
    const EgoStatus status = tracked ? EgoStatus::kTracked : started_ ? EgoStatus::kPredicted : EgoStatus::kStart;
    finish(input, status, T_w_c, motion_covariance, response, out);
    return status == EgoStatus::kPredicted && images ? Status::kNotConverged : Status::kOk;
}

}  // namespace semtrack
