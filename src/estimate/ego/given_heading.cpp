#include "estimate/ego/given_heading.hpp"

#include <cmath>

#include "math/robust.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr double kAngleSigma = 0.0175;  // 1 degree
constexpr double kLever_m = 1.0;        // a camera behind the windscreen
constexpr double kLeverSigma_m = 1.0;
constexpr double kStepSigma = 0.009;  // of one step: slip, bumps, jumps of the position
constexpr double kHuber = 2.0;
constexpr double kShortest_m = 0.3;    // below, the position's noise is the direction
constexpr double kStraightest = 0.9;   // share of the step along V's x
constexpr double kTightestTurn = 0.1;  // rad / m

}  // namespace

void GivenHeading::reset() {
    x_ = Vec2(0.0, kLever_m);
    covariance_ = Vec2(kAngleSigma * kAngleSigma, kLeverSigma_m * kLeverSigma_m).asDiagonal();
}

void GivenHeading::update(const Pose& T_prev_cur, const Mat3& R_v_c) {
    const Vec3 step = R_v_c * T_prev_cur.t;
    const double length = std::sqrt(step.dot(step));
    const double turned = (R_v_c * so3_log(T_prev_cur.R))(2);
    const double curvature = turned / (length > kShortest_m ? length : kShortest_m);
    if (!(length > kShortest_m) || !(step(0) > kStraightest * length) ||
        !(curvature * curvature < kTightestTurn * kTightestTurn)) {
        return;
    }
    const Vec2 h(1.0, curvature);
    const double r = step(1) / length - 0.5 * turned - h.dot(x_);
    const Vec2 Ph = covariance_ * h;
    const double spread = h.dot(Ph);
    const double noise = kStepSigma * kStepSigma;
    const double variance = spread + noise / huber(r * r / (spread + noise), kHuber).weight;
    x_ += (r / variance) * Ph;
    covariance_ -= (1.0 / variance) * (Ph * Ph.transpose());
}

Mat3 GivenHeading::correction(const Mat3& R_v_c) const {
    return so3_exp(Vec3(x_(0) * R_v_c.row(2).transpose()));
}

}  // namespace semtrack
