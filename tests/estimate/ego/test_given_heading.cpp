// Given poses that point beside the camera: the angle comes from the steps of a vehicle that does not slip.
#include "estimate/ego/given_heading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "estimate/ego/ego_estimator.hpp"
#include "math/so3.hpp"
#include "support/noise.hpp"

namespace semtrack {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;

Mat3 camera_axes() {  // x right, y down, z ahead in V (x ahead, y left, z up)
    Mat3 R_v_c;
    R_v_c << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
    return R_v_c;
}

/// A car with a camera ahead of its rear axle; its poses come turned about the vertical.
struct Car {
    double lever_m{1.5};
    double step_m{1.0};
    double curvature{0.0};
    double beside_rad{0.0};  // the camera looks so far left of what the poses say
    double noise_m{0.0};

    /// In the first camera's axes.
    [[nodiscard]] std::vector<Pose> given(int frames, Rng& rng) const {
        const Mat3 R_v_c = camera_axes();
        const Mat3 off = R_v_c.transpose() * rot_z(-beside_rad) * R_v_c;
        std::vector<Pose> out;
        Vec3 axle(0.0, 0.0, 0.0);
        double yaw = 0.0;
        for (int k = 0; k < frames; ++k) {
            const Mat3 R_w_v = rot_z(yaw);
            Vec3 camera = axle + R_w_v * Vec3(lever_m, 0.0, 0.0);
            camera(1) += noise_m * normal(rng);
            out.push_back({R_v_c.transpose() * R_w_v * R_v_c * off, R_v_c.transpose() * camera});
            const double turned = curvature * step_m;
            axle += step_m * Vec3(std::cos(yaw + 0.5 * turned), std::sin(yaw + 0.5 * turned), 0.0);
            yaw += turned;
        }
        return out;
    }
};

double found_angle(const std::vector<Pose>& poses) {
    GivenHeading heading;
    heading.reset();
    for (std::size_t k = 1; k < poses.size(); ++k) {
        heading.update(poses[k - 1].inverse() * poses[k], camera_axes());
    }
    return heading.angle_rad();
}

TEST(GivenHeading, FindsTheAngleOnAStraightRoadWithNoisyPositions) {
    Rng rng(5U);
    for (const double beside : {-1.0 * kDegree, 0.0, 0.7 * kDegree, 1.5 * kDegree}) {
        Car car;
        car.beside_rad = beside;
        car.noise_m = 0.005;
        EXPECT_NEAR(found_angle(car.given(100, rng)), beside, 0.1 * kDegree);
    }
}

TEST(GivenHeading, ACameraAheadOfTheAxleIsNotTakenForAnAngleInTurns) {
    Rng rng(5U);
    Car car;
    car.lever_m = 2.0;  // the prior says 1
    car.curvature = 0.02;
    std::vector<Pose> poses = car.given(60, rng);
    car.curvature = -0.02;
    GivenHeading heading;
    heading.reset();
    const std::vector<Pose> back = car.given(60, rng);
    for (std::size_t k = 1; k < poses.size(); ++k) {
        heading.update(poses[k - 1].inverse() * poses[k], camera_axes());
        heading.update(back[k - 1].inverse() * back[k], camera_axes());
    }
    EXPECT_NEAR(heading.angle_rad(), 0.0, 0.05 * kDegree);
}

TEST(GivenHeading, StandingReversingTightTurnsAndBrokenStepsSayNothing) {
    Rng rng(5U);
    Car standing;
    standing.step_m = 0.0;
    standing.noise_m = 0.02;
    EXPECT_EQ(found_angle(standing.given(50, rng)), 0.0);
    Car reversing;
    reversing.step_m = -1.0;
    reversing.beside_rad = kDegree;
    EXPECT_EQ(found_angle(reversing.given(50, rng)), 0.0);
    Car tight;
    tight.curvature = 0.2;
    EXPECT_EQ(found_angle(tight.given(50, rng)), 0.0);
    GivenHeading heading;
    heading.reset();
    Pose broken;
    broken.t = Vec3(0.0, 0.0, std::numeric_limits<double>::quiet_NaN());
    heading.update(broken, camera_axes());
    broken.t = Vec3(0.0, 0.0, std::numeric_limits<double>::infinity());
    heading.update(broken, camera_axes());
    EXPECT_EQ(heading.angle_rad(), 0.0);
}

TEST(GivenHeading, OneJumpOfThePositionDoesNotTurnTheCamera) {
    Rng rng(5U);
    Car car;
    std::vector<Pose> poses = car.given(40, rng);
    for (std::size_t k = 20; k < poses.size(); ++k) {
        poses[k].t(0) += 0.5;  // to the right, 27 degrees beside the step
    }
    EXPECT_NEAR(found_angle(poses), 0.0, 0.25 * kDegree);
}

TEST(GivenHeading, ThePoseIsPublishedAsGivenAndTheHistoryLooksWhereTheCameraLooks) {
    Rng rng(5U);
    Car car;
    car.beside_rad = kDegree;
    const std::vector<Pose> poses = car.given(30, rng);
    Calibration calibration;
    calibration.T_v_c = to_rigid_transform({camera_axes(), Vec3::Zero()});
    const auto ego = std::make_unique<EgoEstimator>();
    ego->init(calibration);
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto result = std::make_unique<EgoResult>();
    EgoInput input;
    for (std::size_t k = 0; k < poses.size(); ++k) {
        input.frame = static_cast<std::uint32_t>(k + 1);
        input.time_us = 100000 * static_cast<std::int64_t>(k);
        input.given_T_w_c = &poses[k];
        ASSERT_EQ(ego->process(input, *system, *step, *result), Status::kOk);
        EXPECT_LT((result->T_w_c.R - poses[k].R).norm(), 1e-12);
        EXPECT_LT((result->T_w_c.t - poses[k].t).norm(), 1e-12);
    }
    const Vec3 ahead = Vec3(0.0, 0.0, 1.0);  // of a straight road, in the first camera's axes
    for (const std::uint32_t frame : {30U, 25U}) {
        Pose T_w_c;
        ASSERT_TRUE(ego->history().find(frame, T_w_c));
        EXPECT_LT((Vec3(T_w_c.R.col(2)) - ahead).norm(), 0.15 * kDegree);
    }
    EXPECT_GT((Vec3(poses.back().R.col(2)) - ahead).norm(), 0.9 * kDegree);
    EXPECT_LT((result->T_w_camera.R.col(2) - ahead).norm(), 0.15 * kDegree);
}

}  // namespace
}  // namespace semtrack
