// The vehicle's own sensors in the ego adjustment, and the pose without images.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "estimate/ego/drive_scene.hpp"
#include "estimate/ego/ego_estimator.hpp"
#include "estimate/ego/vehicle_factor.hpp"
#include "math/cholesky6.hpp"
#include "support/jacobian_check.hpp"
#include "support/noise.hpp"

namespace semtrack {
namespace {

Vec6 random6(Rng& rng, double translation, double rotation) {
    Vec6 out;
    for (int i = 0; i < 6; ++i) {
        out(i) = (i < 3 ? translation : rotation) * normal(rng);
    }
    return out;
}

TEST(VehicleFactor, JacobiansMatchCentralDifferences) {
    Rng rng(3U);
    int checked = 0;
    for (int i = 0; i < 50; ++i) {
        const Pose T_before = perturbed_left(Pose{}, random6(rng, 20.0, 0.8));
        VehicleStep step;
        step.T_cur_prev = perturbed_left(Pose{}, random6(rng, 1.0, 0.05));
        const Pose T_now = perturbed_left(step.T_cur_prev * T_before, random6(rng, 0.1, 0.02));
        Vec6 e;
        Mat6 J_now;
        Mat6 J_before;
        vehicle_residual(T_now, T_before, step, e, J_now, J_before);
        const auto residual = [&step](const Pose& now, const Pose& before) {
            Vec6 r;
            Mat6 unused_now;
            Mat6 unused_before;
            vehicle_residual(now, before, step, r, unused_now, unused_before);
            return std::optional<Vec6>(r);
        };
        checked += test::expect_jacobian<6, 6>(
                       J_now, [&](const Vec6& xi) { return residual(perturbed_left(T_now, xi), T_before); })
                       ? 1
                       : 0;
        checked += test::expect_jacobian<6, 6>(
                       J_before, [&](const Vec6& xi) { return residual(T_now, perturbed_left(T_before, xi)); })
                       ? 1
                       : 0;
    }
    EXPECT_EQ(checked, 100);
}

TEST(VehicleFactor, AMotionThatFitsCostsNothingAndABrokenOneIsNoFactor) {
    VehicleMotion motion;
    motion.speed = 10.0;
    motion.yaw_rate = 0.3;
    const Calibration c = DriveScene({}).calibration();
    const VehicleStep step = vehicle_step(predict_from_vehicle(motion, to_pose(c.T_v_c), 0.1));
    ASSERT_TRUE(step.valid);
    Vec6 e;
    Mat6 J_now;
    Mat6 J_before;
    vehicle_residual(step.T_cur_prev, Pose{}, step, e, J_now, J_before);
    EXPECT_LT(e.norm(), 1e-12);
    MotionPrediction broken = predict_from_vehicle(motion, to_pose(c.T_v_c), 0.1);
    broken.covariance(0, 0) = -1.0;
    EXPECT_FALSE(vehicle_step(broken).valid);
}

struct Driven {
    double step_m{0};               ///< mean error of the motions
    double blind_m{0};              ///< error of the position over the frames without images
    std::vector<double> sigma_m{};  ///< published sigma of the position along the way, frame by frame without images
    double nees{0};                 ///< of the position along the way after them
};

struct RunOptions {
    DriveOptions drive{};
    bool vehicle{false};
    double wrong_speed{0};  ///< m/s added to what the wheels say
    int blind_from{-1};
    int blind_frames{0};
};

/// 40 frames.
Driven run(const RunOptions& options) {
    DriveScene scene(options.drive);
    const auto estimator = std::make_unique<EgoEstimator>();
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto result = std::make_unique<EgoResult>();
    const auto features = std::make_unique<FrameFeatures>();
    estimator->init(scene.calibration());
    Driven out;
    Pose truth_before;
    Pose before;
    Pose truth_start;
    Pose start;
    for (int k = 0; k < 40; ++k) {
        scene.next(*features);
        VehicleMotion motion = scene.vehicle_motion();
        motion.speed += options.wrong_speed;
        const bool blind = k >= options.blind_from && k < options.blind_from + options.blind_frames;
        EgoInput in;
        in.frame = static_cast<std::uint32_t>(k + 1);
        in.time_us = DriveScene::kFrame_us * (k + 1);
        in.features = blind ? nullptr : features.get();
        in.has_images = !blind;
        in.motion = options.vehicle ? &motion : nullptr;
        EXPECT_EQ(estimator->process(in, *system, *step, *result), Status::kOk) << k;
        EXPECT_EQ(result->status == EgoStatus::kPredicted, blind && k > 0) << k;
        if (k == options.blind_from - 1) {
            truth_start = scene.T_w_c();
            start = result->T_w_c;
        }
        if (blind) {
            out.sigma_m.push_back(std::sqrt(result->covariance(2, 2)));
            const Pose error = (truth_start.inverse() * scene.T_w_c()).inverse() * (start.inverse() * result->T_w_c);
            out.blind_m = error.t.norm();
            out.nees = error.t(2) * error.t(2) / result->covariance(2, 2);
        }
        if (k > 0) {
            out.step_m += ((truth_before.inverse() * scene.T_w_c()).inverse() * result->T_prev_cur).t.norm() / 39.0;
        }
        truth_before = scene.T_w_c();
        before = result->T_w_c;
    }
    return out;
}

TEST(VehicleMotionFactor, HelpsWhenFeaturesAreFewAndNoisy) {
    RunOptions o;
    o.drive.features = 30;
    o.drive.noise_px = 2.0;
    double without = 0.0;
    double with = 0.0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        o.drive.seed = seed;
        o.vehicle = false;
        without += run(o).step_m;
        o.vehicle = true;
        with += run(o).step_m;
    }
    std::printf("step error %.4f m without, %.4f m with the vehicle\n", without / 10.0, with / 10.0);
    EXPECT_LT(with, 0.8 * without);
}

TEST(VehicleMotionFactor, WheelsThatSlipDoNotPullAGoodPath) {
    RunOptions o;
    const double without = run(o).step_m;
    o.vehicle = true;
    const double good = run(o).step_m;
    o.wrong_speed = 3.0;
    const double slipping = run(o).step_m;
    std::printf("step error %.4f m without, %.4f m with, %.4f m with slipping wheels\n", without, good, slipping);
    EXPECT_LT(good, 1.05 * without);
    EXPECT_LT(slipping, without + 0.01);
}

/// Half a second without images while braking with 2 m/s^2.
RunOptions blind_drive(bool vehicle) {
    RunOptions o;
    o.drive.step_m = 1.2;
    o.drive.gain_m = -0.02;
    o.vehicle = vehicle;
    o.blind_from = 20;
    o.blind_frames = 5;
    return o;
}

TEST(WithoutImages, ThePoseGoesOnWithTheVehiclesMotion) {
    const Driven r = run(blind_drive(true));
    std::printf("0.5 s with the vehicle: %.3f m off, sigma %.3f to %.3f m\n", r.blind_m, r.sigma_m.front(),
                r.sigma_m.back());
    EXPECT_LT(r.blind_m, 0.10);
    ASSERT_EQ(r.sigma_m.size(), 5U);
    for (std::size_t k = 1; k < r.sigma_m.size(); ++k) {
        EXPECT_GT(r.sigma_m[k], r.sigma_m[k - 1]);
    }
    EXPECT_LT(r.sigma_m.back(), 0.2);
    EXPECT_LT(r.nees, 9.0);
}

TEST(WithoutImages, ThePoseGoesOnWithTheMotionModel) {
    const Driven r = run(blind_drive(false));
    std::printf("0.5 s with the motion model: %.3f m off, sigma %.3f to %.3f m\n", r.blind_m, r.sigma_m.front(),
                r.sigma_m.back());
    EXPECT_GT(r.blind_m, 0.15) << "it brakes: 0.3 m in half a second";
    EXPECT_LT(r.blind_m, 0.45);
    for (std::size_t k = 1; k < r.sigma_m.size(); ++k) {
        EXPECT_GT(r.sigma_m[k], r.sigma_m[k - 1]);
    }
    EXPECT_LT(r.nees, 9.0);
    EXPECT_GT(r.sigma_m.back(), 2.0 * run(blind_drive(true)).sigma_m.back());
}

}  // namespace
}  // namespace semtrack
