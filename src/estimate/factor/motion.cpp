#include "estimate/factor/motion.hpp"

#include <cmath>

#include "math/trig.hpp"
#include "model/bicycle.hpp"

namespace semtrack {

namespace {

constexpr double kShortestStep_s = 1e-3;
constexpr double kShortestStep_m = 1e-3;

ObjectState straight_step(const ObjectState& x, double dt_s, bool derivatives, Mat6& J) {
    const SinCos h = sin_cos(x.theta);
    ObjectState next = x;
    next.p += Vec3(h.cos, h.sin, 0.0) * (x.v * dt_s);
    if (derivatives) {
        J = Mat6::Identity();
        J(0, 3) = -x.v * dt_s * h.sin;
        J(1, 3) = x.v * dt_s * h.cos;
        J(0, 4) = dt_s * h.cos;
        J(1, 4) = dt_s * h.sin;
    }
    return next;
}

ObjectState stepped(const ObjectState& x, double dt_s, const MotionModelSpec& spec, bool derivatives, Mat6& J) {
    if (spec.standing) {
        ObjectState next = x;
        next.v = 0.0;
        if (derivatives) {
            J = Mat6::Identity();
            J(4, 4) = 0.0;
        }
        return next;
    }
    if (spec.model == MotionModel::kPedestrian) {
        return straight_step(x, dt_s, derivatives, J);
    }
    if (derivatives) {
        J = bicycle_jacobian(x, spec.wheelbase_m, dt_s);
    }
    return bicycle_step(x, spec.wheelbase_m, dt_s);
}

}  // namespace

void set_ego_step(const Pose& T_before_l, const Pose& T_after_l, MotionModelSpec& spec) {
    const Vec3 d = T_before_l.R.transpose() * T_before_l.t - T_after_l.R.transpose() * T_after_l.t;
    spec.ego_step_m = std::sqrt(d(0) * d(0) + d(1) * d(1));
    spec.ego_direction = Vec3(1.0, 0.0, 0.0);
    if (spec.ego_step_m > kShortestStep_m) {
        spec.ego_direction = Vec3(d(0) / spec.ego_step_m, d(1) / spec.ego_step_m, 0.0);
    }
}

void motion_residual(const ObjectState& before, const ObjectState& after, double dt_s, const MotionModelSpec& spec,
                     bool derivatives, Vec6& r, Mat6& J_before, Mat6& J_after) {
    const ObjectState next = stepped(before, dt_s, spec, derivatives, J_before);
    const double root_dt = std::sqrt(dt_s > kShortestStep_s ? dt_s : kShortestStep_s);
    const MotionNoise& n = spec.noise;
    const double along = n.position * root_dt;
    const double turned = n.ego_across * spec.ego_step_m;
    const double across = std::sqrt(along * along + turned * turned);
    const double ux = spec.ego_direction(0);
    const double uy = spec.ego_direction(1);
    Mat6 W = Mat6::Zero();
    W(0, 0) = ux / along;
    W(0, 1) = uy / along;
    W(1, 0) = -uy / across;
    W(1, 1) = ux / across;
    W(2, 2) = 1.0 / (n.height * root_dt);
    W(3, 3) = 1.0 / (n.heading * root_dt);
    W(4, 4) = 1.0 / (n.speed * root_dt);
    W(5, 5) = 1.0 / (n.steering * root_dt);
    Vec6 d;
    d << after.p - next.p, wrap_angle(after.theta - next.theta), after.v - next.v, after.delta - next.delta;
    r = W * d;
    if (derivatives) {
        J_before = -(W * J_before);
        J_after = W;
    }
}

}  // namespace semtrack
