#include "sil/world/renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/camera.hpp"
#include "world_cases.hpp"

namespace semtrack::sil::world {
namespace {

double sample(const GreyImage& image, double u, int v) {
    const int x = static_cast<int>(std::floor(u));
    const double a = u - x;
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width);
    return (1.0 - a) * row[x] + a * row[x + 1];
}

// Disparity of the level road under a level camera at this row.
double road_disparity(const Calibration& c, int row) {
    return c.baseline_m * (row - c.left.cy) / kCameraHeight_m;
}

// How much more than the road's disparity the patch around (u, v) has: one Lucas-Kanade step along the row.
double disparity_error(const Calibration& c, const GreyImage& left, const GreyImage& right, int u, int v) {
    double gl = 0.0;
    double gg = 0.0;
    for (int dv = -4; dv <= 4; ++dv) {
        const double d = road_disparity(c, v + dv);
        for (int du = -12; du <= 12; ++du) {
            const double at = u + du - d;
            const double gradient = 0.5 * (sample(right, at + 1.0, v + dv) - sample(right, at - 1.0, v + dv));
            const double difference = sample(left, u + du, v + dv) - sample(right, at, v + dv);
            gl += gradient * difference;
            gg += gradient * gradient;
        }
    }
    return -gl / gg;
}

TEST(WorldRenderer, DrawsTheSameFrameTwiceTheSameAndIndependentOfThreads) {
    Scenario s = find_scenario("street");
    const Scene scene(s, 3);
    const Renderer renderer(scene, small_calibration(s));
    GreyImage left1;
    GreyImage right1;
    GreyImage left2;
    GreyImage right2;
    renderer.render(2, left1, right1, 1);
    renderer.render(2, left2, right2, 2);
    EXPECT_EQ(left1.pixels, left2.pixels);
    EXPECT_EQ(right1.pixels, right2.pixels);
    for (const int threads : {0, 7}) {
        renderer.render(2, left2, right2, threads);
        EXPECT_EQ(left1.pixels, left2.pixels) << threads;
    }
    renderer.render(1, left2, right2, 1);
    EXPECT_NE(left1.pixels, left2.pixels);
}

TEST(WorldRenderer, RoadHasTheDisparityOfItsGeometryToATwentiethOfAPixel) {
    Scenario s = quiet_street();
    s.street.sun = 0.8;
    const Scene scene(s, 1);
    const Calibration c = world_calibration(s);
    GreyImage left;
    GreyImage right;
    Renderer(scene, c).render(0, left, right);
    int patches = 0;
    double sum = 0.0;
    double squares = 0.0;
    for (int v = 240; v <= 350; v += 10) {
        for (int u = 440; u <= 740; u += 27) {
            const double e = disparity_error(c, left, right, u, v);
            ++patches;
            sum += e;
            squares += e * e;
        }
    }
    EXPECT_EQ(patches, 144);
    EXPECT_LT(std::fabs(sum / patches), 0.02);
    EXPECT_LT(std::sqrt(squares / patches), 0.05);
}

TEST(WorldRenderer, ShowsARowOffsetAsTheCalibrationStatesIt) {
    Scenario s = quiet_street();
    s.imaging.row_offset = RowOffset{-3.0, 0.0, 0.0};
    Scenario straight = quiet_street();
    const Scene scene(s, 1);
    const Scene straight_scene(straight, 1);
    GreyImage left;
    GreyImage right;
    GreyImage right0;
    Renderer(straight_scene, world_calibration(straight)).render(0, left, right0);
    const Calibration c = world_calibration(s);
    EXPECT_EQ(c.row_offset.constant, -3.0);
    Renderer(scene, c).render(0, left, right);
    for (int v = 50; v < 370; ++v) {
        for (int u = 10; u < 1200; u += 97) {
            ASSERT_EQ(right.view().at(u, v - 3), right0.view().at(u, v)) << u << " " << v;
        }
    }
}

TEST(WorldRenderer, DropsFramesAndBlindsTheRightCameraWhereTheScenarioSaysSo) {
    Scenario s = quiet_street();
    s.imaging.dropped = {1};
    s.imaging.blind_right_from = s.imaging.blind_right_to = 2;
    const Scene scene(s, 4);
    const Renderer renderer(scene, small_calibration(s));
    GreyImage left;
    GreyImage right;
    renderer.render(1, left, right);
    EXPECT_TRUE(left.empty());
    EXPECT_TRUE(right.empty());
    renderer.render(2, left, right);
    EXPECT_FALSE(left.empty());
    EXPECT_EQ(right.pixels, std::vector<std::uint8_t>(right.pixels.size(), 0U));
    renderer.render(3, left, right);
    EXPECT_NE(right.pixels, std::vector<std::uint8_t>(right.pixels.size(), 0U));
}

TEST(WorldRenderer, SceneChangesItsBrightnessWithTheExposure) {
    Scenario s = quiet_street();
    s.imaging.exposure = {{1, 0.5}};
    const Scene scene(s, 2);
    const Renderer renderer(scene, small_calibration(s));
    GreyImage before;
    GreyImage after;
    GreyImage right;
    renderer.render(0, before, right);
    renderer.render(1, after, right);
    for (std::size_t k = 0; k < before.pixels.size(); ++k) {
        if (before.pixels[k] < 250U) {
            ASSERT_NEAR(after.pixels[k], 0.5 * before.pixels[k], 1.0) << k;
        }
    }
}

TEST(WorldRenderer, ThingsBehindTheCameraHaveNoSilhouette) {
    const Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, -12.0, 0.0);
    const Scene scene(s, 1);
    const std::vector<Silhouette> all = Renderer(scene, world_calibration(s)).silhouettes(0);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].samples, 0);
    EXPECT_EQ(all[0].visible_share(), 0.0);
}

TEST(WorldRenderer, ACarBehindAVanIsPartlyHidden) {
    Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.6, 22.0, 0.0);
    s = with_user(s, ObjectClass::kVan, 0.0, 12.0, 0.0);
    const Scene scene(s, 1);
    const std::vector<Silhouette> all = Renderer(scene, world_calibration(s)).silhouettes(0, 1);
    EXPECT_LT(all[0].visible_share(), 0.5);
    EXPECT_GT(all[0].samples, 0);
    EXPECT_EQ(all[1].visible_share(), 1.0);
    const std::vector<Silhouette> threaded = Renderer(scene, world_calibration(s)).silhouettes(0, 2);
    EXPECT_EQ(threaded[0].samples, all[0].samples);
    EXPECT_EQ(threaded[0].visible.left, all[0].visible.left);
}

}  // namespace
}  // namespace semtrack::sil::world
