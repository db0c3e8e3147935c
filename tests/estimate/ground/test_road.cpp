// The road from background points, and whether it is a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "estimate/ground/ground_estimator.hpp"
#include "estimate/ground/road_shape.hpp"
#include "math/rng.hpp"

namespace semtrack {
namespace {

constexpr double kHeight = 1.65;

RoadPrior prior() {
    RoadPrior p;
    p.mean = Vec3(kHeight, 0.0, 0.0);
    const Vec3 sigma(0.03, 0.012, 0.03);
    p.information = sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
    return p;
}

/// n points over the road (h, s_f, s_l), with the noise of their stereo depth.
RoadPoints road(int n, const Vec3& plane, std::uint32_t seed) {
    Rng rng(seed);
    RoadPoints out;
    for (int k = 0; k < n; ++k) {
        RoadPoint p;
        p.ahead_m = 5.0 + 30.0 * rng.uniform();
        p.left_m = 12.0 * rng.uniform() - 6.0;
        p.sigma_m = 0.0015 * p.ahead_m;
        p.up_m = -plane(0) + p.ahead_m * plane(1) + p.left_m * plane(2) + p.sigma_m * rng.normal();
        (void)out.try_push_back(p);
    }
    return out;
}

double error_in_sigmas(const Vec3& truth, const RoadPoints& points, std::uint32_t seed) {
    const RoadFit fit = fit_road(points, prior(), seed);
    EXPECT_TRUE(fit.valid);
    const Vec3 d = fit.plane - truth;
    const RoadPrior p = prior();
    return std::sqrt(d.dot((fit.information + p.information) * d) / 3.0);
}

TEST(RoadFit, FlatPitchedAndRolledRoadsAreRecoveredWithinTheirCovariance) {
    int checked = 0;
    for (const Vec3& truth : {Vec3(1.65, 0.0, 0.0), Vec3(1.66, 0.02, 0.0), Vec3(1.64, -0.015, 0.0),
                              Vec3(1.65, 0.0, 0.04), Vec3(1.65, 0.01, -0.03)}) {
        for (std::uint32_t seed = 1; seed <= 10; ++seed) {
            EXPECT_LT(error_in_sigmas(truth, road(150, truth, seed), seed), 1.5) << truth.transpose()(1);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 50);
}

TEST(RoadFit, FortyPercentOfKerbsWallsAndPlantsDoNotPullIt) {
    const Vec3 truth(1.66, 0.008, -0.01);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        RoadPoints points = road(120, truth, seed);
        Rng rng(seed + 100U);
        for (RoadPoint& p : road(80, truth, seed + 50U)) {
            // a kerb on one side, else anything up to 1.2 m above the road
            p.left_m = p.left_m > 3.0 ? p.left_m : 3.0 + 3.0 * rng.uniform();
            p.up_m = -truth(0) + p.ahead_m * truth(1) + p.left_m * truth(2) +
                     (rng.uniform() < 0.2 ? 0.13 : 0.15 + 1.05 * rng.uniform());
            (void)points.try_push_back(p);
        }
        const RoadFit fit = fit_road(points, prior(), seed);
        ASSERT_TRUE(fit.valid);
        EXPECT_NEAR(fit.plane(0), truth(0), 0.02);
        EXPECT_NEAR(fit.plane(1), truth(1), 0.0015);
        EXPECT_NEAR(fit.plane(2), truth(2), 0.006);
    }
}

TEST(RoadFit, TooFewPointsSayNothing) {
    EXPECT_FALSE(fit_road(RoadPoints{}, prior(), 1).valid);
    EXPECT_FALSE(fit_road(road(kMinRoadPoints - 1, prior().mean, 1), prior(), 1).valid);
    EXPECT_TRUE(fit_road(road(kMinRoadPoints, prior().mean, 1), prior(), 1).valid);
    EXPECT_TRUE(fit_road(road(kMaxBackgroundFeatures, prior().mean, 1), prior(), 1).valid) << "full";
}

TEST(RoadFit, PointsThatAreNotFiniteAreLeftOut) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    RoadPoints points = road(100, Vec3(1.65, 0.01, 0.0), 3);
    const RoadFit clean = fit_road(points, prior(), 5);
    for (const RoadPoint& bad : {RoadPoint{nan, 0, -1, 0.1}, RoadPoint{9, nan, -1, 0.1}, RoadPoint{9, 0, nan, 0.1},
                                 RoadPoint{9, 0, -1, nan}, RoadPoint{9, 0, -1, 0}, RoadPoint{9, 0, -1, -1}}) {
        (void)points.try_push_back(bad);
    }
    const RoadFit fit = fit_road(points, prior(), 5);
    EXPECT_EQ(fit.plane, clean.plane);
    EXPECT_EQ(fit.information, clean.information);
}

TEST(RoadFit, PointsOnOneLineAheadLeaveTheRollToThePrior) {
    RoadPoints points = road(100, Vec3(1.65, 0.01, 0.0), 4);
    for (RoadPoint& p : points) {
        p.left_m = 0.0;
    }
    const RoadFit fit = fit_road(points, prior(), 1);
    ASSERT_TRUE(fit.valid);
    EXPECT_NEAR(fit.plane(1), 0.01, 0.001);
    EXPECT_NEAR(fit.plane(2), 0.0, 1e-9);
    EXPECT_NEAR(fit.information(2, 2), 0.0, 1e-9);
}

TEST(RoadFit, TheSameSeedGivesTheSameBits) {
    const RoadPoints points = road(200, Vec3(1.65, 0.01, 0.0), 6);
    EXPECT_EQ(fit_road(points, prior(), 9).plane, fit_road(points, prior(), 9).plane);
}

TEST(GroundFromRoad, WithoutPointsThePlaneIsThePriorWhateverTheVehicleDoes) {
    GroundEstimator ground;
    ground.init(Config{});
    ground.set_vehicle(0.03, -0.01);
    EXPECT_FALSE(ground.add_road(RoadPoints{}, 1));
    EXPECT_NEAR(ground.plane(-1).height_m, kHeight, 1e-12);
    EXPECT_NEAR(ground.plane(-1).slope_forward, 0.0, 1e-12);
    EXPECT_NEAR(ground.plane(-1).slope_left, 0.0, 1e-12);
    EXPECT_EQ(ground.vehicle_plane(), Vec3(kHeight, 0.03, -0.01));
    ground.set_vehicle(std::numeric_limits<double>::quiet_NaN(), 0.0);
    EXPECT_EQ(ground.vehicle_plane(), Vec3(kHeight, 0.03, -0.01));
}

TEST(GroundFromRoad, AHundredFramesAreNotSurerThanTheCalibrationAndTheRoadAre) {
    GroundEstimator ground;
    ground.init(Config{});
    for (std::uint32_t k = 0; k < 100; ++k) {
        ground.fade(0.1);
        EXPECT_TRUE(ground.add_road(road(200, Vec3(1.65, 0.01, 0.0), k + 1), k));
    }
    const GroundPlane p = ground.plane(-1);
    EXPECT_NEAR(p.slope_forward, 0.01, 0.002);  // the prior pulls by 0.005^2 / (0.005^2 + 0.012^2) of it
    EXPECT_GT(std::sqrt(p.covariance(1, 1)), 0.004);
    EXPECT_LT(std::sqrt(p.covariance(1, 1)), 0.0052);
}

/// The lane ahead; beyond knee_m it bends by `bend`.
RoadPoints lane(double knee_m, double bend, std::uint32_t seed) {
    RoadPoints out;
    for (RoadPoint p : road(120, Vec3(1.65, 0.0, 0.0), seed)) {
        p.left_m /= 4.0;
        p.up_m += p.ahead_m > knee_m ? bend * (p.ahead_m - knee_m) : 0.0;
        (void)out.try_push_back(p);
    }
    return out;
}

/// The flag after each frame of a drive along this lane, the plane being the one the points give.
int frames_flagged(int frames, double knee_m, double bend) {
    RoadShape shape;
    int flagged = 0;
    for (int k = 0; k < frames; ++k) {
        const RoadPoints points = lane(knee_m, bend, static_cast<std::uint32_t>(k + 1));
        const RoadFit fit = fit_road(points, prior(), static_cast<std::uint32_t>(k));
        flagged += shape.update(road_chi2(points, fit.valid ? fit.plane : prior().mean)) ? 1 : 0;
    }
    return flagged;
}

TEST(RoadShape, ACrestAndASagRaiseTheFlagAfterThreeFrames) {
    for (const double knee_m : {10.0, 15.0, 20.0}) {
        EXPECT_EQ(frames_flagged(20, knee_m, -0.0875), 18) << "crest at " << knee_m;
        EXPECT_EQ(frames_flagged(20, knee_m, 0.0875), 18) << "sag at " << knee_m;
    }
}

TEST(RoadShape, AFlatRoadNeverRaisesIt) {
    EXPECT_EQ(frames_flagged(100, 15.0, 0.0), 0);
}

TEST(RoadShape, AWallAcrossTheLaneIsNoRoad) {
    RoadPoints points = lane(100.0, 0.0, 1);
    Rng rng(3);
    for (int k = 0; k < 200; ++k) {
        (void)points.try_push_back({25.0, 4.0 * rng.uniform() - 2.0, -1.65 + 3.0 * rng.uniform(), 0.04});
    }
    EXPECT_LT(road_chi2(points, Vec3(1.65, 0.0, 0.0)), 1.0);
}

TEST(RoadShape, NothingSeenOrNothingFiniteIsNoBend) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(road_chi2(RoadPoints{}, Vec3(1.65, 0.0, 0.0)), 0.0);
    RoadPoints points;
    for (int k = 0; k < 40; ++k) {
        (void)points.try_push_back({5.0 + k, 0.0, nan, 0.1});
    }
    EXPECT_EQ(road_chi2(points, Vec3(1.65, 0.0, 0.0)), 0.0);
    EXPECT_EQ(road_chi2(lane(15.0, 0.09, 1), Vec3(nan, 0.0, 0.0)), 0.0);
}

TEST(RoadShape, TheFlagHoldsBetweenItsLimits) {
    RoadShape shape;
    for (const double chi2 : {5.0, 5.0}) {
        EXPECT_FALSE(shape.update(chi2));
    }
    EXPECT_FALSE(shape.update(3.0)) << "not in a row";
    for (const double chi2 : {5.0, 5.0}) {
        EXPECT_FALSE(shape.update(chi2));
    }
    EXPECT_TRUE(shape.update(5.0));
    for (int k = 0; k < 20; ++k) {
        EXPECT_TRUE(shape.update(3.0)) << "between the limits";
    }
    for (int k = 0; k < 4; ++k) {
        EXPECT_TRUE(shape.update(0.0));
    }
    EXPECT_FALSE(shape.update(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace semtrack
