// Alignment of the box to its points.
#include "estimate/align/align_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/object/object_scene.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

/// A car ahead and to the left, seen from behind right; landmarks on its rear and right face. The state of the window
/// is off by `shift` and `turn` from where the points are.
class AlignBoxTest : public ::testing::Test {
protected:
    void SetUp() override {
        ObjectSceneOptions o;
        o.start.p = Vec3(14.0, 3.0, -0.9);
        o.features = 0;
        scene_ = std::make_unique<ObjectScene>(o);
        scene_->next();
        window().newest().state = scene_->truth();
        window().size_m = Vec3(4.1, 1.65, 1.48);
        window().covariance = Mat6::Identity();
    }
    ObjectWindow& window() { return scene_->window(); }

    /// Points 0.1 m inside the faces of the box as it truly stands, given in the object frame of the wrong state.
    void put_points(int count, const Vec3& shift_o, double turn_rad) {
        Rng rng(3);
        for (int i = 0; i < count; ++i) {
            Vec3 x(-2.05 + 0.1, between(rng, -0.8, 0.8), between(rng, -0.6, 0.6));
            if (i % 2 == 0) {
                x = Vec3(between(rng, -1.9, 1.9), -0.825 + 0.1, x(2));
            }
            const auto slot = static_cast<std::size_t>(i);
            window().landmarks[slot] = {static_cast<std::uint32_t>(i + 1), true, rot_z(turn_rad) * x + shift_o};
            window().newest().features[slot].valid = true;
        }
    }
    [[nodiscard]] Status align() { return align_box(scene_->calibration(), window(), report_); }

    std::unique_ptr<ObjectScene> scene_;
    AlignmentReport report_{};
};

TEST_F(AlignBoxTest, MovesTheBoxToItsPoints) {
    put_points(40, Vec3(0.4, -0.25, 0.0), 0.06);
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_GE(report_.points, 30);
    EXPECT_NEAR(report_.dx_m, 0.4, 0.1);
    EXPECT_NEAR(report_.dy_m, -0.25, 0.1);
    EXPECT_NEAR(report_.dtheta_rad, 0.06, 0.03);
    EXPECT_NEAR((window().newest().state.p - (scene_->truth().p + Vec3(0.4, -0.25, 0.0))).norm(), 0.0, 0.12);
}

TEST_F(AlignBoxTest, PointsStayWhereTheyAreInTheWorld) {
    put_points(40, Vec3(0.4, -0.25, 0.0), 0.06);
    const Vec3 before = window().newest().state.T_l_o() * window().landmarks[7].f_o;
    ASSERT_EQ(align(), Status::kOk);
    const Vec3 after = window().newest().state.T_l_o() * window().landmarks[7].f_o;
    EXPECT_LT((after - before).norm(), 1e-9);
}

TEST_F(AlignBoxTest, AlignedBoxStays) {
    put_points(40, Vec3::Zero(), 0.0);
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_LT(std::fabs(report_.dx_m), 0.03);
    EXPECT_LT(std::fabs(report_.dy_m), 0.03);
    EXPECT_LT(std::fabs(report_.dtheta_rad), 0.01);
}

TEST_F(AlignBoxTest, AFifthOfPointsInsideTheCarPullsLittle) {
    put_points(40, Vec3::Zero(), 0.0);
    for (std::size_t i = 0; i < 8; ++i) {
        window().landmarks[i].f_o = Vec3(-1.3, -0.1, 0.3);  // seat backs through the rear window
    }
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_LT(std::fabs(report_.dx_m), 0.15);
    EXPECT_LT(std::fabs(report_.dy_m), 0.15);
}

TEST_F(AlignBoxTest, CertainStateHoldsAgainstItsPoints) {
    put_points(6, Vec3(0.4, 0.0, 0.0), 0.0);
    window().covariance = Mat6::Identity() * 1e-6;
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_LT(std::fabs(report_.dx_m), 0.01);
}

/// Forty points 0.1 m inside the faces that the camera sees, given in the frame of a state off by shift and turn.
TEST_F(AlignBoxTest, EveryHeadingIsCorrectedAlike) {
    int checked = 0;
    for (const double theta : {-3.1415, -2.6, -1.9, -1.1, -0.4, 0.3, 1.0, 1.4, 2.4, 3.1415}) {
        SetUp();
        window().newest().state.theta = theta;
        const ObjectState before = window().newest().state;
        const ObjectFrame& frame = window().newest();
        const Vec3 camera_o = frame.state.T_l_o().inverse() * frame.T_c_l.inverse().t;
        const double ex = camera_o(0) > 0.0 ? 1.0 : -1.0;
        const double ey = camera_o(1) > 0.0 ? 1.0 : -1.0;
        const Vec3 shift(0.3, -0.2, 0.0);
        const double turn = 0.05;
        for (int i = 0; i < 40; ++i) {
            const double t = -0.95 + 0.1 * static_cast<double>(i / 2);
            const Vec3 x = i % 2 == 0 ? Vec3(1.9 * t, ey * 0.725, 0.2) : Vec3(ex * 1.95, 0.7 * t, -0.1);
            const auto slot = static_cast<std::size_t>(i);
            window().landmarks[slot] = {static_cast<std::uint32_t>(i + 1), true, rot_z(turn) * x + shift};
            window().newest().features[slot].valid = true;
        }
        ASSERT_EQ(align(), Status::kOk) << theta;
        EXPECT_NEAR(report_.dx_m, 0.3, 0.03) << theta;
        EXPECT_NEAR(report_.dy_m, -0.2, 0.03) << theta;
        EXPECT_NEAR(report_.dtheta_rad, turn, 0.01) << theta;
        const ObjectState& after = window().newest().state;
        EXPECT_NEAR(wrap_angle(after.theta - before.theta), report_.dtheta_rad, 1e-12);
        EXPECT_LE(std::fabs(after.theta), kPi);
        ++checked;
    }
    EXPECT_EQ(checked, 10);
}

