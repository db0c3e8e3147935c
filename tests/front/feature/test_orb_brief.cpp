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

TEST(PatchDirection, IsTheDirectionAlongWhichTheMomentOfTheDiscIsLargest) {
    std::vector<std::uint8_t> in(40 * 40);
    Rng rng(8);
    for (int round = 0; round < 300; ++round) {
        for (std::uint8_t& p : in) {
            p = static_cast<std::uint8_t>(round % 3 == 0 ? 255 * rng.below(2) : rng.below(256));
        }
        std::int64_t m10 = 0;
        std::int64_t m01 = 0;
        for (int dy = -kBriefRadius_px; dy <= kBriefRadius_px; ++dy) {
            for (int dx = -kBriefRadius_px; dx <= kBriefRadius_px; ++dx) {
                if (dx * dx + dy * dy <= kBriefRadius_px * kBriefRadius_px) {
                    const std::int64_t value = in[static_cast<std::size_t>(40 * (20 + dy) + 20 + dx)];
                    m10 += dx * value;
                    m01 += dy * value;
                }
            }
        }
        int best = 0;
        std::int64_t largest = 0;
        for (int k = 0; k < kDirections; ++k) {
            const std::int64_t along = m10 * direction(k).cos + m01 * direction(k).sin;
            best = along > largest ? k : best;
            largest = std::max(largest, along);
        }
        ASSERT_EQ(patch_direction({in.data(), 40, 40, 40}, 20, 20), best) << round;
    }
}

TEST(PatchDirection, GivenAConstantPatchIsUpright) {
    const Patch p([](double, double) { return 255.0; });
    EXPECT_EQ(patch_direction(p.view(), 32, 32), 0);
}

TEST(BriefPatch, IsTheBinomialFilterToOneGreyLevelWithTheBorderReplicated) {
    constexpr int kWidth = 61;
    constexpr int kHeight = 53;
    std::vector<std::uint8_t> in(kWidth * kHeight);
    Rng rng(6);
    for (std::uint8_t& p : in) {
        p = static_cast<std::uint8_t>(rng.below(256));
    }
    const int w[7] = {1, 6, 15, 20, 15, 6, 1};
    const auto exact = [&](int x, int y) {
        double sum = 0;
        for (int j = -3; j <= 3; ++j) {
            for (int i = -3; i <= 3; ++i) {
                const int cx = std::min(std::max(x + i, 0), kWidth - 1);
                const int cy = std::min(std::max(y + j, 0), kHeight - 1);
                sum += w[i + 3] * w[j + 3] * in[static_cast<std::size_t>(kWidth * cy + cx)];
            }
        }
        return sum / 4096.0;
    };
    BriefPatch patch;
    for (const int y : {16, 26, 36}) {
        for (int x = 16; x < kWidth - 16; ++x) {
            patch.smooth({in.data(), kWidth, kHeight, kWidth}, x, y);
            for (int dy = -kBriefReach_px; dy <= kBriefReach_px; ++dy) {
                for (int dx = -kBriefReach_px; dx <= kBriefReach_px; ++dx) {
                    ASSERT_NEAR(patch.at(dx, dy), exact(x + dx, y + dy), 0.7) << x << ' ' << y;
                }
            }
        }
    }
    const std::vector<std::uint8_t> white(in.size(), 255);
    patch.smooth({white.data(), kWidth, kHeight, kWidth}, 30, 26);
    EXPECT_EQ(patch.at(-16, -14), 255);
    EXPECT_EQ(patch.at(15, 14), 255);
}

TEST(BriefPatch, ComparesEachPairWhereTheTurnedPatternHasIt) {
    std::vector<std::uint8_t> in(64 * 64);
    Rng rng(7);
    for (std::uint8_t& p : in) {
        p = static_cast<std::uint8_t>(rng.below(256));
    }
    BriefPatch patch;
    patch.smooth({in.data(), 64, 64, 64}, 31, 33);
    const auto rounded = [](int x) { return (x + (1 << 13)) >> 14; };
    for (int k = 0; k < kDirections; ++k) {
        const Direction d = direction(k);
        Descriptor out{};
        patch.describe(k, out);
        for (std::size_t bit = 0; bit < 256; ++bit) {
            const BriefPair& p = kBriefPattern[bit];
            const int a = patch.at(rounded(p.ax * d.cos - p.ay * d.sin), rounded(p.ax * d.sin + p.ay * d.cos));
            const int b = patch.at(rounded(p.bx * d.cos - p.by * d.sin), rounded(p.bx * d.sin + p.by * d.cos));
            ASSERT_EQ((out[bit / 32] >> (bit % 32)) & 1U, a < b ? 1U : 0U) << k << ' ' << bit;
        }
    }
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
    const auto describe = [](const Patch& p, int direction_of, Descriptor& out) {
        BriefPatch patch;
        patch.smooth(p.view(), 32, 32);
        patch.describe(direction_of, out);
    };
    Descriptor upright{};
    const Patch first = at_angle(0.0);
    const int start = patch_direction(first.view(), 32, 32);
    describe(first, start, upright);
    for (const int turn : {1, 5, 8, 13, 24, 31}) {
        const Patch turned = at_angle(step * turn);
        const int now = patch_direction(turned.view(), 32, 32);
        EXPECT_EQ(now, (start + turn) % kDirections);
        Descriptor d{};
        describe(turned, now, d);
        EXPECT_LT(hamming(d, upright), 30) << turn;
        Descriptor not_turned{};
        describe(turned, start, not_turned);
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
