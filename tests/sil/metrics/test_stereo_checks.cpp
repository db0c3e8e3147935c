// Stereo points against the next frame and against labelled boxes, reckoned by hand.
#include "sil/metrics/stereo_checks.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "math/camera.hpp"

namespace semtrack::sil {
namespace {

Calibration camera() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = {700.0, 700.0, 600.0, 180.0};
    c.right = c.detection = c.left;
    c.baseline_m = 0.5;
    c.T_v_c = RigidTransform{};  // V is the camera itself
    return c;
}

SparsePoint point(std::uint32_t id, const Vec3& x_c, double off_px, std::uint8_t owner = 0) {
    const Vec2 p = project(camera().left, x_c);
    SparsePoint out;
    out.id = id;
    out.owner = owner;
    out.has_position = true;
    out.u = static_cast<float>(p(0) + off_px);
    out.v = static_cast<float>(p(1));
    for (std::size_t i = 0; i < 3; ++i) {
        out.position_w[i] = static_cast<float>(x_c(static_cast<Eigen::Index>(i)));
    }
    return out;
}

class StereoChecks : public ::testing::Test {
protected:
    ObjectRow label(double z, double ry) {
        ObjectRow row;
        row.frame = 1;
        row.type = "Car";
        row.size_m = Vec3(4.0, 2.0, 1.5);
        row.bottom_c0 = Vec3(0.0, 1.5, z);
        row.rotation_y = ry;
        return row;
    }
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
    Trajectory truth_{};
    ObjectTruthSet objects_{};
};

TEST_F(StereoChecks, PointsThatTheMotionCarriesToTheirNewPlaceAreRight) {
    StereoChecker checker(camera(), {0.0, 0.0, 0.0}, truth_, objects_);
    const Vec3 x[4] = {Vec3(-2.0, 0.0, 10.0), Vec3(0.0, 0.0, 12.0), Vec3(1.0, 0.0, 20.0), Vec3(3.0, 0.0, 30.0)};
    output_->ego.status = EgoStatus::kTracked;
    for (std::uint32_t i = 0; i < 4; ++i) {
        (void)output_->points.try_push_back(point(i + 1, x[i], 0.0));
    }
    checker.add(7, *output_);
    EXPECT_FALSE(checker.scores().within_2px.has_value()) << "nothing was carried yet";
    output_->points.clear();
    output_->ego.T_w_v.t = {0.0, 0.0, 1.0};  // a metre ahead
    output_->ego.rejected = 1;
    const double off[4] = {0.0, 1.0, 1.9, 2.5};
    for (std::uint32_t i = 0; i < 4; ++i) {
        (void)output_->points.try_push_back(point(i + 1, x[i] - Vec3(0.0, 0.0, 1.0), off[i]));
    }
    checker.add(8, *output_);
    const StereoScores s = checker.scores();
    ASSERT_TRUE(s.within_2px.has_value());
    EXPECT_NEAR(*s.within_2px, 3.0 / 5.0, 1e-12) << "of four and the one that RANSAC refused";
    EXPECT_NEAR(*s.reprojection_median_px, 1.45, 1e-3);
    EXPECT_FALSE(s.within_1_5px_by_truth.has_value());
}

TEST_F(StereoChecks, TheTrueMotionJudgesWithoutTheEstimate) {
    truth_[7] = Pose{};
    truth_[8] = Pose{Mat3::Identity(), Vec3(0.0, 0.0, 1.0)};
    StereoChecker checker(camera(), {0.0, 0.0, 0.0}, truth_, objects_);
    output_->ego.status = EgoStatus::kTracked;
    const Vec3 x(-2.0, 0.0, 10.0);
    (void)output_->points.try_push_back(point(1, x, 0.0));
    checker.add(7, *output_);
    output_->points.clear();
    (void)output_->points.try_push_back(point(1, x - Vec3(0.0, 0.0, 1.0), 0.5));
    checker.add(8, *output_);  // the estimate says that the camera stands: 15 px off
    EXPECT_EQ(checker.scores().within_2px, 0.0);
    EXPECT_EQ(checker.scores().within_1_5px_by_truth, 1.0);
}

TEST_F(StereoChecks, AFrameThatIsMissingIsNotBridged) {
    StereoChecker checker(camera(), {0.0, 0.0, 0.0}, truth_, objects_);
    output_->ego.status = EgoStatus::kTracked;
    (void)output_->points.try_push_back(point(1, Vec3(0.0, 0.0, 10.0), 0.0));
    checker.add(7, *output_);
    checker.add(9, *output_);
    EXPECT_FALSE(checker.scores().within_2px.has_value());
}

TEST_F(StereoChecks, DepthIsComparedOnTheLowerHalfOfTheNearestBoxsSides) {
    objects_.labels = {label(20.0, 0.0), label(40.0, 0.0)};  // seen from the side: near face at 19 m
    StereoChecker checker(camera(), {0.0, 0.0, 0.0}, truth_, objects_);
    (void)output_->points.try_push_back(point(1, Vec3(0.5, 1.2, 19.0), 0.0, 3));          // exact
    (void)output_->points.try_push_back(point(2, Vec3(-0.5, 1.2, 19.0) * 1.04, 0.0, 3));  // 4 % too far
    (void)output_->points.try_push_back(point(3, Vec3(0.5, 0.4, 19.0) * 1.5, 0.0, 3));    // upper half: does not count
    (void)output_->points.try_push_back(point(4, Vec3(9.0, 1.2, 19.0), 0.0, 3));          // beside
    (void)output_->points.try_push_back(point(5, Vec3(0.0, 1.2, 15.0), 0.0, 0));          // background
    checker.add(1, *output_);
    const StereoScores s = checker.scores();
    EXPECT_EQ(s.label_points, 2);
    EXPECT_NEAR(*s.label_depth_median_percent, 2.0, 1e-3);
    EXPECT_NEAR(*s.label_depth_bias_percent, 2.0, 1e-3);
}

TEST(SurfacePoint, OfARayAtAFaceTheRoofNothingAndFromWithin) {
    Pose T_c_o;
    T_c_o.t = Vec3(0.0, 1.5, 20.0);
    const Vec3 size(4.0, 2.0, 1.5);
    const auto front = surface_point(Vec3(0.0, 0.0375, 1.0), T_c_o, size);
    ASSERT_TRUE(front.has_value());
    EXPECT_NEAR(front->depth_m, 19.0, 1e-9);
    EXPECT_TRUE(front->side);
    EXPECT_NEAR(front->height, (1.5 - 0.0375 * 19.0) / 1.5, 1e-9);
    T_c_o.t(1) = 4.0;  // far below the camera
    const auto roof = surface_point(Vec3(0.0, 2.5 / 20.0, 1.0), T_c_o, size);
    ASSERT_TRUE(roof.has_value());
    EXPECT_FALSE(roof->side);
    EXPECT_FALSE(surface_point(Vec3(1.0, 0.0, 1.0), T_c_o, size).has_value());
    EXPECT_FALSE(surface_point(Vec3(0.0, 0.0, 1.0), Pose{Mat3::Identity(), Vec3(0.0, 0.5, 0.0)}, size).has_value());
}

}  // namespace
}  // namespace semtrack::sil
