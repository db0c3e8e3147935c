#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "front/feature/brief.hpp"
#include "math/rng.hpp"
#include "math/sort.hpp"

namespace semtrack {
namespace {

struct Patch {
    std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(64 * 64);
    [[nodiscard]] ImageView view() const { return {pixels.data(), 64, 64, 64}; }
    template <class F>
    explicit Patch(F brightness) {
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                pixels[static_cast<std::size_t>(64 * y + x)] =
                    static_cast<std::uint8_t>(std::lround(brightness(x - 32.0, y - 32.0)));
            }
        }
    }
};

TEST(BriefPattern, HasAllItsPairsInsideTheDiscAndNoneTwice) {
    std::set<std::tuple<int, int, int, int>> seen;
    double mean = 0;
    for (const BriefPair& p : kBriefPattern) {
        EXPECT_LE(p.ax * p.ax + p.ay * p.ay, 14 * 14);
        EXPECT_LE(p.bx * p.bx + p.by * p.by, 14 * 14);
        EXPECT_FALSE(p.ax == p.bx && p.ay == p.by) << "the draws ran out";
        seen.insert({p.ax, p.ay, p.bx, p.by});
        mean += p.ax + p.ay + p.bx + p.by;
    }
    EXPECT_EQ(seen.size(), 256U);
    EXPECT_LT(std::fabs(mean / 1024.0), 0.6);
}

TEST(BriefPattern, DirectionsAreUnitVectorsOneAfterTheOther) {
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2.0 * std::acos(-1.0) * k / kDirections;
        EXPECT_NEAR(direction(k).cos / 16384.0, std::cos(angle), 4e-5) << k;
        EXPECT_NEAR(direction(k).sin / 16384.0, std::sin(angle), 4e-5) << k;
    }
}

TEST(PatchDirection, FollowsTheGradientAllRound) {
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2.0 * std::acos(-1.0) * k / kDirections;
        const Patch p([&](double x, double y) { return 128.0 + 3.0 * (x * std::cos(angle) + y * std::sin(angle)); });
        EXPECT_EQ(patch_direction(p.view(), 32, 32), k);
    }
}

TEST(PatchDirection, GivenAConstantPatchIsUpright) {
    const Patch p([](double, double) { return 255.0; });
    EXPECT_EQ(patch_direction(p.view(), 32, 32), 0);
}

TEST(Describe, TurnedWithThePatchStaysNearlyTheSame) {
    const auto at_angle = [](double angle) {
        return Patch([angle](double u, double v) {
            const double x = std::cos(angle) * u + std::sin(angle) * v;
            const double y = -std::sin(angle) * u + std::cos(angle) * v;
            return 128.0 + 2.5 * x + 30.0 * std::sin(0.45 * x + 0.3) * std::cos(0.37 * y) + 20.0 * std::sin(0.6 * y);
        });
    };
    const double step = 2.0 * std::acos(-1.0) / kDirections;
    Descriptor upright{};
    const Patch first = at_angle(0.0);
    const int start = patch_direction(first.view(), 32, 32);
    describe(first.view(), 32, 32, start, upright);
    for (const int turn : {1, 5, 8, 13, 24, 31}) {
        const Patch turned = at_angle(step * turn);
        const int now = patch_direction(turned.view(), 32, 32);
        EXPECT_EQ(now, (start + turn) % kDirections);
        Descriptor d{};
        describe(turned.view(), 32, 32, now, d);
        EXPECT_LT(hamming(d, upright), 30) << turn;
        Descriptor not_turned{};
        describe(turned.view(), 32, 32, start, not_turned);
        if (turn == 8 || turn == 13) {
            EXPECT_GT(hamming(not_turned, upright), 60) << turn;
        }
    }
}

TEST(Hamming, CountsEveryBit) {
    Descriptor a{};
    Descriptor b{};
    EXPECT_EQ(hamming(a, b), 0);
    b.fill(0xFFFFFFFFU);
    EXPECT_EQ(hamming(a, b), 256);
    Rng rng(5);
    for (int round = 0; round < 200; ++round) {
        int bits = 0;
        for (std::size_t w = 0; w < 8; ++w) {
            a[w] = rng.next();
            b[w] = rng.next() & rng.next();
            for (unsigned k = 0; k < 32; ++k) {
                bits += static_cast<int>(((a[w] ^ b[w]) >> k) & 1U);
            }
        }
        ASSERT_EQ(hamming(a, b), bits);
    }
}

TEST(HeapSort, SortsEverySizeUpToAHundred) {
    Rng rng(3);
    for (int n = 0; n <= 100; ++n) {
        std::vector<std::uint32_t> items(static_cast<std::size_t>(n) + 1U);
        for (std::uint32_t& x : items) {
            x = rng.next() % 64U;
        }
        std::vector<std::uint32_t> expected = items;
        std::sort(expected.begin(), expected.end() - 1);
        heap_sort(items.data(), n);
        ASSERT_EQ(items, expected) << n;
    }
}

}  // namespace
}  // namespace semtrack
