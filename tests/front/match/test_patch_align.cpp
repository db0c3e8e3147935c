// Sub-pixel alignment of patches whose place is known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "front/match/patch_align.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

constexpr int kSize = 96;

/// The texture, moved by (du, dv) and scaled about the middle, with another brightness.
class Texture {
public:
    Texture(double du, double dv, double scale = 1.0, double shear = 0.0, double gain = 1.0, double offset = 0.0) {
        constexpr double kMiddle = kSize / 2.0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const double v = (y - kMiddle - dv) / scale;
                const double u = (x - kMiddle - du) / scale - shear * v;
                const double grey = offset + gain * (20.0 + 0.7 * wall_texture(u + 500.0, v + 500.0, 3));
                pixels_.push_back(static_cast<std::uint8_t>(grey < 0.0 ? 0.0 : grey > 255.0 ? 255.0 : grey + 0.5));
            }
        }
    }
    [[nodiscard]] ImageView view() const { return {pixels_.data(), kSize, kSize, kSize}; }

private:
    std::vector<std::uint8_t> pixels_;
};

constexpr float kMiddle = kSize / 2.0F;

TEST(PatchAlign, FindsAnyShiftOfAFewPixelsToATenth) {
    ReferencePatch reference;
    const Texture before(0.0, 0.0);
    ASSERT_TRUE(take_reference(before.view(), kMiddle, kMiddle, reference));
    PatchTemplate patch;
    ASSERT_TRUE(patch.build(reference, PatchWarp{}));
    int found = 0;
    double worst = 0.0;
    double sum = 0.0;
    for (int i = -5; i <= 5; ++i) {
        for (int j = -5; j <= 5; ++j) {
            const double du = 0.25 * i;
            const double dv = 0.25 * j;
            const Texture now(du, dv);
            float u = kMiddle;
            float v = kMiddle;
            float ncc = 0.0F;
            ASSERT_TRUE(patch.align(now.view(), 3.0F, u, v, ncc)) << du << " " << dv;
            EXPECT_GT(ncc, 0.98F);
            const double error = std::max(std::fabs(static_cast<double>(u - kMiddle) - du),
                                          std::fabs(static_cast<double>(v - kMiddle) - dv));
            worst = std::max(worst, error);
            sum += error;
            ++found;
        }
    }
    EXPECT_EQ(found, 121);
    EXPECT_LT(sum / found, 0.06);  // bilinear interpolation of a texture with 5 px structures
    EXPECT_LT(worst, 0.1);
}

TEST(PatchAlign, BrightnessOfTheOtherImageDoesNotPull) {
    ReferencePatch reference;
    const Texture before(0.0, 0.0);
    ASSERT_TRUE(take_reference(before.view(), kMiddle, kMiddle, reference));
    PatchTemplate patch;
    ASSERT_TRUE(patch.build(reference, PatchWarp{}));
    const Texture darker(0.4, -0.3, 1.0, 0.0, 0.9, 12.0);
    float u = kMiddle;
    float v = kMiddle;
    float ncc = 0.0F;
    ASSERT_TRUE(patch.align(darker.view(), 3.0F, u, v, ncc));
    EXPECT_NEAR(static_cast<double>(u - kMiddle), 0.4, 0.1);
    EXPECT_NEAR(static_cast<double>(v - kMiddle), -0.3, 0.1);
    EXPECT_GT(ncc, 0.98F);
}

