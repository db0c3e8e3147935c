#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "front/feature/orb_corners.hpp"
#include "math/rng.hpp"

namespace semtrack {
namespace {

struct Pixels {
    int width;
    int height;
    std::vector<std::uint8_t> values;
    Pixels(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w * h)) {}
    [[nodiscard]] ImageView view() const { return {values.data(), width, height, width}; }
};

/// Both detectors' corners, all of them equal; how many.
int expect_equal_corners(const ImageView& image, int threshold) {
    static const auto plain = std::make_unique<FastDetector>();
    static const auto blocks = std::make_unique<OrbCorners>();
    static const auto expected = std::make_unique<CornerGrid>();
    static const auto found = std::make_unique<CornerGrid>();
    EXPECT_EQ(plain->detect(image, threshold, OrbCorners::kMargin_px, *expected), Status::kOk);
    blocks->detect(image, threshold, *found);
    int corners = 0;
    for (int cell = 0; cell < expected->cells(); ++cell) {
        EXPECT_EQ(found->count(cell), expected->count(cell)) << cell;
        for (int i = 0; i < expected->count(cell) && i < found->count(cell); ++i) {
            const Corner& a = expected->corner(cell, i);
            const Corner& b = found->corner(cell, i);
            EXPECT_TRUE(a.x == b.x && a.y == b.y && a.score == b.score) << b.x << ' ' << b.y;
            ++corners;
        }
    }
    return corners;
}

TEST(OrbCorners, AreThoseOfThePlainDetectorInNoiseOfEveryStrength) {
    Rng rng(21);
    int corners = 0;
    for (const int range : {12, 40, 256}) {
        Pixels p(311, 97);
        for (std::uint8_t& v : p.values) {
            v = static_cast<std::uint8_t>(128 - range / 2 + rng.below(range));
        }
        for (const int threshold : {1, 2, 10, 60, 200, 254}) {
            corners += expect_equal_corners(p.view(), threshold);
        }
    }
    EXPECT_GT(corners, 2000);
}

TEST(OrbCorners, AreThoseOfThePlainDetectorOnBlocksInBlackAndWhite) {
    Rng rng(22);
    int corners = 0;
    for (int round = 0; round < 20; ++round) {
        Pixels p(200, 90);
        for (int y = 0; y < p.height; ++y) {
            for (int x = 0; x < p.width; ++x) {
                const bool again = x % 7 != 0 && x > 0;
                std::uint8_t& v = p.values[static_cast<std::size_t>(y * p.width + x)];
                v = again ? p.values[static_cast<std::size_t>(y * p.width + x - 1)]
                          : static_cast<std::uint8_t>(255 * rng.below(2));
                if (y % 5 != 0) {
                    v = p.values[static_cast<std::size_t>((y - 1) * p.width + x)];
                }
            }
        }
        corners += expect_equal_corners(p.view(), 10) + expect_equal_corners(p.view(), 254);
    }
    EXPECT_GT(corners, 200);
}

TEST(OrbCorners, AreThoseOfThePlainDetectorWhateverTheImagesWidth) {
    Rng rng(23);
    int corners = 0;
    for (int width = 2 * OrbCorners::kMargin_px + 1; width < 100; ++width) {
        Pixels p(width, 60);
        for (std::uint8_t& v : p.values) {
            v = static_cast<std::uint8_t>(rng.below(256));
        }
        corners += expect_equal_corners(p.view(), 20);
    }
    EXPECT_GT(corners, 500);
}

}  // namespace
}  // namespace semtrack
