#include "estimate/ego/ego_estimator.hpp"

#include <cmath>

#include "math/camera.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kMinInliers = 10;
constexpr int kWindowIterations = 5;
constexpr std::uint32_t kKeyframeDistance = 3;  // frames
constexpr double kKeyframeSurvival = 0.7;
constexpr double kKeyframeFlow_px = 2.0;  // a standing camera makes no keyframes
constexpr double kMinBirthDisparity_px = 1.5;
constexpr double kNearDisparity_px = 20.0;  // below, a disparity is trusted less: far points hold the rotation
constexpr double kFarFactor = 4.0;
constexpr double kCull = 5.0;                     // sigmas
constexpr double kPredictedSpeedSigma = 1.0;      // m/s per predicted frame, constant velocity
constexpr double kPredictedRotationSigma = 0.02;  // rad
// The landmarks of neighbouring frames are the same: the fit of one frame alone is too sure of itself.
constexpr double kCovarianceInflation = 2.0;

Mat6 adjoint(const Pose& T) {
    Mat6 A = Mat6::Zero();
    A.topLeftCorner<3, 3>() = T.R;
    A.bottomRightCorner<3, 3>() = T.R;
    A.topRightCorner<3, 3>() = skew(T.t) * T.R;
    return A;
}

}  // namespace

void EgoEstimator::init(const Calibration& calibration) {
    calibration_ = calibration;
    T_v_c_ = to_pose(calibration.T_v_c);
    window_.clear();
    history_.reset();
    started_ = false;
    T_w_c_ = Pose{};
    T_cur_prev_ = Pose{};
    dt_s_ = 0.0;
    covariance_.setZero();
    last_keyframe_ = 0;
    keyframe_landmarks_ = 0;
}

Pose EgoEstimator::predicted_motion(std::int64_t time_us, const VehicleMotion* motion) const {
    const double dt_s = 1e-6 * static_cast<double>(time_us - time_us_);
    if (!started_ || !(dt_s > 0.0)) {
        return Pose{};
    }
    if (motion != nullptr) {
        const Pose T_prev_cur_v{rot_z(motion->yaw_rate * dt_s),
                                rot_z(0.5 * motion->yaw_rate * dt_s) * Vec3(motion->speed * dt_s, 0.0, 0.0)};
        return T_v_c_.inverse() * T_prev_cur_v.inverse() * T_v_c_;
    }
    if (!(dt_s_ > 0.0)) {
        return Pose{};
    }
    const double share = dt_s / dt_s_;
    return {so3_exp(share * so3_log(T_cur_prev_.R)), share * T_cur_prev_.t};
}

void EgoEstimator::drop_frame(int index) {
    const auto column = static_cast<std::size_t>(window_.frames[index].column);
    for (EgoLandmark& landmark : window_.landmarks) {
        landmark.seen[column].valid = false;
    }
    window_.frames.erase(index);
}

void EgoEstimator::push_frame(const EgoInput& input, const Pose& T_c_w) {
    if (!window_.frames.empty() && !window_.frames.back().keyframe) {
        drop_frame(window_.frames.size() - 1);
    }
    if (window_.frames.size() == kEgoFrames) {
        drop_frame(0);
    }
    bool used[kEgoFrames] = {};
    for (const EgoFrame& f : window_.frames) {
        used[f.column] = true;
    }
    EgoFrame frame;
    frame.frame = input.frame;
    frame.T_c_w = T_c_w;
    for (int c = kEgoFrames - 1; c >= 0; --c) {
        frame.column = used[c] ? frame.column : c;
    }
    for (EgoLandmark& landmark : window_.landmarks) {
        landmark.seen[static_cast<std::size_t>(frame.column)].valid = false;
    }
    (void)window_.frames.try_push_back(frame);
}

