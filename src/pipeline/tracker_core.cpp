#include "pipeline/tracker_core.hpp"

#include <cmath>

#include "math/camera.hpp"
#include "math/so3.hpp"
#include "pipeline/output_builder.hpp"

namespace semtrack {

namespace {

constexpr double kMaxFocal_px = 20000.0;
constexpr double kMaxBaseline_m = 5.0;
constexpr int kMinImage_px = 64;

bool valid_camera(const PinholeCamera& c) {
    return std::isfinite(c.cx) && std::isfinite(c.cy) && c.fx > 1.0 && c.fx < kMaxFocal_px && c.fy > 1.0 &&
           c.fy < kMaxFocal_px;
}

bool valid_calibration(const Calibration& c) {
    const Pose T_v_c = to_pose(c.T_v_c);
    const Mat3 RtR = T_v_c.R.transpose() * T_v_c.R;
    const bool rotation = is_finite(T_v_c) && (RtR - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-3;
    return c.width >= kMinImage_px && c.width <= kMaxImageWidth && c.height >= kMinImage_px &&
           c.height <= kMaxImageHeight && valid_camera(c.left) && valid_camera(c.right) && valid_camera(c.detection) &&
           c.baseline_m > 0.01 && c.baseline_m < kMaxBaseline_m && rotation && std::isfinite(c.t_d_c[0]) &&
           std::isfinite(c.t_d_c[1]) && std::isfinite(c.t_d_c[2]) && std::isfinite(c.row_offset.constant) &&
           std::isfinite(c.row_offset.slope) && std::isfinite(c.row_offset.per_disparity);
}

bool valid_config(const Config& c) {
    return c.background_features >= 0 && c.background_features <= kMaxBackgroundFeatures && c.object_features >= 0 &&
           c.object_features <= kMaxObjectFeatures && c.camera_height_m > 0.1 && c.camera_height_m < 10.0 &&
           c.camera_height_sigma_m > 0.0;
}

}  // namespace

Status TrackerCore::init(const Config& config, const Calibration& calibration, FeatureExtractor* extractor,
                         StageObserver* observer, const ObjectTeam& team) {
    ready_ = false;
    if (!valid_calibration(calibration) || !valid_config(config) || !team.valid()) {
        return Status::kInvalidArgument;
    }
    config_ = config;
    calibration_ = calibration;
    observer_ = observer;
    started_ = false;
    frame_ = 0;
    last_image_frame_ = 0;
    time_us_ = 0;
    T_v_c_ = to_pose(calibration.T_v_c);
    T_v_c_.R = orthonormalised(T_v_c_.R);
    t_d_c_ = Vec3(calibration.t_d_c[0], calibration.t_d_c[1], calibration.t_d_c[2]);
    T_w_c_ = T_v_c_;
    level_.reset();
    ego_.init(calibration);
    ground_.init(config);
    road_shape_.reset();
    team_ = team;
    worker_.estimator.init(calibration, config);
    for (ObjectWorker* worker : team.more) {
        if (worker != nullptr) {
            worker->estimator.init(calibration, config);
        }
    }
    tracks_.reset();
    unplaced_.clear();
    matcher_.reset(config.matcher, extractor);
    external_.reset();
    health_ = Health{};
    ready_ = true;
    return Status::kOk;
}

bool TrackerCore::acceptable(const Input& input) const {
    if (!ready_ || (started_ && input.time_us <= time_us_)) {
        return false;
    }
    const auto fits = [this](const ImageView& image) {
        return image.empty() || (image.width == calibration_.width && image.height == calibration_.height &&
                                 image.stride >= image.width);
    };
    if (!fits(input.left) || !fits(input.right)) {
        return false;
    }
    if (input.motion != nullptr && !(std::isfinite(input.motion->speed) && std::isfinite(input.motion->yaw_rate) &&
                                     input.motion->sigma_speed > 0.0 && input.motion->sigma_yaw_rate > 0.0)) {
        return false;
    }
    return input.T_w_v == nullptr || is_finite(to_pose(*input.T_w_v));
}

Status TrackerCore::process(const Input& input, Output& output) {
    if (!acceptable(input)) {
        return Status::kInvalidArgument;
    }
    const double dt_s = started_ ? 1e-6 * static_cast<double>(input.time_us - time_us_) : 0.0;
    ++frame_;
    time_us_ = input.time_us;
    T_w_c_ = predict_ego(input);

    ground_.fade(dt_s);
    place_vehicle();
    predict_tracks();   // the state of every track at this frame
    take_lists(input);  // 1, 2: infer, associate, attach
    build_masks();      // 3
    set_priors();
    match(input);    // 4, 5
    reject();        // 6
    run_ego(input);  // 7
    learn_road();
    feed_features();
    solve_objects();  // 8
    align_objects();  // 9
    level_.update(T_w_c_.R * T_v_c_.R.transpose(), dt_s);
    update_lifecycle();  // 10

    count_health(input);
    build_output(output);
    started_ = true;
    return Status::kOk;
}

// Of the camera, relative to its first pose.
Pose TrackerCore::given_pose(const Input& input) const {
    return T_v_c_.inverse() * to_pose(*input.T_w_v) * T_v_c_;
}

Pose TrackerCore::predict_ego(const Input& input) const {
    if (input.T_w_v != nullptr) {
        return T_v_c_ * ego_.camera_pose(given_pose(input));
    }
    if (!started_) {
        return T_v_c_;
    }
    return T_w_c_ * ego_.predicted_motion(input.time_us, input.motion).inverse();
}

void TrackerCore::run_ego(const Input& input) {
    begin(Stage::kEgo);
    Pose given;
    EgoInput in;
    in.time_us = time_us_;
    in.frame = frame_;
    in.features = &features_;
    in.has_images = features_usable_;
    in.motion = input.motion;
    if (input.T_w_v != nullptr) {
        given = given_pose(input);
        in.given_T_w_c = &given;
    }
    if (ego_.process(in, worker_.system, worker_.step, ego_result_) != Status::kOk) {
        ++health_.solver_failures;
    }
    T_w_c_ = T_v_c_ * ego_result_.T_w_camera;
    for (const std::int16_t slot : ego_result_.outliers) {
        drop_feature(kBackground, slot);
    }
    end(Stage::kEgo);
}

void TrackerCore::count_health(const Input& input) {
    ++health_.frames;
    health_.no_right_image = input.right.empty();
    if (input.left.empty()) {
        ++health_.frames_dropped;
    } else if (input.right.empty()) {
        ++health_.frames_without_right;
    }
    health_.row_offset_px = static_cast<float>(matcher_.row_offset_px());
    health_.ego_degraded = ego_result_.status == EgoStatus::kPredicted;
}

void TrackerCore::build_output(Output& output) {
    EgoView view;
    view.T_w_c = T_w_c_;
    view.T_w_v = T_w_c_ * T_v_c_.inverse();
    EgoState& ego = output.ego;
    ego.time_us = time_us_;
    ego.status = ego_result_.status;
    ego.T_w_v = to_rigid_transform(T_v_c_ * ego_result_.T_w_c * T_v_c_.inverse());
    describe_ego_motion(ego_result_, T_v_c_, ego);
    ego.rejected = features_usable_ ? rejection_.rejected(kBackground) : 0;
    view.sigma_speed = ego.sigma_speed;
    view.sigma_yaw_rate = ego.sigma_yaw_rate;
    output.objects.clear();
    for (int s = 0; s < kMaxObjects; ++s) {
        Track& track = tracks_[s];
        if (!track.alive) {
            continue;
        }
        const bool lost = track.status == TrackStatus::kLost;
        TrackedObject object;
        if (!describe_track(track, s, view, calibration_, object)) {
            tracks_.remove(s);  // a state that is not finite is worth nothing
            ground_.release(s);
            continue;
        }
        object.rejected = features_usable_ ? rejection_.rejected(s + 1) : 0;
        if (!lost || track.confirmed) {
            (void)output.objects.try_push_back(object);
        }
        if (lost) {
            tracks_.remove(s);
            ground_.release(s);
        }
    }
    describe_points(output);
    output.health = health_;
}

void TrackerCore::describe_points(Output& output) const {
    output.points.clear();
    for (const FeatureMeasurement& m : features_) {
        SparsePoint point;
        point.owner = m.owner;
        point.id = m.id;
        point.u = m.u;
        point.v = m.v;
        const double d = disparity(calibration_, static_cast<double>(m.u), static_cast<double>(m.u_right));
        if (m.stereo && d > 1.0) {
            const Vec3 x_c = bearing(calibration_.left, static_cast<double>(m.u), static_cast<double>(m.v)) *
                             depth_from_disparity(calibration_, d);
            const Vec3 x_w = T_w_c_ * x_c;
            point.has_position = true;
            for (int i = 0; i < 3; ++i) {
                point.position_w[static_cast<std::size_t>(i)] = static_cast<float>(x_w(i));
            }
        }
        (void)output.points.try_push_back(point);
    }
}

}  // namespace semtrack