/// Straight behind: the rear is all that is seen. Points in pairs left and right, so that they say nothing of the turn.
class AlignRearTest : public AlignBoxTest {
protected:
    void SetUp() override {
        AlignBoxTest::SetUp();
        window().newest().state.p(1) = 0.0;
    }
    void put_rear(double shift_m) {
        for (int i = 0; i < 20; ++i) {
            const double y = (i % 2 == 0 ? 0.07 : -0.07) * static_cast<double>(i / 2 + 1);
            const auto slot = static_cast<std::size_t>(i);
            window().landmarks[slot] = {static_cast<std::uint32_t>(i + 1), true, Vec3(-1.95 + shift_m, y, 0.1)};
            window().newest().features[slot].valid = true;
        }
    }
};

TEST_F(AlignRearTest, WhatOneFaceDoesNotShowStaysWhereTheMapPutIt) {
    put_rear(0.3);
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_EQ(report_.points, 20);
    EXPECT_NEAR(report_.dx_m, 0.3, 0.01);  // 0.3 / (1 + 0.1^2 / 1^2): shape against the MAP's metre
    EXPECT_LT(report_.dx_m, 0.3 / 1.01);
    EXPECT_NEAR(report_.dy_m, 0.0, 1e-12);
    EXPECT_NEAR(report_.dtheta_rad, 0.0, 1e-12);
}

TEST_F(AlignRearTest, WhatIsBoundToItByTheMapFollows) {
    put_rear(0.2);
    window().covariance(0, 1) = window().covariance(1, 0) = 0.5;  // depth and side known together, as along a ray
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_NEAR(report_.dy_m, 0.5 * report_.dx_m, 5e-4);
}

TEST_F(AlignRearTest, ManyPointsOfAFaceDoNotBeatAMapThatIsSurerThanItsShape) {
    put_rear(0.2);
    window().covariance = Mat6::Identity() * 1e-4;  // 0.01 m
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_GT(report_.dx_m, 0.0);
    EXPECT_LT(report_.dx_m, 0.2 * 1e-4 / (1e-4 + 0.1 * 0.1) + 1e-6);
}

TEST_F(AlignRearTest, PointsOfFacesThatAreHiddenDoNotCount) {
    for (int i = 0; i < 20; ++i) {  // on the front, seen through the windows
        const auto slot = static_cast<std::size_t>(i);
        window().landmarks[slot] = {static_cast<std::uint32_t>(i + 1), true, Vec3(1.6, 0.07 * (i - 10), 0.3)};
        window().newest().features[slot].valid = true;
    }
    const ObjectState before = window().newest().state;
    EXPECT_EQ(align(), Status::kNotObservable);
    EXPECT_EQ(window().newest().state.p, before.p);
    EXPECT_EQ(window().newest().state.theta, before.theta);
}

TEST_F(AlignRearTest, NothingHappensWhenTheCameraStandsInTheBox) {
    put_rear(0.2);
    window().newest().state.p = Vec3(0.5, 0.2, -0.9);
    const Vec3 before = window().newest().state.p;
    EXPECT_EQ(align(), Status::kNotObservable);
    EXPECT_EQ(window().newest().state.p, before);
}

TEST_F(AlignBoxTest, ThreePointsChangeNothing) {
    put_points(3, Vec3(0.4, -0.2, 0.0), 0.05);
    const ObjectState before = window().newest().state;
    EXPECT_EQ(align(), Status::kNotObservable);
    EXPECT_EQ(window().newest().state.p, before.p);
    EXPECT_EQ(window().newest().state.theta, before.theta);
}

TEST_F(AlignBoxTest, PointsOfTheBackgroundDoNotPull) {
    put_points(40, Vec3::Zero(), 0.0);
    for (std::size_t i = 0; i < 10; ++i) {
        window().landmarks[i].f_o = Vec3(6.0, 3.0, 0.3);  // a wall behind the car
    }
    ASSERT_EQ(align(), Status::kOk);
    EXPECT_EQ(report_.points, 30);
    EXPECT_LT(std::fabs(report_.dx_m) + std::fabs(report_.dy_m), 0.03);
}

TEST_F(AlignBoxTest, FewPointsChangeNothing) {
    put_points(kMinAlignmentPoints - 1, Vec3(0.4, -0.2, 0.0), 0.0);
    const ObjectState before = window().newest().state;
    EXPECT_EQ(align(), Status::kNotObservable);
    EXPECT_EQ(window().newest().state.p, before.p);
}

TEST_F(AlignBoxTest, PedestrianHasNoFaces) {
    put_points(40, Vec3(0.4, -0.2, 0.0), 0.0);
    window().object_class = ObjectClass::kPedestrian;
    EXPECT_EQ(align(), Status::kNotObservable);
}

}  // namespace
}  // namespace semtrack