void EgoEstimator::take_features(const FrameFeatures& features) {
    const auto column = static_cast<std::size_t>(window_.frames.back().column);
    for (const FeatureMeasurement& m : features) {
        if (m.owner != kBackground || m.slot < 0 || m.slot >= kMaxBackgroundFeatures) {
            continue;
        }
        EgoLandmark& landmark = window_.landmarks[static_cast<std::size_t>(m.slot)];
        if (landmark.id != m.id) {
            landmark.id = m.id;
            landmark.valid = false;
            for (EgoObservation& o : landmark.seen) {
                o.valid = false;
            }
        }
        EgoObservation& o = landmark.seen[column];
        o.valid = true;
        o.stereo = m.stereo;
        o.u = m.u;
        o.v = m.v;
        o.u_right = m.u_right;
        o.sigma_px = m.sigma_px;
        const double d = disparity(calibration_, static_cast<double>(m.u), static_cast<double>(m.u_right));
        o.sigma_right_px = m.sigma_right_px * static_cast<float>(d < kNearDisparity_px ? kFarFactor : 1.0);
    }
}

// Landmarks start at the stereo point of the frame that first measures one.
void EgoEstimator::give_birth() {
    const EgoFrame& frame = window_.frames.back();
    const Pose T_w_c = frame.T_c_w.inverse();
    for (EgoLandmark& landmark : window_.landmarks) {
        const EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
        if (landmark.valid || !o.valid || !o.stereo) {
            continue;
        }
        const double d = disparity(calibration_, static_cast<double>(o.u), static_cast<double>(o.u_right));
        if (!(d > kMinBirthDisparity_px)) {
            continue;
        }
        landmark.x_w = T_w_c * (bearing(calibration_.left, static_cast<double>(o.u), static_cast<double>(o.v)) *
                                depth_from_disparity(calibration_, d));
        landmark.valid = true;
    }
}

void EgoEstimator::solve_window(NormalEquations& system, SolverStep& step) {
    problem_.begin(window_, calibration_);
    if (problem_.free_frames() < 1 || problem_.landmarks() < kMinInliers) {
        return;
    }
    LmOptions options;
    options.iterations = kWindowIterations;
    const LmReport report = levenberg_marquardt(problem_, options, system, step);
    if (report.accepted > 0) {
        problem_.store(window_);
    }
}

void EgoEstimator::cull(EgoResult& out) {
    for (int s = 0; s < kMaxBackgroundFeatures; ++s) {
        EgoLandmark& landmark = window_.landmarks[static_cast<std::size_t>(s)];
        if (!landmark.valid) {
            continue;
        }
        bool refused = false;
        for (const EgoFrame& frame : window_.frames) {
            EgoObservation& o = landmark.seen[static_cast<std::size_t>(frame.column)];
            if (!o.valid) {
                continue;
            }
            StereoPointResidual z;
            const bool ahead = stereo_point_residual(calibration_, frame.T_c_w * landmark.x_w, o.measurement(), false,
                                                     z) == Status::kOk;
            if (ahead && z.r.dot(z.r) < kCull * kCull) {
                continue;
            }
            o.valid = false;
            refused = refused || &frame == &window_.frames.back();
        }
        if (refused) {
            landmark.valid = false;
            for (EgoObservation& o : landmark.seen) {
                o.valid = false;
            }
            (void)out.outliers.try_push_back(static_cast<std::int16_t>(s));
        }
    }
}

bool EgoEstimator::needs_keyframe() const {
    const EgoFrame& now = window_.frames.back();
    if (window_.frames.size() < 2) {
        return true;
    }
    const EgoFrame& key = window_.frames[window_.frames.size() - 2];
    int shared = 0;
    double flow = 0.0;
    for (const EgoLandmark& landmark : window_.landmarks) {
        const EgoObservation& a = landmark.seen[static_cast<std::size_t>(key.column)];
        const EgoObservation& b = landmark.seen[static_cast<std::size_t>(now.column)];
        if (!landmark.valid || !a.valid || !b.valid) {
            continue;
        }
        ++shared;
        flow += std::fabs(static_cast<double>(a.u - b.u)) + std::fabs(static_cast<double>(a.v - b.v));
    }
    if (shared < kKeyframeSurvival * keyframe_landmarks_) {
        return true;
    }
    return now.frame - key.frame >= kKeyframeDistance && flow > kKeyframeFlow_px * shared;
}

