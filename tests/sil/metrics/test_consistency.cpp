#include "sil/metrics/consistency.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/box_geometry.hpp"
#include "rows.hpp"

namespace semtrack::sil {
namespace {

using test::car;
using test::truth_of;

Calibration camera() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = c.right = c.detection = PinholeCamera{720.0, 720.0, 620.0, 180.0};
    c.baseline_m = 0.54;
    return c;
}

/// Ten frames of a standing camera; one car 20 m ahead, its result off by `along` m in depth and `turn` rad.
struct Drive {
    std::vector<ObjectRow> objects;
    std::vector<StateRow> states;
    std::vector<EgoMotionRow> ego;
    std::vector<int> frames;
    ObjectTruthSet truth;
    ConsistencyInput input;

    Drive(double along, double turn) {
        std::vector<ObjectRow> labels;
        for (int f = 0; f < 10; ++f) {
            frames.push_back(f);
            labels.push_back(car(f, 1, 100, Vec3(2.0, 1.65, 20.0), -1.5));
            ObjectRow result = car(f, 7, 100, Vec3(2.0, 1.65, 20.0 + along), -1.5 + turn);
            StateRow s;
            s.frame = f;
            s.id = 7;
            s.measured = true;
            s.centre_w = Vec3(20.0 + along, -2.0, -1.65 + 0.75);
            s.yaw = 1.5 - turn - 1.5707963267948966;
            s.size_m = result.size_m;
            s.sigma_position = Vec3(0.5, 0.25, 0.1);
            s.sigma_yaw = 0.02;
            Pose T_w_o;
            T_w_o.R << std::cos(s.yaw), -std::sin(s.yaw), 0, std::sin(s.yaw), std::cos(s.yaw), 0, 0, 0, 1;
            T_w_o.t = s.centre_w;
            EXPECT_EQ(projected_box(camera().left, to_pose(camera().T_v_c).inverse() * T_w_o, s.size_m, result.box),
                      Status::kOk);
            labels.back().box = result.box;
            objects.push_back(result);
            states.push_back(s);
            ego.push_back({f, f * 100000, 5.0, 0.1, 0.1, 0.01});
            input.T_first_c[f] = Pose{};
            input.truth_T_f_c[f] = Pose{Mat3::Identity(), Vec3(0.0, 0.0, 0.48 * f)};
        }
        truth = truth_of(labels, frames);
        input.objects = &objects;
        input.states = &states;
        input.ego = &ego;
        input.result_frames = &frames;
        input.truth = &truth;
        input.calibration = camera();
    }
};

TEST(Consistency, AnErrorOfTwoSigmasIsFour) {
    const Drive drive(1.0, 0.04);
    const Consistency c = check_consistency(drive.input);
    EXPECT_EQ(c.position.count, 20);
    EXPECT_NEAR(*c.position.mean, 2.0, 1e-9);  // 2 sigmas along, none across
    EXPECT_NEAR(*c.position.inside_95, 0.5, 1e-12);
    EXPECT_NEAR(*c.heading.mean, 4.0, 1e-9);
    EXPECT_EQ(*c.heading.inside_95, 0.0);
}

TEST(Consistency, TheEgosSpeedAndYawRateAreComparedWithTheTruthsLastStep) {
    const Drive drive(0.0, 0.0);
    const Consistency c = check_consistency(drive.input);
    EXPECT_EQ(c.ego_speed.count, 9);
    EXPECT_NEAR(*c.ego_speed.mean, 4.0, 1e-6);       // 5.0 against 4.8 m/s, sigma 0.1
    EXPECT_NEAR(*c.ego_yaw_rate.mean, 100.0, 1e-6);  // 0.1 against 0, sigma 0.01
}

TEST(Consistency, BoxesThatAppearWherePredictedHaveNoInnovation) {
    Drive drive(0.0, 0.0);
    const Consistency c = check_consistency(drive.input);
    EXPECT_EQ(c.box_nis.count, 9 * 4);
    EXPECT_NEAR(*c.box_nis.mean, 0.0, 1e-9);
    for (ObjectRow& o : drive.objects) {
        o.box.bottom += 20.0;
    }
    EXPECT_GT(*check_consistency(drive.input).box_nis.mean, 3.0);
}

TEST(Consistency, WhatHasNoStandardDeviationOrNoTruthIsLeftOut) {
    Drive drive(1.0, 0.0);
    for (StateRow& s : drive.states) {
        s.sigma_yaw = 0.0;
    }
    drive.input.truth_T_f_c.clear();
    const Consistency c = check_consistency(drive.input);
    EXPECT_EQ(c.heading.count, 0);
    EXPECT_FALSE(c.heading.mean.has_value());
    EXPECT_EQ(c.ego_speed.count, 0);
    EXPECT_EQ(c.speed.count, 0);
}

}  // namespace
}  // namespace semtrack::sil
