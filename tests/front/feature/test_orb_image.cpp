#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "front/feature/orb_extractor.hpp"
#include "math/rng.hpp"

namespace semtrack {
namespace {

TEST(OrbPyramid, LevelsShrinkByAFifthAndPositionsMapBackToTheirPixel) {
    EXPECT_EQ(level_size(1242, 0), 1242);
    EXPECT_EQ(level_size(1242, 1), 1035);
    EXPECT_EQ(level_size(375, 7), 105);
    for (const int full : {1242, 375, 97}) {
        for (int level = 0; level < kMaxPyramidLevels; ++level) {
            const int size = level_size(full, level);
            for (int x = 0; x < size; ++x) {
                const double exact = (x + 0.5) * full / size;
                const int fixed = full_position_64(x, full, size);
                ASSERT_NEAR(fixed / 64.0, exact, 1.0 / 64.0);
                ASSERT_LT(fixed >> 6, full);
            }
        }
    }
}

TEST(OrbPyramid, ResizingKeepsRampsConstantsAndPositions) {
    std::vector<std::uint8_t> ramp(300 * 120);
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 300; ++x) {
            ramp[static_cast<std::size_t>(300 * y + x)] = static_cast<std::uint8_t>(x / 2 + y / 2);
        }
    }
    ImageResizer resizer;
    const int w = level_size(300, 1);
    const int h = level_size(120, 1);
    std::vector<std::uint8_t> out(static_cast<std::size_t>(w * h));
    resizer.resize({ramp.data(), 300, 120, 300}, w, h, out.data());
    for (int y = 1; y + 1 < h; ++y) {
        for (int x = 1; x + 1 < w; ++x) {
            const double u = (x + 0.5) * 300 / w - 0.5;
            const double v = (y + 0.5) * 120 / h - 0.5;
            ASSERT_NEAR(out[static_cast<std::size_t>(w * y + x)], 0.5 * (u + v) - 0.5, 1.1);
        }
    }
    const std::vector<std::uint8_t> white(300 * 120, 255);
    resizer.resize({white.data(), 300, 120, 300}, w, h, out.data());
    for (const std::uint8_t p : out) {
        ASSERT_EQ(p, 255);
    }
}

TEST(OrbExtractor, RefusesOptionsAndImagesOutOfRange) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kMaxImageWidth + 1) * 100, 7);
    std::vector<std::uint8_t> owners(pixels.size());
    auto out = std::make_unique<Keypoints>();
    FeatureBudget budget{};
    budget[0] = 10;
    for (const OrbOptions options : {OrbOptions{0, true, 10}, OrbOptions{9, true, 10}, OrbOptions{4, true, 0}}) {
        auto orb = std::make_unique<OrbExtractor>(options);
        EXPECT_EQ(orb->extract({pixels.data(), 200, 100, 200}, {owners.data(), 200, 100}, budget, *out),
                  Status::kInvalidArgument);
    }
    auto orb = std::make_unique<OrbExtractor>();
    const int wide = kMaxImageWidth + 1;
    EXPECT_EQ(orb->extract({pixels.data(), wide, 100, wide}, {owners.data(), wide, 100}, budget, *out),
              Status::kInvalidArgument);
    EXPECT_EQ(orb->extract({pixels.data(), 200, 100, 199}, {owners.data(), 200, 100}, budget, *out),
              Status::kInvalidArgument);
}

}  // namespace
}  // namespace semtrack
