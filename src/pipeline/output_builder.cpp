#include "pipeline/output_builder.hpp"

#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"
#include "pipeline/ranking.hpp"

namespace semtrack {

namespace {

constexpr double kMovingSpeed = 0.5;  // m/s
constexpr int kYoung_frames = 3;      // too early to say how it moves

std::array<double, 3> array3(const Vec3& x) {
    return {x(0), x(1), x(2)};
}

double root(double variance) {
    return variance > 0.0 ? std::sqrt(variance) : 0.0;
}

std::array<double, 3> root_diagonal(const Mat3& C) {
    return {root(C(0, 0)), root(C(1, 1)), root(C(2, 2))};
}

MovementState movement(const Track& track, double yaw_v) {
    const double v = track.window.newest().state.v;
    if (track.window.standing || std::fabs(v) < kMovingSpeed) {
        return track.age < kYoung_frames ? MovementState::kUnknown : MovementState::kStanding;
    }
    if (v * v < track.window.covariance(4, 4)) {
        return MovementState::kUnknown;  // a speed within its own sigma of none
    }
    if (v < 0.0) {
        return MovementState::kReversing;
    }
    return sin_cos(yaw_v).cos < -0.5 ? MovementState::kOncoming : MovementState::kMoving;
}

/// Velocity over ground = velocity in the window + what the ego's speed and yaw rate are off by: e_x ds + dw x r, with
/// r the object's place in V. Each adds a rank-one part; sigma_speed is the part along the heading.
void describe_velocity_sigmas(double v, const Mat6& C, const EgoView& ego, const Vec3& heading_v, TrackedObject& o) {
    const double hx = heading_v(0);
    const double hy = heading_v(1);
    const double along2 = C(4, 4);
    const double across = v * o.sigma_yaw;
    const double turn_x = -ego.sigma_yaw_rate * o.position_v[1];
    const double turn_y = ego.sigma_yaw_rate * o.position_v[0];
    const double ego_along = ego.sigma_speed * hx;
    const double turn_along = turn_x * hx + turn_y * hy;
    o.sigma_speed = root(along2 + ego_along * ego_along + turn_along * turn_along);
    o.sigma_velocity_v = {
        root(along2 * hx * hx + across * across * hy * hy + ego.sigma_speed * ego.sigma_speed + turn_x * turn_x),
        root(along2 * hy * hy + across * across * hx * hx + turn_y * turn_y)};
}

void describe_motion(const Track& track, const EgoView& ego, const Mat3& R_w_l, TrackedObject& o) {
    const ObjectState& x = track.window.newest().state;
    const ClassPrior& prior = class_prior(track.window.object_class);
    const SinCos h = sin_cos(x.theta);
    const Vec3 heading_w = R_w_l * Vec3(h.cos, h.sin, 0.0);
    const Vec3 heading_v = ego.T_w_v.R.transpose() * heading_w;
    o.yaw_w = wrap_angle(atan2_rad(heading_w(1), heading_w(0)));
    o.yaw_v = wrap_angle(atan2_rad(heading_v(1), heading_v(0)));
    o.speed = x.v;
    o.velocity_v = {x.v * heading_v(0), x.v * heading_v(1)};
    const Mat6& C = track.window.covariance;
    o.sigma_yaw = root(C(3, 3));
    describe_velocity_sigmas(x.v, C, ego, heading_v, o);
    if (prior.motion == MotionModel::kVehicle) {
        const double wheelbase = prior.wheelbase_ratio * track.window.size_m(0);
        const double t = tan_rad(x.delta);
        o.steering = x.delta;
        o.yaw_rate = x.v * t / wheelbase;
        const double by_delta = x.v * (1.0 + t * t) / wheelbase;
        const double by_v = t / wheelbase;
        o.sigma_yaw_rate =
            root(by_delta * by_delta * C(5, 5) + by_v * by_v * C(4, 4) + ego.sigma_yaw_rate * ego.sigma_yaw_rate);
    }
}

/// The 2D box in the processed left image: the detection's, moved by what the projected box moves between the two
/// cameras, or the projected one.
void describe_box(const Track& track, const Pose& T_c_o, const Calibration& calibration, TrackedObject& o) {
    o.box_valid = false;
    o.truncation = track.truncation;
    o.occlusion = track.occlusion;
    Box2d projected;
    if (projected_box(calibration.left, T_c_o, track.window.size_m, projected) != Status::kOk) {
        return;
    }
    Box2d box = projected;
    if (track.hit_now) {
        const Vec3 t_d_c(calibration.t_d_c[0], calibration.t_d_c[1], calibration.t_d_c[2]);
        Box2d in_detection;
        if (projected_box(calibration.detection, {T_c_o.R, T_c_o.t + t_d_c}, track.window.size_m, in_detection) ==
            Status::kOk) {
            box = {track.box.left + projected.left - in_detection.left,
                   track.box.top + projected.top - in_detection.top,
                   track.box.right + projected.right - in_detection.right,
                   track.box.bottom + projected.bottom - in_detection.bottom};
        }
    }
    o.box_valid = clip_box(box, calibration.width, calibration.height, o.box);
}

bool finite_object(const TrackedObject& o) {
    double sum = o.yaw_w + o.yaw_v + o.speed + o.steering + o.yaw_rate + o.sigma_yaw + o.sigma_speed + o.score;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum += o.position_w[k] + o.position_v[k] + o.size[k] + o.sigma_position_w[k] + o.sigma_position_v[k];
    }
    return std::isfinite(sum) && std::isfinite(o.velocity_v[0] + o.velocity_v[1]) && std::isfinite(o.sigma_yaw_rate);
}

}  // namespace

