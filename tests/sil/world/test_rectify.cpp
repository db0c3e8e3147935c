#include "sil/world/rectify.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace semtrack::sil::world {
namespace {

/// Grey levels that grow by one a pixel to the right and three a row down.
GreyImage ramp() {
    GreyImage image;
    image.width = 60;
    image.height = 40;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.pixels.push_back(static_cast<std::uint8_t>(20 + x + 3 * y));
        }
    }
    return image;
}

TEST(Rectify, WithoutAmplitudeNothingChanges) {
    GreyImage image = ramp();
    rectify(image, 0.0, 3U);
    EXPECT_EQ(image.pixels, ramp().pixels);
}

TEST(Rectify, MovesByAFieldThatIsSmoothAndWithinItsBound) {
    GreyImage image = ramp();
    rectify(image, 2.0, 3U);
    double sum = 0.0;
    int most = 0;
    for (std::size_t y = 4; y < 36; ++y) {
        for (std::size_t x = 4; x < 56; ++x) {
            const int moved = image.pixels[y * 60 + x] - ramp().pixels[y * 60 + x];
            most = std::max(most, std::abs(moved));
            sum += std::abs(moved);
            const int next = image.pixels[y * 60 + x + 1] - ramp().pixels[y * 60 + x + 1];
            EXPECT_LE(std::abs(moved - next), 4);
        }
    }
    EXPECT_LE(most, 12);  // 1.4 amplitude along both axes: 2.8 + 3 x 2.8, and rounding
    EXPECT_GT(sum / (32.0 * 52.0), 1.0);
}

TEST(Rectify, TheFieldIsTheCamerasAndTheSameInEveryFrame) {
    GreyImage a = ramp();
    GreyImage b = ramp();
    GreyImage c = ramp();
    rectify(a, 1.0, 3U);
    rectify(b, 1.0, 3U);
    rectify(c, 1.0, 4U);
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_NE(a.pixels, c.pixels);
    GreyImage none;
    rectify(none, 1.0, 3U);
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace semtrack::sil::world
