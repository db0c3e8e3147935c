#include "sil/world/texture.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace semtrack::sil::world {
namespace {

TEST(Texture, FilteredStripeKeepsItsAreaWhateverTheFootprint) {
    for (const float f : {0.001F, 0.05F, 0.3F, 0.9F}) {
        float sum = 0.0F;
        for (int k = 0; k < 4000; ++k) {
            sum += cover(static_cast<float>(k) * 0.001F, f, 1.5F, 1.8F) * 0.001F;
        }
        EXPECT_NEAR(sum, 0.3F, 0.002F) << f;
    }
}

TEST(Texture, PeriodicStripeAveragesToItsShareAndIsFlatWhenThePeriodIsBelowTheFootprint) {
    float sum = 0.0F;
    for (int k = -2000; k < 2000; ++k) {
        sum += cover_periodic(static_cast<float>(k) * 0.001F, 0.1F, 0.5F, 0.1F, 0.2F);
    }
    EXPECT_NEAR(sum / 4000.0F, 0.2F, 0.002F);
    EXPECT_FLOAT_EQ(cover_periodic(0.37F, 2.0F, 0.5F, 0.1F, 0.2F), 0.2F);
}

TEST(Texture, NoiseIsContinuousAcrossLatticeLinesAndNegativeCoordinates) {
    for (int k = -3; k <= 3; ++k) {
        const float x = static_cast<float>(k);
        EXPECT_NEAR(noise2(x - 1e-4F, 0.3F, 9U), noise2(x + 1e-4F, 0.3F, 9U), 1e-3F) << k;
        EXPECT_NEAR(noise2(0.3F, x - 1e-4F, 9U), noise2(0.3F, x + 1e-4F, 9U), 1e-3F) << k;
    }
}

TEST(Texture, OctavesBelowTheFootprintVanish) {
    const Octaves fine{0.01F, 3, 1.0F};
    EXPECT_EQ(octaves2(1.234F, 5.678F, 0.1F, fine, 4U), 0.0F);
    EXPECT_NE(octaves2(1.234F, 5.678F, 0.001F, fine, 4U), 0.0F);
}

TEST(Texture, NoiseHasTheSameBitsOnEveryTarget) {
    std::uint64_t h = 14695981039346656037ULL;
    for (int k = 0; k < 1000; ++k) {
        const float n =
            octaves2(0.37F * static_cast<float>(k) - 100.0F, 0.11F * static_cast<float>(k), 0.02F, {1.3F, 7, 0.9F}, 5U);
        const int quantised = floor_int(n * 1048576.0F);
        h = (h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(quantised))) * 1099511628211ULL;
    }
    EXPECT_EQ(h, 4484470630997903977ULL);
}

}  // namespace
}  // namespace semtrack::sil::world
