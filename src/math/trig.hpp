// Own trigonometry: libm's differs between targets (and between CPUs of one), + - * / sqrt do not.
// Error bounds against long double are in docs/frames.md and tested in tests/math.
#ifndef SEMTRACK_MATH_TRIG_HPP
#define SEMTRACK_MATH_TRIG_HPP

namespace semtrack {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 6.28318530717958647693;

struct SinCos {
    double sin;
    double cos;
};

/// |x| up to 1e5 rad: absolute error below 4e-16. Not finite or beyond: {0, 1}.
[[nodiscard]] SinCos sin_cos(double x_rad);
/// |x| below pi/2.
[[nodiscard]] double tan_rad(double x_rad);
/// Four quadrants, in [-pi, pi]; atan2(0, 0) = 0. Relative error below 4e-16.
[[nodiscard]] double atan2_rad(double y, double x);
/// x in [-1, 1], clamped.
[[nodiscard]] double asin_rad(double x);
/// e^x for x in [-700, 700], clamped; relative error below 1e-15.
[[nodiscard]] double exp_real(double x);
/// Natural logarithm of x > 0; 0 for other x.
[[nodiscard]] double log_real(double x);
/// Wrapped to [-pi, pi).
[[nodiscard]] double wrap_angle(double x_rad);

}  // namespace semtrack

#endif