void EgoEstimator::finish(const EgoInput& input, EgoStatus status, const Pose& T_w_c, const Mat6& motion_covariance,
                          EgoResult& out) {
    out.status = status;
    out.dt_s = started_ ? 1e-6 * static_cast<double>(input.time_us - time_us_) : 0.0;
    out.T_w_c = T_w_c;
    out.T_prev_cur = started_ ? T_w_c_.inverse() * T_w_c : Pose{};
    T_cur_prev_ = out.T_prev_cur.inverse();
    dt_s_ = out.dt_s;
    out.motion_covariance = motion_covariance;
    const Mat6 A = adjoint(T_cur_prev_);
    covariance_ = A * covariance_ * A.transpose() + motion_covariance;
    if (status == EgoStatus::kGiven) {
        covariance_.setZero();
    }
    out.covariance = covariance_;
    T_w_c_ = T_w_c;
    time_us_ = input.time_us;
    started_ = true;
}

Status EgoEstimator::process(const EgoInput& input, NormalEquations& system, SolverStep& step, EgoResult& out) {
    out.outliers.clear();
    out.features = 0;
    out.inliers = 0;
    const bool first = !started_;
    if (input.given_T_w_c != nullptr) {
        window_.clear();
        history_.add(input.frame, input.time_us, *input.given_T_w_c, input.frame);
        finish(input, EgoStatus::kGiven, *input.given_T_w_c, Mat6::Zero(), out);
        return Status::kOk;
    }
    const Pose T_c_w_predicted = predicted_motion(input.time_us, input.motion) * T_w_c_.inverse();
    Pose T_c_w = T_c_w_predicted;
    PoseFit fit;
    bool tracked = false;
    if (input.has_images && input.features != nullptr) {
        push_frame(input, T_c_w);
        take_features(*input.features);
        for (const FeatureMeasurement& m : *input.features) {
            out.features += m.owner == kBackground && m.tracked ? 1 : 0;
        }
        tracked = !first && fit_pose(window_, window_.frames.back().column, calibration_, T_c_w, fit) &&
                  fit.inliers >= kMinInliers;
        if (!tracked) {
            T_c_w = T_c_w_predicted;
        }
        window_.frames.back().T_c_w = T_c_w;
        if (tracked) {
            solve_window(system, step);
            cull(out);
        }
        T_c_w = window_.frames.back().T_c_w;
        if (!tracked && !first) {
            // Nothing of the old window is seen any more: a new one starts at the predicted pose.
            for (EgoLandmark& landmark : window_.landmarks) {
                landmark.valid = false;
            }
        }
        give_birth();
    }
    out.inliers = tracked ? fit.inliers : 0;
    const EgoStatus status = first ? EgoStatus::kStart : tracked ? EgoStatus::kTracked : EgoStatus::kPredicted;
    Mat6 motion = kCovarianceInflation * fit.covariance;
    if (!tracked) {
        const double dt_s = first ? 0.0 : 1e-6 * static_cast<double>(input.time_us - time_us_);
        Vec6 variance = Vec6::Constant(kPredictedSpeedSigma * kPredictedSpeedSigma * dt_s * dt_s);
        variance.tail<3>() = Vec3::Constant(kPredictedRotationSigma * kPredictedRotationSigma * dt_s);
        motion = variance.asDiagonal();
    }
    const Pose T_w_c{orthonormalised(T_c_w.R.transpose()), -(T_c_w.R.transpose() * T_c_w.t)};
    const bool keyframe = input.has_images && (first || needs_keyframe());
    history_.add(input.frame, input.time_us, T_w_c, keyframe || last_keyframe_ == 0 ? input.frame : last_keyframe_);
    for (const EgoFrame& frame : window_.frames) {
        if (frame.keyframe) {
            history_.revise(frame.frame, frame.T_c_w.inverse());
        }
    }
    if (keyframe) {
        window_.frames.back().keyframe = true;
        last_keyframe_ = input.frame;
        keyframe_landmarks_ = 0;
        for (const EgoLandmark& landmark : window_.landmarks) {
            const bool seen = landmark.seen[static_cast<std::size_t>(window_.frames.back().column)].valid;
            keyframe_landmarks_ += landmark.valid && seen ? 1 : 0;
        }
    }
    finish(input, status, T_w_c, motion, out);
    return status == EgoStatus::kPredicted && input.has_images ? Status::kNotConverged : Status::kOk;
}

}  // namespace semtrack
