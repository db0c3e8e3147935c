#include "front/box/infer_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/so3.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

const PinholeCamera kCamera{721.5, 721.5, 609.6, 172.9};

Mat3 level_camera() {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return R_c_l;
}

BoxInferenceInput input_for(const Vec3& p_c, double theta, const Vec3& size) {
    BoxInferenceInput in;
    in.size_m = size;
    in.camera = kCamera;
    in.R_c_l = level_camera();
    in.width = 1242;
    in.height = 375;
    const Pose T_c_o{in.R_c_l * rot_z(theta), p_c};
    EXPECT_EQ(projected_box(kCamera, T_c_o, size, in.box), Status::kOk);
    in.viewpoint = visible_faces(T_c_o, size);
    return in;
}

TEST(BoxInference, ThreeEdgesAreEnoughWhenTheHeadingIsKnown) {
    const Vec3 size(3.9, 1.6, 1.5);
    const Vec3 p(7.0, 0.9, 9.0);
    BoxInferenceInput in = input_for(p, 0.05, size);
    ASSERT_GT(in.box.right, 1242);
    in.box.right = 1241;
    in.has_theta = true;
    in.theta = 0.05;
    BoxHypotheses out;
    ASSERT_EQ(infer_box(in, out), Status::kOk);
    EXPECT_NEAR((out[0].p_c - p).norm(), 0.0, 1e-8);
    EXPECT_EQ(out[0].edges, 0xFU & ~(1U << kRight));
}

TEST(BoxInference, WithoutViewpointTheTrueClassIsAmongTheHypotheses) {
    const Vec3 size(3.9, 1.6, 1.5);
    int found = 0;
    int tried = 0;
    for (double theta = -3.0; theta < 3.0; theta += 0.37) {
        BoxInferenceInput in = input_for(Vec3(4.0, 0.9, 20.0), theta, size);
        const int truth = in.viewpoint.horizontal;
        in.viewpoint = Viewpoint{};
        BoxHypotheses out;
        ++tried;
        if (infer_box(in, out) != Status::kOk) {
            continue;
        }
        for (const BoxHypothesis& h : out) {
            found += h.viewpoint.horizontal == truth ? 1 : 0;
        }
        for (int i = 1; i < out.size(); ++i) {
            EXPECT_LE(out[i - 1].rank_px, out[i].rank_px);
        }
    }
    EXPECT_GE(found, tried - 1);
}

TEST(BoxInference, APedestriansDepthComesFromTheHeight) {
    BoxInferenceInput in;
    in.object_class = ObjectClass::kPedestrian;
    in.size_m = Vec3(0.65, 0.59, 1.69);
    in.camera = kCamera;
    in.R_c_l = level_camera();
    in.width = 1242;
    in.height = 375;
    const double z = 15.0;
    in.box = {700, 172.9 + 721.5 * (0.8 - 1.69) / z, 730, 172.9 + 721.5 * 0.8 / z};
    BoxHypotheses out;
    ASSERT_EQ(infer_box(in, out), Status::kOk);
    EXPECT_NEAR(out[0].p_c(2), z, 1e-9);
    EXPECT_NEAR(out[0].p_c(0), (715 - 609.6) / 721.5 * z, 1e-9);
}

TEST(BoxInference, NonsenseGivesAStatusAndNoPose) {
    BoxHypotheses out;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Box2d& box : {Box2d{nan, 10, 20, 30}, Box2d{20, 10, 20, 30}, Box2d{30, 10, 20, 30},
                             Box2d{600, 100, 601, 101}, Box2d{0, 0, 1241, 374}}) {
        BoxInferenceInput in = input_for(Vec3(0.0, 0.9, 20.0), 0.4, Vec3(3.9, 1.6, 1.5));
        in.box = box;
        EXPECT_EQ(infer_box(in, out), Status::kNotObservable);
        EXPECT_TRUE(out.empty());
    }
}

TEST(Viewpoint, FollowsTheObservationAngle) {
    const Vec3 size(3.9, 1.6, 1.5);
    const Vec3 p(0.0, 1.0, 30.0);
    const int expected[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    for (int h = 0; h < 8; ++h) {
        const double alpha = h * kPi / 4.0;
        EXPECT_EQ(viewpoint_from_alpha(alpha, p, size).horizontal, expected[h]) << h;
    }
    EXPECT_EQ(viewpoint_from_alpha(1.0, Vec3(0.0, 1.0, 30.0), size).vertical, 1);
    EXPECT_EQ(viewpoint_from_alpha(1.0, Vec3(0.0, 0.5, 30.0), size).vertical, 0);
}

}  // namespace
}  // namespace semtrack
