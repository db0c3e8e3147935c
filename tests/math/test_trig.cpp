// Own trigonometry against long double.
#include "math/trig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace semtrack {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

long double wide(double x) { return static_cast<long double>(x); }

double error(double x, long double truth) { return static_cast<double>(std::fabs(wide(x) - truth)); }

double relative(double x, long double truth) {
    const long double scale = truth == 0.0L ? 1.0L : std::fabs(truth);
    return static_cast<double>(std::fabs(wide(x) - truth) / scale);
}

TEST(SinCos, AbsoluteErrorBelowFourTenthsOfAQuadrillionth) {
    double worst = 0.0;
    for (int i = -400000; i <= 400000; ++i) {
        const double x = i * 0.00005 * kPi + i * 1e-7;
        const SinCos s = sin_cos(x);
        worst = std::max({worst, error(s.sin, std::sin(wide(x))), error(s.cos, std::cos(wide(x)))});
    }
    EXPECT_LT(worst, 4e-16);
}

TEST(SinCos, FarFromZeroToTheEndOfItsRange) {
    double worst = 0.0;
    for (int i = 0; i <= 20000; ++i) {
        const double x = (i % 2 == 0 ? 1.0 : -1.0) * 4.99999 * i;
        const SinCos s = sin_cos(x);
        worst = std::max({worst, error(s.sin, std::sin(wide(x))), error(s.cos, std::cos(wide(x)))});
    }
    EXPECT_LT(worst, 4e-16);
}

TEST(SinCos, ExactAtZeroAndQuietBeyondItsRange) {
    EXPECT_EQ(sin_cos(0.0).sin, 0.0);
    EXPECT_EQ(sin_cos(0.0).cos, 1.0);
    for (const double x : {kInf, -kInf, kNan, 1e9, -1e300}) {
        EXPECT_EQ(sin_cos(x).sin, 0.0) << x;
        EXPECT_EQ(sin_cos(x).cos, 1.0) << x;
    }
}

TEST(Tan, RelativeErrorAcrossTheQuadrant) {
    for (int i = -1500; i <= 1500; ++i) {
        const double x = i * 0.001;
        EXPECT_LT(relative(tan_rad(x), std::tan(wide(x))), 2e-15) << x;
    }
}

TEST(Atan2, RelativeErrorInAllQuadrantsAndScales) {
    double worst = 0.0;
    for (int i = -2000; i < 2000; ++i) {
        const long double angle = i * 3.14159265358979323846L / 2000.0L + 1e-5L;
        for (const double radius : {1e-150, 1e-3, 1.0, 1e5, 1e150}) {
            const double y = static_cast<double>(wide(radius) * std::sin(angle));
            const double x = static_cast<double>(wide(radius) * std::cos(angle));
            worst = std::max(
                worst, relative(atan2_rad(y, x), std::atan2(wide(y), wide(x))));
        }
    }
    EXPECT_LT(worst, 4e-16);
}

TEST(Atan2, AxesAndOrigin) {
    EXPECT_EQ(atan2_rad(0.0, 0.0), 0.0);
    EXPECT_EQ(atan2_rad(0.0, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(atan2_rad(1.0, 0.0), 0.5 * kPi);
    EXPECT_DOUBLE_EQ(atan2_rad(-1.0, 0.0), -0.5 * kPi);
    EXPECT_DOUBLE_EQ(std::fabs(atan2_rad(0.0, -1.0)), kPi);
}

TEST(Asin, AccurateAndClampedAtItsEnds) {
    for (int i = -1000; i <= 1000; ++i) {
        const double x = i * 0.001;
        EXPECT_NEAR(asin_rad(x), static_cast<double>(std::asin(wide(x))), 2e-15) << x;
    }
    EXPECT_DOUBLE_EQ(asin_rad(1.5), 0.5 * kPi);
    EXPECT_DOUBLE_EQ(asin_rad(-7.0), -0.5 * kPi);
}

TEST(Exp, RelativeErrorAndClamping) {
    for (int i = -7000; i <= 7000; ++i) {
        const double x = i * 0.1;
        EXPECT_LT(relative(exp_real(x), std::exp(wide(x))), 1e-15) << x;
    }
    EXPECT_EQ(exp_real(1e6), exp_real(700.0));
    EXPECT_EQ(exp_real(-1e6), exp_real(-700.0));
}

TEST(Log, RelativeErrorAndInverseOfExp) {
    for (const double x : {1e-300, 1e-9, 0.5, 0.999999, 1.0000001, 2.0, 1e9, 1e300}) {
        EXPECT_NEAR(log_real(x), static_cast<double>(std::log(wide(x))),
                    1e-15 * std::max(1.0, std::fabs(std::log(x))))
            << x;
    }
    EXPECT_EQ(log_real(0.0), 0.0);
    EXPECT_EQ(log_real(-1.0), 0.0);
    EXPECT_EQ(log_real(kNan), 0.0);
}

TEST(WrapAngle, StaysFromMinusPiUpToButNotPi) {
    EXPECT_EQ(wrap_angle(kPi), -kPi);
    EXPECT_EQ(wrap_angle(-kPi), -kPi);
    EXPECT_NEAR(wrap_angle(3.0 * kPi + 0.1), -kPi + 0.1, 1e-12);
    EXPECT_NEAR(wrap_angle(-3.0 * kPi - 0.1), kPi - 0.1, 1e-12);
    for (int i = -1000; i <= 1000; ++i) {
        const double x = 0.37 * i;
        const double w = wrap_angle(x);
        EXPECT_TRUE(w >= -kPi && w < kPi) << x;
        EXPECT_NEAR(std::sin(w), std::sin(x), 1e-12) << x;
        EXPECT_NEAR(std::cos(w), std::cos(x), 1e-12) << x;
    }
}

}  // namespace
}  // namespace semtrack
