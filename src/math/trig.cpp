#include "math/trig.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace semtrack {

namespace {

// pi/2 in three parts of at most 33 bits each: k * part is exact for |k| < 2^20 (Cody, Waite 1980).
constexpr double kHalfPi1 = 1.57079632673412561417e+00;
constexpr double kHalfPi2 = 6.07710050630396597660e-11;
constexpr double kHalfPi3 = 2.02226624879595063154e-21;
constexpr double kTwoOverPi = 6.36619772367581382433e-01;
constexpr double kMaxAngle_rad = 1e5;

// Taylor polynomials on |x| <= pi/4: the first omitted term is below 2^-56 relative.
double sin_poly(double x) {
    const double z = x * x;
    double p = 1.0 / 355687428096000.0;
    p = -1.0 / 1307674368000.0 + z * p;
    p = 1.0 / 6227020800.0 + z * p;
    p = -1.0 / 39916800.0 + z * p;
    p = 1.0 / 362880.0 + z * p;
    p = -1.0 / 5040.0 + z * p;
    p = 1.0 / 120.0 + z * p;
    p = -1.0 / 6.0 + z * p;
    return x + x * (z * p);
}

double cos_poly(double x) {
    const double z = x * x;
    double p = 1.0 / 20922789888000.0;
    p = -1.0 / 87178291200.0 + z * p;
    p = 1.0 / 479001600.0 + z * p;
    p = -1.0 / 3628800.0 + z * p;
    p = 1.0 / 40320.0 + z * p;
    p = -1.0 / 720.0 + z * p;
    p = 1.0 / 24.0 + z * p;
    const double h = 0.5 * z;
    const double w = 1.0 - h;
    return w + (((1.0 - w) - h) + z * z * p);
}

// atan on |x| <= tan(pi/16): alternating series, first omitted term below 2^-57 relative.
double atan_series(double x) {
    const double z = x * x;
    double p = 1.0 / 23.0;
    for (int n = 21; n >= 3; n -= 2) { p = 1.0 / static_cast<double>(n) - z * p; }
    return x - x * (z * p);
}

constexpr double kTanPi16 = 1.98912367379658006912e-01;   // tan(pi/16)
constexpr double kTanPi8 = 4.14213562373095048802e-01;    // tan(pi/8)
constexpr double kTan3Pi16 = 6.68178637919298919998e-01;  // tan(3 pi/16)

// atan on [0, 1]: moved next to k pi/8 by the addition theorem.
double atan_unit(double x) {
    if (x <= kTanPi16) { return atan_series(x); }
    if (x <= kTan3Pi16) { return kPi / 8.0 + atan_series((x - kTanPi8) / (1.0 + x * kTanPi8)); }
    return kPi / 4.0 + atan_series((x - 1.0) / (x + 1.0));
}

// 2^n for n in [-1022, 1023], put together from its bits.
double power_of_two(int n) {
    const std::uint64_t bits = static_cast<std::uint64_t>(n + 1023) << 52U;
    double out = 0.0;
    std::memcpy(&out, &bits, sizeof out);
    return out;
}

constexpr double kLn2High = 6.93147180369123816490e-01;
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr double kInvLn2 = 1.44269504088896338700e+00;

}  // namespace

SinCos sin_cos(double x_rad) {
    if (!(std::fabs(x_rad) <= kMaxAngle_rad)) { return {0.0, 1.0}; }
    const double k = std::floor(x_rad * kTwoOverPi + 0.5);
    const double r = ((x_rad - k * kHalfPi1) - k * kHalfPi2) - k * kHalfPi3;
    const double s = sin_poly(r);
    const double c = cos_poly(r);
    const int quadrant = static_cast<int>(k) & 3;
    switch (quadrant) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

double tan_rad(double x_rad) {
    const SinCos sc = sin_cos(x_rad);
    return sc.sin / sc.cos;
}

double atan2_rad(double y, double x) {
    const double ay = std::fabs(y);
    const double ax = std::fabs(x);
    if (!(ax + ay > 0.0) || !std::isfinite(ax + ay)) { return 0.0; }
    double a = ay <= ax ? atan_unit(ay / ax) : kPi / 2.0 - atan_unit(ax / ay);
    if (x < 0.0) { a = kPi - a; }
    return y < 0.0 ? -a : a;
}

double asin_rad(double x) {
    const double c = x < -1.0 ? -1.0 : x > 1.0 ? 1.0 : x;
    return atan2_rad(c, std::sqrt((1.0 - c) * (1.0 + c)));
}

double exp_real(double x) {
    const double c = x < -700.0 ? -700.0 : x > 700.0 ? 700.0 : x;
    const double k = std::floor(c * kInvLn2 + 0.5);
    const double r = (c - k * kLn2High) - k * kLn2Low;
    double p = 1.0;  // Horner of the Taylor series, |r| <= ln2 / 2: 15 terms reach 2^-56
    for (int n = 15; n >= 1; --n) { p = 1.0 + r * p / static_cast<double>(n); }
    return p * power_of_two(static_cast<int>(k));
}

double log_real(double x) {
    if (!(x > 0.0) || !std::isfinite(x)) { return 0.0; }
    int exponent = 0;
    const double m0 = std::frexp(x, &exponent);  // exact
    const bool low = m0 < 7.07106781186547524401e-01;
    const double m = low ? 2.0 * m0 : m0;
    const double e = static_cast<double>(low ? exponent - 1 : exponent);
    const double s = (m - 1.0) / (m + 1.0);
    const double z = s * s;
    double p = 1.0 / 25.0;
    for (int n = 23; n >= 3; n -= 2) { p = 1.0 / static_cast<double>(n) + z * p; }
    return e * kLn2High + (2.0 * s + (2.0 * s * z * p + e * kLn2Low));
}

double wrap_angle(double x_rad) {
    if (!std::isfinite(x_rad)) { return 0.0; }
    double a = x_rad - kTwoPi * std::floor((x_rad + kPi) / kTwoPi);
    if (a >= kPi) { a -= kTwoPi; }
    if (a < -kPi) { a = -kPi; }
    return a;
}

}  // namespace semtrack
