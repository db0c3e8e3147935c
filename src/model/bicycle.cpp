#include "model/bicycle.hpp"

#include "math/trig.hpp"

namespace semtrack {

namespace {

double clamped_steering(double delta) {
    return delta > kMaxSteering_rad ? kMaxSteering_rad : delta < -kMaxSteering_rad ? -kMaxSteering_rad : delta;
}

}  // namespace

ObjectState bicycle_step(const ObjectState& x, double wheelbase_m, double dt_s) {
    const double turn = x.v * dt_s * tan_rad(clamped_steering(x.delta)) / wheelbase_m;
    const SinCos before = sin_cos(x.theta);
    const SinCos middle = sin_cos(x.theta + 0.5 * turn);
    const SinCos after = sin_cos(x.theta + turn);
    const double half = 0.5 * wheelbase_m;
    ObjectState next = x;
    next.p(0) += x.v * dt_s * middle.cos + half * (after.cos - before.cos);
    next.p(1) += x.v * dt_s * middle.sin + half * (after.sin - before.sin);
    next.theta = wrap_angle(x.theta + turn);
    return next;
}

Mat6 bicycle_jacobian(const ObjectState& x, double wheelbase_m, double dt_s) {
    const double delta = clamped_steering(x.delta);
    const double t = tan_rad(delta);
    const double turn = x.v * dt_s * t / wheelbase_m;
    const double dturn_dv = dt_s * t / wheelbase_m;
    const bool bent = x.delta <= kMaxSteering_rad && x.delta >= -kMaxSteering_rad;
    const double dturn_ddelta = bent ? x.v * dt_s * (1.0 + t * t) / wheelbase_m : 0.0;
    const SinCos before = sin_cos(x.theta);
    const SinCos middle = sin_cos(x.theta + 0.5 * turn);
    const SinCos after = sin_cos(x.theta + turn);
    const double half = 0.5 * wheelbase_m;
    const double s = x.v * dt_s;
    // dp/dturn at fixed v and theta
    const double dx_dturn = -0.5 * s * middle.sin - half * after.sin;
    const double dy_dturn = 0.5 * s * middle.cos + half * after.cos;
    Mat6 J = Mat6::Identity();
    J(0, 3) = -s * middle.sin - half * (after.sin - before.sin);
    J(1, 3) = s * middle.cos + half * (after.cos - before.cos);
    J(0, 4) = dt_s * middle.cos + dx_dturn * dturn_dv;
    J(1, 4) = dt_s * middle.sin + dy_dturn * dturn_dv;
    J(0, 5) = dx_dturn * dturn_ddelta;
    J(1, 5) = dy_dturn * dturn_ddelta;
    J(3, 4) = dturn_dv;
    J(3, 5) = dturn_ddelta;
    return J;
}

}  // namespace semtrack