void describe_ego_motion(const EgoResult& result, const Pose& T_v_c, EgoState& out) {
    out.features = result.features;
    out.inliers = result.inliers;
    const Pose T_v_prev_cur = T_v_c * result.T_prev_cur * T_v_c.inverse();
    // Covariances of (translation, rotation) in the camera -> (rotation, translation) in V.
    Mat6 A = Mat6::Zero();
    A.topRightCorner<3, 3>() = T_v_c.R;
    A.bottomLeftCorner<3, 3>() = T_v_c.R;
    A.bottomRightCorner<3, 3>() = skew(T_v_c.t) * T_v_c.R;
    const Mat6 C = A * result.covariance * A.transpose();
    for (int r = 0; r < 6; ++r) {
        for (int c = 0; c < 6; ++c) {
            out.covariance[static_cast<std::size_t>(6 * r + c)] = C(r, c);
        }
    }
    out.speed = out.yaw_rate = out.sigma_speed = out.sigma_yaw_rate = 0.0;
    if (!(result.dt_s > 0.0)) {
        return;
    }
    const Mat6 M = A * result.motion_covariance * A.transpose();
    out.speed = T_v_prev_cur.t(0) / result.dt_s;
    out.yaw_rate = so3_log(T_v_prev_cur.R)(2) / result.dt_s;
    out.sigma_speed = root(M(3, 3)) / result.dt_s;
    out.sigma_yaw_rate = root(M(2, 2)) / result.dt_s;
}

bool describe_track(const Track& track, int slot, const EgoView& ego, const Calibration& calibration,
                    TrackedObject& out) {
    TrackedObject o;
    const ObjectWindow& window = track.window;
    const ObjectFrame& frame = window.newest();
    const Mat3 R_w_l = window.R_l_w.transpose();
    o.id = track.id;
    o.slot = slot;
    o.object_class = window.object_class;
    o.status = track.status;
    o.existence = track.existence;
    o.age = track.age;
    o.features = track.features;
    o.has_heading = class_prior(window.object_class).has_heading;
    const Vec3 p_w = R_w_l * frame.state.p;
    o.position_w = array3(p_w);
    o.position_v = array3(ego.T_w_v.inverse() * p_w);
    const Mat3 C = window.covariance.topLeftCorner<3, 3>();
    const Mat3 C_w = R_w_l * C * window.R_l_w;
    o.sigma_position_w = root_diagonal(C_w);
    o.sigma_position_v = root_diagonal(ego.T_w_v.R.transpose() * C_w * ego.T_w_v.R);
    o.size = array3(window.size_m);
    o.sigma_size = root_diagonal(window.size_covariance);
    describe_motion(track, ego, R_w_l, o);
    o.movement = movement(track, o.yaw_v);
    o.score = ranking_score(track);
    Pose T_l_o = frame.state.T_l_o();
    const Pose T_c_w = ego.T_w_c.inverse();
    const Pose T_c_l{T_c_w.R * R_w_l, T_c_w.t};
    if (!o.has_heading) {
        const Vec3 camera_l = -(T_c_l.R.transpose() * T_c_l.t);
        T_l_o.R = rot_z(atan2_rad(camera_l(1) - frame.state.p(1), camera_l(0) - frame.state.p(0)));
    }
    describe_box(track, T_c_l * T_l_o, calibration, o);
    if (!finite_object(o)) {
        return false;
    }
    out = o;
    return true;
}

}  // namespace semtrack
