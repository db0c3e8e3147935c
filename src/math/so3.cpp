#include "math/so3.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace semtrack {

namespace {
// Below this angle the series of sin(a)/a and (1 - cos(a))/a^2 are exact to rounding after three terms.
constexpr double kSmallAngle = 1e-3;
}  // namespace

Mat3 skew(const Vec3& w) {
    Mat3 S;
    S << 0.0, -w(2), w(1), w(2), 0.0, -w(0), -w(1), w(0), 0.0;
    return S;
}

Mat3 so3_exp(const Vec3& w) {
    const double angle2 = w(0) * w(0) + w(1) * w(1) + w(2) * w(2);
    const double angle = std::sqrt(angle2);
    double a = 1.0 - angle2 / 6.0 * (1.0 - angle2 / 20.0);
    double b = 0.5 - angle2 / 24.0 * (1.0 - angle2 / 30.0);
    if (angle > kSmallAngle) {
        const SinCos sc = sin_cos(angle);
        const SinCos half = sin_cos(0.5 * angle);
        a = sc.sin / angle;
        b = 2.0 * half.sin * half.sin / angle2;
    }
    const Mat3 W = skew(w);
    return Mat3::Identity() + a * W + b * (W * W);
}

Vec3 so3_log(const Mat3& R) {
    const Vec3 v{R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};  // 2 sin(angle) axis
    const double sin2 = std::sqrt(v(0) * v(0) + v(1) * v(1) + v(2) * v(2));
    const double cos2 = R(0, 0) + R(1, 1) + R(2, 2) - 1.0;
    const double angle = atan2_rad(sin2, cos2);
    if (angle < kSmallAngle) { return v * (0.5 * (1.0 + angle * angle / 6.0)); }
    if (sin2 > 1e-4) { return v * (angle / sin2); }
    // Near pi the axis comes from the symmetric part R + I = 2 axis axis^T: its longest column.
    int best = 0;
    for (int i = 1; i < 3; ++i) { best = R(i, i) > R(best, best) ? i : best; }
    Vec3 axis = R.col(best);
    axis(best) += 1.0;
    axis += Vec3(R.row(best).transpose());
    axis(best) += 1.0;
    axis /= std::sqrt(axis(0) * axis(0) + axis(1) * axis(1) + axis(2) * axis(2));
    const double sign = axis(0) * v(0) + axis(1) * v(1) + axis(2) * v(2) < 0.0 ? -1.0 : 1.0;
    return axis * (sign * angle);
}

Mat3 orthonormalised(const Mat3& R) {
    Mat3 Q = R;
    for (int k = 0; k < 2; ++k) {
        const Mat3 QtQ = Q.transpose() * Q;
        Q = 0.5 * Q * (3.0 * Mat3::Identity() - QtQ);
    }
    return Q;
}

Mat3 rot_z(double angle_rad) {
    const SinCos sc = sin_cos(angle_rad);
    Mat3 R;
    R << sc.cos, -sc.sin, 0.0, sc.sin, sc.cos, 0.0, 0.0, 0.0, 1.0;
    return R;
}

Pose perturbed_left(const Pose& T_c_w, const Vec6& xi) {
    const Mat3 dR = so3_exp(Vec3(xi(3), xi(4), xi(5)));
    return {orthonormalised(dR * T_c_w.R), dR * T_c_w.t + Vec3(xi(0), xi(1), xi(2))};
}

}  // namespace semtrack
