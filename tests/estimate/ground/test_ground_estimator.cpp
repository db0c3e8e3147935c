// The road from points on it.
#include "estimate/ground/ground_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace semtrack {
namespace {

constexpr double kHeight = 1.65;

/// Camera at (2, -1, 0.3) in L that looks along L's y.
Pose camera() {
    Mat3 R;
    R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return {R, -(R * Vec3(2.0, -1.0, 0.3))};
}

/// A point of the road `ahead` and `left` of the camera.
Vec3 on_road(double ahead, double left, double h, double s_f, double s_l) {
    return {2.0 - left, -1.0 + ahead, 0.3 - h + s_f * ahead + s_l * left};
}

class GroundEstimatorTest : public ::testing::Test {
protected:
    void SetUp() override {
        Config config;
        config.camera_height_m = kHeight;
        estimator_.init(config);
    }
    GroundEstimator estimator_{};
};

TEST_F(GroundEstimatorTest, WithoutEvidenceTheRoadLiesByTheCamerasHeightBelowAndIsLevel) {
    const GroundPlane p = estimator_.plane(-1);
    EXPECT_TRUE(p.valid);
    EXPECT_DOUBLE_EQ(p.height_m, kHeight);
    EXPECT_DOUBLE_EQ(p.slope_forward, 0.0);
    EXPECT_DOUBLE_EQ(p.slope_left, 0.0);
    EXPECT_NEAR(std::sqrt(p.covariance(0, 0)), 0.03, 1e-12);
}

TEST_F(GroundEstimatorTest, ManyPointsGiveTheSlopesOfTheRoad) {
    for (int k = 0; k < 40; ++k) {
        const double ahead = 8.0 + k;
        const double left = k % 2 == 0 ? 4.0 : -5.0;
        estimator_.add(k % 8, camera(), on_road(ahead, left, 1.66, 0.01, -0.02), 0.02);
    }
    const GroundPlane p = estimator_.plane(-1);
    EXPECT_NEAR(p.height_m, 1.66, 0.004);
    EXPECT_NEAR(p.slope_forward, 0.01, 2e-4);
    EXPECT_NEAR(p.slope_left, -0.02, 4e-4);
}

TEST_F(GroundEstimatorTest, AnObjectIsJudgedByTheOthersOnly) {
    estimator_.add(3, camera(), on_road(20.0, 3.0, 1.65, 0.02, 0.0), 0.05);
    EXPECT_GT(estimator_.plane(-1).slope_forward, 0.005);
    EXPECT_GT(estimator_.plane(4).slope_forward, 0.005);
    EXPECT_DOUBLE_EQ(estimator_.plane(3).slope_forward, 0.0);
}

TEST_F(GroundEstimatorTest, WhatAnObjectSaidStaysWhenItsSlotIsGivenAway) {
    estimator_.add(3, camera(), on_road(20.0, 3.0, 1.65, 0.02, 0.0), 0.05);
    const GroundPlane before = estimator_.plane(-1);
    estimator_.release(3);
    EXPECT_NEAR(estimator_.plane(3).slope_forward, before.slope_forward, 1e-12);
}

TEST_F(GroundEstimatorTest, OldEvidenceFadesBackToThePrior) {
    estimator_.add(0, camera(), on_road(20.0, 0.0, 1.65, 0.02, 0.0), 0.05);
    double last = estimator_.plane(-1).slope_forward;
    for (int k = 0; k < 60; ++k) {
        estimator_.fade(0.1);
        const double now = estimator_.plane(-1).slope_forward;
        EXPECT_LT(now, last);
        last = now;
    }
    EXPECT_NEAR(last, 0.0, 1e-4);
}

TEST_F(GroundEstimatorTest, OnePointFarOffTheOthersRoadHardlyTurnsIt) {
    for (int k = 0; k < 20; ++k) {
        estimator_.add(k, camera(), on_road(8.0 + 2.0 * k, k % 2 == 0 ? 4.0 : -4.0, 1.65, 0.0, 0.0), 0.1);
    }
    const GroundPlane before = estimator_.plane(-1);
    estimator_.add(25, camera(), on_road(30.0, 4.0, -1.0, 0.0, 0.0), 0.1);  // 2.65 m above it
    EXPECT_NEAR(estimator_.plane(-1).slope_forward, before.slope_forward, 0.003);
}

TEST_F(GroundEstimatorTest, NumbersThatAreNoneSayNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    estimator_.add(0, camera(), Vec3(nan, 0.0, 0.0), 0.1);
    estimator_.add(0, camera(), on_road(20.0, 0.0, 1.0, 0.0, 0.0), nan);
    estimator_.add(0, camera(), on_road(20.0, 0.0, 1.0, 0.0, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(estimator_.plane(-1).height_m, kHeight);
}

}  // namespace
}  // namespace semtrack
