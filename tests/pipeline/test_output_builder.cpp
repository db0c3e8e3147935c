// What is published over ground carries the ego's own uncertainty of speed and yaw rate.
#include "pipeline/output_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

class OutputBuilderTest : public ::testing::Test {
protected:
    /// A car at (x, y) in V that drives with 10 m/s: 0.3 m/s along, 0.02 rad across.
    void SetUp() override {
        track_->alive = true;
        ASSERT_TRUE(track_->window.frames.try_push_back(ObjectFrame{}));
        track_->window.size_m = Vec3(4.0, 1.6, 1.5);
        track_->window.covariance = Mat6::Zero();
        track_->window.covariance(3, 3) = 0.02 * 0.02;
        track_->window.covariance(4, 4) = 0.3 * 0.3;
        ego_.sigma_speed = 0.4;
        ego_.sigma_yaw_rate = 0.01;
    }
    TrackedObject describe(double x, double y, double yaw, double v = 10.0) {
        ObjectState& state = track_->window.newest().state;
        state.p = Vec3(x, y, -0.9);
        state.theta = yaw;
        state.v = v;
        TrackedObject o;
        EXPECT_TRUE(describe_track(*track_, 0, ego_, PlaneScene{}.calibration(), o));
        return o;
    }
    std::unique_ptr<Track> track_ = std::make_unique<Track>();
    EgoView ego_{};
};

TEST_F(OutputBuilderTest, ACarAheadInTheSameDirectionCarriesTheEgosSpeed) {
    const TrackedObject o = describe(40.0, 0.0, 0.0);
    EXPECT_NEAR(o.sigma_speed, std::sqrt(0.09 + 0.16), 1e-12);
    EXPECT_NEAR(o.sigma_velocity_v[0], std::sqrt(0.09 + 0.16), 1e-12);
    // Across: 10 m/s x 0.02 rad, and 40 m x 0.01 rad/s.
    EXPECT_NEAR(o.sigma_velocity_v[1], std::sqrt(0.04 + 0.16), 1e-12);
}

TEST_F(OutputBuilderTest, ACrossingCarCarriesTheEgosYawRateByItsDistance) {
    const TrackedObject o = describe(40.0, 5.0, 0.5 * kPi);
    EXPECT_NEAR(o.sigma_speed, std::sqrt(0.09 + 0.16), 1e-12);  // 0.01 rad/s x 40 m; nothing of the ego's speed
    EXPECT_NEAR(o.sigma_velocity_v[0], std::sqrt(0.04 + 0.16 + 0.05 * 0.05), 1e-12);
    EXPECT_NEAR(o.sigma_velocity_v[1], std::sqrt(0.09 + 0.16), 1e-12);
}

TEST_F(OutputBuilderTest, MovementIsUnknownWhileTheSpeedIsWithinItsSigma) {
    track_->age = 20;
    EXPECT_EQ(describe(20.0, 0.0, 0.0).movement, MovementState::kMoving);
    EXPECT_EQ(describe(20.0, 0.0, 0.0, -10.0).movement, MovementState::kReversing);
    EXPECT_EQ(describe(20.0, 0.0, kPi).movement, MovementState::kOncoming);
    EXPECT_EQ(describe(20.0, 0.0, 0.0, 0.4).movement, MovementState::kStanding);
    track_->window.covariance(4, 4) = 7.0 * 7.0;
    EXPECT_EQ(describe(20.0, 0.0, 0.0, 6.0).movement, MovementState::kUnknown);
    EXPECT_EQ(describe(20.0, 0.0, 0.0, -6.0).movement, MovementState::kUnknown);
    EXPECT_EQ(describe(20.0, 0.0, 0.0, 8.0).movement, MovementState::kMoving);
}

TEST_F(OutputBuilderTest, YawRateCarriesTheEgosYawRate) {
    // v tan(0) / wheelbase with only the speed and the ego uncertain: the ego's part is all.
    EXPECT_NEAR(describe(20.0, 0.0, 0.0).sigma_yaw_rate, 0.01, 1e-12);
    track_->window.covariance(5, 5) = 0.01 * 0.01;  // 10 m/s x 0.01 / (0.62 x 4 m)
    EXPECT_NEAR(describe(20.0, 0.0, 0.0).sigma_yaw_rate, std::sqrt(1e-4 + 0.1 / 2.48 * 0.1 / 2.48), 1e-12);
}

TEST_F(OutputBuilderTest, AnExactEgoAddsNothing) {
    ego_ = EgoView{};
    const TrackedObject o = describe(40.0, 5.0, 0.0);
    EXPECT_NEAR(o.sigma_speed, 0.3, 1e-12);
    EXPECT_NEAR(o.sigma_velocity_v[0], 0.3, 1e-12);
    EXPECT_NEAR(o.sigma_velocity_v[1], 0.2, 1e-12);
    EXPECT_EQ(o.sigma_yaw_rate, 0.0);
}

/// One step of 0.9 m in 0.1 s and a turn of 0.01 rad, with the step's own covariance; the camera stands 1.5 m ahead of
/// V and looks along it, so a turn moves it sideways and says nothing of the speed.
TEST(EgoMotion, SigmasOfSpeedAndYawRateAreThoseOfTheStep) {
    EgoResult result;
    result.dt_s = 0.1;
    Pose T_v_c;
    T_v_c.R << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // camera z is V's x, camera x is V's -y
    T_v_c.t = Vec3(1.5, 0.0, 0.0);
    result.T_prev_cur = T_v_c.inverse() * Pose{rot_z(0.01), Vec3(0.9, 0.0, 0.0)} * T_v_c;
    result.motion_covariance = Mat6::Zero();
    result.motion_covariance(2, 2) = 0.02 * 0.02;    // along z of the camera
    result.motion_covariance(4, 4) = 0.001 * 0.001;  // about its y
    EgoState ego;
    describe_ego_motion(result, T_v_c, ego);
    EXPECT_NEAR(ego.speed, 9.0, 1e-12);
    EXPECT_NEAR(ego.yaw_rate, 0.1, 1e-12);
    EXPECT_NEAR(ego.sigma_speed, 0.2, 1e-12);
    EXPECT_NEAR(ego.sigma_yaw_rate, 0.01, 1e-12);
}

}  // namespace
}  // namespace semtrack