TEST(PatchAlign, AWarpedReferenceMatchesWhatHasGrownAndSheared) {
    ReferencePatch reference;
    const Texture before(0.0, 0.0);
    ASSERT_TRUE(take_reference(before.view(), kMiddle, kMiddle, reference));
    for (const double scale : {0.8, 1.0, 1.2}) {
        for (const double shear : {-0.3, 0.0, 0.3}) {
            const Texture now(0.2, 0.1, scale, shear);
            PatchWarp warp;
            warp.a = static_cast<float>(1.0 / scale);
            warp.b = static_cast<float>(-shear / scale);
            warp.d = static_cast<float>(1.0 / scale);
            PatchTemplate patch;
            ASSERT_TRUE(patch.build(reference, warp));
            float u = kMiddle;
            float v = kMiddle;
            float ncc = 0.0F;
            ASSERT_TRUE(patch.align(now.view(), 3.0F, u, v, ncc)) << scale << " " << shear;
            EXPECT_GT(ncc, 0.97F) << scale << " " << shear;
            EXPECT_NEAR(static_cast<double>(u - kMiddle), 0.2, 0.1) << scale << " " << shear;
            EXPECT_NEAR(static_cast<double>(v - kMiddle), 0.1, 0.1) << scale << " " << shear;
        }
    }
}

TEST(PatchAlign, ASlantedSurfaceIsMetByAShearedPatchOnly) {
    const Texture left(0.0, 0.0);
    const Texture right(-6.0, 0.0, 1.0, -0.33);  // rows further down lie further to the left
    PatchTemplate sheared;
    PatchTemplate upright;
    ASSERT_TRUE(sheared.build_at(left.view(), kMiddle, kMiddle, 0.33F));
    ASSERT_TRUE(upright.build_at(left.view(), kMiddle, kMiddle, 0.0F));
    float u = kMiddle - 5.5F;
    float ncc = 0.0F;
    ASSERT_TRUE(sheared.align_row(right.view(), 3.0F, u, kMiddle, ncc));
    EXPECT_NEAR(static_cast<double>(u), static_cast<double>(kMiddle) - 6.0, 0.06);
    EXPECT_GT(ncc, 0.97F);
    float u_upright = kMiddle - 5.5F;
    float ncc_upright = 0.0F;
    const bool settled = upright.align_row(right.view(), 3.0F, u_upright, kMiddle, ncc_upright);
    EXPECT_TRUE(!settled || ncc_upright < ncc - 0.02F) << ncc_upright;
}

TEST(PatchAlign, WithoutTextureOrTooNearToTheBorderThereIsNothingToAlign) {
    const std::vector<std::uint8_t> grey(static_cast<std::size_t>(kSize) * kSize, 90);
    const ImageView flat{grey.data(), kSize, kSize, kSize};
    PatchTemplate patch;
    EXPECT_FALSE(patch.build_at(flat, kMiddle, kMiddle, 0.0F));
    const Texture image(0.0, 0.0);
    for (const float x : {-3.0F, 0.0F, 5.0F, kSize - 5.0F, kSize + 4.0F}) {
        ReferencePatch reference;
        EXPECT_FALSE(take_reference(image.view(), x, kMiddle, reference)) << x;
        EXPECT_FALSE(take_reference(image.view(), kMiddle, x, reference)) << x;
        EXPECT_FALSE(patch.build_at(image.view(), x, kMiddle, 0.0F)) << x;
        EXPECT_FALSE(patch.build_at(image.view(), kMiddle, x, 0.0F)) << x;
    }
    ASSERT_TRUE(patch.build_at(image.view(), kMiddle, kMiddle, 0.0F));
    for (const float x : {0.0F, 3.0F, kSize - 4.0F}) {
        float u = x;
        float v = kMiddle;
        float ncc = 0.0F;
        EXPECT_FALSE(patch.align(image.view(), 3.0F, u, v, ncc)) << x;
        u = kMiddle;
        v = x;
        EXPECT_FALSE(patch.align(image.view(), 3.0F, u, v, ncc)) << x;
    }
}

TEST(PatchAlign, AnotherTextureIsNotTakenForAMatch) {
    const Texture image(0.0, 0.0);
    PatchTemplate patch;
    ASSERT_TRUE(patch.build_at(image.view(), 30.0F, 30.0F, 0.0F));
    float u = 70.0F;
    float v = 66.0F;
    float ncc = 1.0F;
    const bool settled = patch.align(image.view(), 3.0F, u, v, ncc);
    EXPECT_TRUE(!settled || ncc < 0.6F) << ncc;
}

}  // namespace
}  // namespace semtrack
