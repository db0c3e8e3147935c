#include "math/robust.hpp"

#include <gtest/gtest.h>

namespace semtrack {
namespace {

using Kernel = Robust (*)(double, double);
constexpr Kernel kKernels[] = {huber, cauchy, tukey};

TEST(RobustKernel, SmallResidualsCostTheirSquareAndKeepTheirWeight) {
    for (const Kernel kernel : kKernels) {
        const Robust zero = kernel(0.0, 2.0);
        EXPECT_EQ(zero.rho, 0.0);
        EXPECT_EQ(zero.weight, 1.0);
        const Robust small = kernel(1e-8, 2.0);
        EXPECT_NEAR(small.rho, 1e-8, 1e-15);
        EXPECT_NEAR(small.weight, 1.0, 1e-7);
    }
}

TEST(RobustKernel, TheWeightIsTheDerivativeOfTheCostByTheSquare) {
    int checked = 0;
    for (const Kernel kernel : kKernels) {
        for (const double k : {0.5, 1.0, 4.0}) {
            for (double r2 = 0.05; r2 < 40.0; r2 *= 1.3) {
                const double step = 1e-5 * r2;
                if (r2 - step < k * k && r2 + step > k * k) {
                    continue;  // the edge
                }
                const double numeric = (kernel(r2 + step, k).rho - kernel(r2 - step, k).rho) / (2.0 * step);
                EXPECT_NEAR(kernel(r2, k).weight, numeric, 1e-6) << k << " " << r2;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 200);
}

TEST(RobustKernel, CostIsContinuousAndNeverFalls) {
    for (const Kernel kernel : kKernels) {
        double before = 0.0;
        for (int i = 0; i <= 4000; ++i) {
            const Robust now = kernel(0.01 * i, 3.0);
            EXPECT_GE(now.rho, before - 1e-12);
            EXPECT_LT(now.rho - before, 0.011);
            EXPECT_GE(now.weight, 0.0);
            EXPECT_LE(now.weight, 1.0);
            before = now.rho;
        }
    }
}

TEST(RobustKernel, TukeyLosesInterestBeyondItsEdgeHuberDoesNot) {
    EXPECT_EQ(tukey(16.0, 4.0).weight, 0.0);
    EXPECT_EQ(tukey(1e12, 4.0).rho, 16.0 / 3.0);
    EXPECT_NEAR(huber(1e4, 1.0).weight, 0.01, 1e-12);
    EXPECT_NEAR(huber(1e4, 1.0).rho, 199.0, 1e-9);
}

}  // namespace
}  // namespace semtrack
