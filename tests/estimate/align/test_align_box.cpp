// Alignment of the box to its points.
#include "estimate/align/align_box.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/object/object_scene.hpp"

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
