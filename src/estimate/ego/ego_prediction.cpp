#include "estimate/ego/ego_prediction.hpp"

#include <cmath>

#include "math/so3.hpp"

namespace semtrack {

namespace {

// Road vehicles, per second: what constant velocity, or speed and yaw rate alone, leave out.
constexpr double kAcceleration = 3.0;  // m/s^2
constexpr double kTurning = 0.3;       // rad/s
constexpr double kPitching = 0.1;      // rad/s, pitch and roll
constexpr double kSideways = 0.3;      // m/s, slip and heave
constexpr double kFloor_m = 0.01;      // bumps
constexpr double kFloor_rad = 0.002;
// A motion seen over a much shorter time says little: its noise would be blown up.
constexpr double kMaxShare = 20.0;

double square(double x) {
    return x * x;
}

}  // namespace

Mat6 adjoint(const Pose& T_a_b) {
    Mat6 A = Mat6::Zero();
    A.topLeftCorner<3, 3>() = T_a_b.R;
    A.bottomRightCorner<3, 3>() = T_a_b.R;
    A.topRightCorner<3, 3>() = skew(T_a_b.t) * T_a_b.R;
    return A;
}

MotionPrediction predict_from_vehicle(const VehicleMotion& motion, const Pose& T_v_c, double dt_s) {
    const bool finite = std::isfinite(motion.speed) && std::isfinite(motion.yaw_rate);
    const double way = finite ? motion.speed * dt_s : 0.0;
    const double turn = finite ? motion.yaw_rate * dt_s : 0.0;
    const Pose T_prev_cur_v{rot_z(turn), rot_z(0.5 * turn) * Vec3(way, 0.0, 0.0)};
    const Pose T_c_v = T_v_c.inverse();
    MotionPrediction out;
    out.T_cur_prev = T_c_v * T_prev_cur_v.inverse() * T_v_c;
    Vec6 variance;
    variance << square(kFloor_m + motion.sigma_speed * dt_s), square(kFloor_m + kSideways * dt_s),
        square(kFloor_m + kSideways * dt_s), square(kFloor_rad + kPitching * dt_s),
        square(kFloor_rad + kPitching * dt_s), square(kFloor_rad + motion.sigma_yaw_rate * dt_s);
    const Mat6 A = adjoint(T_c_v);
    out.covariance = A * Mat6(variance.asDiagonal()) * A.transpose();
    return out;
}

MotionPrediction predict_constant(const Pose& T_last, double last_dt_s, double dt_s) {
    MotionPrediction out;
    if (last_dt_s > 0.0) {
        const double share = dt_s / last_dt_s < kMaxShare ? dt_s / last_dt_s : kMaxShare;
        out.T_cur_prev = {so3_exp(share * so3_log(T_last.R)), share * T_last.t};
    }
    Vec6 variance;
    variance.head<3>().setConstant(square(kFloor_m + kAcceleration * dt_s * dt_s + kSideways * dt_s));
    variance.tail<3>().setConstant(square(kFloor_rad + kTurning * dt_s));
    out.covariance = variance.asDiagonal();
    return out;
}

}  // namespace semtrack
