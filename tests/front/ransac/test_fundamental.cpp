#include "front/ransac/fundamental.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/rng.hpp"
#include "math/so3.hpp"

namespace semtrack {
namespace {

struct TwoViews {
    std::unique_ptr<ImagePairs> pairs = std::make_unique<ImagePairs>();
    Fundamental truth{};
};

TwoViews two_views(int n, std::uint32_t seed, double noise = 0.0) {
    TwoViews out;
    Rng rng(seed);
    const Vec3 t(0.2 + rng.uniform(), rng.uniform() - 0.5, rng.uniform() - 0.5);
    const Mat3 R = so3_exp(Vec3(0.1 * rng.uniform(), 0.1 * rng.uniform(), 0.1 * rng.uniform()));
    const Mat3 E = skew(t) * R;
    double norm = 0;
    for (int i = 0; i < 9; ++i) {
        norm += E(i / 3, i % 3) * E(i / 3, i % 3);
    }
    for (int i = 0; i < 9; ++i) {
        out.truth[static_cast<std::size_t>(i)] = E(i / 3, i % 3) / std::sqrt(norm);
    }
    out.pairs->size = n;
    out.pairs->px_per_unit = 500.0F;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const double z = 2.0 + 6.0 * rng.uniform();
        const Vec3 x(z * (2.0 * rng.uniform() - 1.0), z * (2.0 * rng.uniform() - 1.0), z);
        const Vec3 y = R * x + t;
        out.pairs->px[i] = static_cast<float>(x(0) / x(2) + noise * (rng.uniform() - 0.5));
        out.pairs->py[i] = static_cast<float>(x(1) / x(2) + noise * (rng.uniform() - 0.5));
        out.pairs->qx[i] = static_cast<float>(y(0) / y(2) + noise * (rng.uniform() - 0.5));
        out.pairs->qy[i] = static_cast<float>(y(1) / y(2) + noise * (rng.uniform() - 0.5));
    }
    return out;
}

double distance(const Fundamental& a, const Fundamental& b) {
    double same = 0;
    double opposite = 0;
    for (std::size_t i = 0; i < 9; ++i) {
        same += (a[i] - b[i]) * (a[i] - b[i]);
        opposite += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return std::sqrt(same < opposite ? same : opposite);
}

double determinant(const Fundamental& f) {
    return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) + f[2] * (f[3] * f[7] - f[4] * f[6]);
}

TEST(SevenPointSolver, FindsTheTrueMatrixAmongItsSolutions) {
    int found = 0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        const TwoViews views = two_views(7, seed);
        SevenPointSolutions out;
        solve_seven_points(*views.pairs, {0, 1, 2, 3, 4, 5, 6}, out);
        double best = 1;
        for (int s = 0; s < out.count; ++s) {
            const Fundamental& f = out.f[static_cast<std::size_t>(s)];
            EXPECT_LT(std::fabs(determinant(f)), 1e-9) << "rank 2, seed " << seed;
            best = std::min(best, distance(f, views.truth));
        }
        found += best < 1e-3 ? 1 : 0;
    }
    EXPECT_GE(found, 196);  // a few samples are nearly degenerate at float coordinates
}

TEST(SevenPointSolver, GivenARepeatedPairHasNoSolution) {
    const TwoViews views = two_views(7, 3);
    SevenPointSolutions out;
    solve_seven_points(*views.pairs, {0, 1, 2, 3, 4, 5, 5}, out);
    EXPECT_EQ(out.count, 0);
}

TEST(RefitFundamental, AveragesTheNoiseOfManyPairs) {
    const TwoViews views = two_views(200, 8, 0.002);
    PairFlags all{};
    all.fill(1);
    SevenPointSolutions rough;
    solve_seven_points(*views.pairs, {0, 30, 60, 90, 120, 150, 180}, rough);
    ASSERT_GT(rough.count, 0);
    Fundamental f{};
    double before = 2;
    for (int s = 0; s < rough.count; ++s) {
        const double d = distance(rough.f[static_cast<std::size_t>(s)], views.truth);
        if (d < before) {
            before = d;
            f = rough.f[static_cast<std::size_t>(s)];
        }
    }
    for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(refit_fundamental(*views.pairs, all, f));
    }
    EXPECT_LT(distance(f, views.truth), 0.5 * before);
    EXPECT_LT(std::fabs(determinant(f)), 1e-12);
}

TEST(RefitFundamental, GivenSevenPairsRefusesAndLeavesTheMatrixUntouched) {
    const TwoViews views = two_views(7, 8);
    PairFlags all{};
    all.fill(1);
    Fundamental f = views.truth;
    EXPECT_FALSE(refit_fundamental(*views.pairs, all, f));
    EXPECT_EQ(f, views.truth);
}

TEST(TestFundamental, CountsPairsWithinTheThresholdInPixels) {
    TwoViews views = two_views(50, 12);
    PairFlags agrees{};
    EXPECT_EQ(test_fundamental(*views.pairs, views.truth, 0.1, agrees), 50);
    views.pairs->qy[4] += 0.2F;  // 100 px, off the mostly horizontal epipolar line
    EXPECT_EQ(test_fundamental(*views.pairs, views.truth, 2.0, agrees), 49);
    EXPECT_EQ(agrees[4], 0);
    EXPECT_EQ(test_fundamental(*views.pairs, Fundamental{}, 2.0, agrees), 0) << "no matrix agrees with nothing";
}

}  // namespace
}  // namespace semtrack
