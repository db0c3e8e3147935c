// Patches of road: how they look to the other camera and a frame later.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "front/match/patch_matcher.hpp"
#include "front/match/road_patch.hpp"
#include "support/road_scene.hpp"

namespace semtrack {
namespace {

constexpr double kStep_m = 0.8;  // a frame: 29 km/h at 10 Hz

TEST(RoadPlane, DisparityGrowsByTheSlopeWithEveryRowBelowTheHorizon) {
    const RoadPlane road(RoadScene::calibration(), RoadScene::kHeight_m);
    for (const double v : {150.0, 180.0, 239.0}) {
        EXPECT_NEAR(static_cast<double>(road.disparity(static_cast<float>(v))), RoadScene::disparity_px(v), 1e-4);
    }
    EXPECT_FALSE(road.may_show(100.0F)) << "above the horizon";
    EXPECT_FALSE(road.may_show(130.0F)) << "too near to the horizon";
    EXPECT_TRUE(road.may_show(150.0F));
    EXPECT_FALSE(RoadPlane(RoadScene::calibration(), 0.0).may_show(200.0F)) << "height of the camera not known";
}

TEST(RoadPlane, WarpIsTheDerivativeOfThePlanesMotion) {
    const Calibration c = RoadScene::calibration();
    const RoadPlane road(c, RoadScene::kHeight_m);
    int checked = 0;
    for (const double v : {150.0, 175.0, 200.0}) {
        for (const double u : {60.0, 320.0, 600.0}) {
            for (const double forward_m : {0.4, 1.0, -0.5}) {
                // Where a pixel of now lay in the reference, forward_m before.
                const auto before = [&](double un, double vn) {
                    const double z = RoadScene::depth(vn);
                    const double k = z / (z + forward_m);
                    return Vec2(c.left.cx + (un - c.left.cx) * k, c.left.cy + (vn - c.left.cy) * k);
                };
                const double z = RoadScene::depth(v);
                const auto growth = static_cast<float>((z + forward_m) / z);
                const PatchWarp w = road.warp(static_cast<float>(u), static_cast<float>(v), growth);
                constexpr double h = 1e-4;
                const Vec2 du = (before(u + h, v) - before(u - h, v)) / (2.0 * h);
                const Vec2 dv = (before(u, v + h) - before(u, v - h)) / (2.0 * h);
                EXPECT_NEAR(static_cast<double>(w.a), du(0), 1e-5);
                EXPECT_NEAR(0.0, du(1), 1e-9);
                EXPECT_NEAR(static_cast<double>(w.b), dv(0), 1e-5);
                EXPECT_NEAR(static_cast<double>(w.d), dv(1), 1e-5);
                ++checked;
            }
        }
    }
    EXPECT_EQ(checked, 27);
}

struct RoadRun {
    int features{0};  // in the last frame
    int stereo{0};
    int old{0};                // seen in five frames or more
    double disparity_bias{0};  // px, mean
    double motion_error{0};    // px along the rows or columns, median
};

/// Six frames along the road.
RoadRun drive(double camera_height_m) {
    const Calibration c = RoadScene::calibration();
    OwnerPriors priors = still_priors(false);
    priors[0].T_cur_prev.t = Vec3(0.0, 0.0, -kStep_m);
    const auto matcher = std::make_unique<PatchMatcher>();
    const auto features = std::make_unique<FrameFeatures>();
    for (int k = 0; k < 6; ++k) {
        const RoadFrame frame(kStep_m * k);
        EXPECT_EQ(matcher->process(frame.input(c, priors, k + 1, camera_height_m), *features), Status::kOk);
    }
    RoadRun out;
    std::vector<double> errors;
    for (const FeatureMeasurement& m : *features) {
        ++out.features;
        out.old += m.age >= 4 ? 1 : 0;
        const double v = static_cast<double>(m.v);
        if (m.stereo) {
            ++out.stereo;
            out.disparity_bias += static_cast<double>(m.u - m.u_right) - RoadScene::disparity_px(v);
        }
        if (m.tracked) {
            const double before = RoadScene::depth(static_cast<double>(m.previous_v));
            const double k = before / (before - kStep_m);
            const double eu =
                (static_cast<double>(m.previous_u) - c.left.cx) * k + c.left.cx - static_cast<double>(m.u);
            const double ev = (static_cast<double>(m.previous_v) - c.left.cy) * k + c.left.cy - v;
            errors.push_back(std::max(std::fabs(eu), std::fabs(ev)));
        }
    }
    out.disparity_bias /= out.stereo > 0 ? out.stereo : 1;
    std::sort(errors.begin(), errors.end());
    out.motion_error = errors.empty() ? 0.0 : errors[errors.size() / 2];
    return out;
}

TEST(RoadPatches, OnTheRoadTheMatcherSeesDisparityWithoutBiasAndFollowsForFrames) {
    const RoadRun run = drive(RoadScene::kHeight_m);
    EXPECT_GT(run.features, 150);
    EXPECT_GT(run.stereo, run.features * 9 / 10);
    EXPECT_GT(run.old, run.features / 4);
    EXPECT_LT(std::fabs(run.disparity_bias), 0.03);
    EXPECT_LT(run.motion_error, 0.15);
}

TEST(RoadPatches, ACameraHeightThatIsTenPercentWrongCostsLittle) {
    const RoadRun run = drive(1.1 * RoadScene::kHeight_m);
    EXPECT_GT(run.features, 150);
    EXPECT_LT(std::fabs(run.disparity_bias), 0.06);
}

TEST(RoadPatches, UprightPatchesSeeTheRoadWithABias) {
    const RoadRun with = drive(RoadScene::kHeight_m);
    const RoadRun without = drive(0.0);
    EXPECT_GT(std::fabs(without.disparity_bias), 2.0 * std::fabs(with.disparity_bias));
}

}  // namespace
}  // namespace semtrack
