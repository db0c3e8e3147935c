// What an image shows of a box, against a cloud of points on its surface.
#include "model/box_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "support/sweep.hpp"

namespace semtrack {
namespace {

const PinholeCamera kCamera{700.0, 700.0, 620.0, 180.0};
constexpr int kWidth = 1242;
constexpr int kHeight = 100000;  // rows are not what is tested
const Vec3 kCar(3.9, 1.6, 1.5);

Pose car_at(double x, double y, double z, double theta) {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return {R_c_l * rot_z(theta), Vec3(x, y, z)};
}

/// Rows that the points of all sides of the box take between the borders. false: none is there.
bool seen_rows(const Pose& T_c_o, double& top, double& bottom) {
    constexpr int kSteps = 4000;
    bool any = false;
    for (int i = 0; i < 8; ++i) {
        for (int bit = 1; bit < 8; bit <<= 1) {
            if ((i & bit) != 0) {
                continue;  // from its other end
            }
            for (int s = 0; s <= kSteps; ++s) {
                const double t = static_cast<double>(s) / kSteps;
                const Vec3 x = T_c_o * ((1.0 - t) * box_vertex(i).scaled(kCar) + t * box_vertex(i ^ bit).scaled(kCar));
                if (x(2) < kMinDepth_m) {
                    continue;
                }
                const Vec2 q = project(kCamera, x);
                if (q(0) < 0.0 || q(0) > kWidth - 1) {
                    continue;
                }
                top = any ? std::min(top, q(1)) : q(1);
                bottom = any ? std::max(bottom, q(1)) : q(1);
                any = true;
            }
        }
    }
    return any;
}

TEST(BoxOutline, TopAndBottomAreThoseOfThePartBetweenTheBorders) {
    int cut = 0;
    int whole = 0;
    for (const double z : {3.0, 5.0, 9.0, 25.0}) {
        for (int ix = -8; ix <= 8; ++ix) {
            for (int k = 0; k < 12; k += kSweepShare > 1 ? 5 : 1) {
                const Pose T = car_at(0.13 * ix * z, 0.9, z, -kPi + k * kPi / 6.0 + 0.1);
                double top = 0.0;
                double bottom = 0.0;
                Box2d box;
                if (!seen_rows(T, top, bottom) || seen_box(kCamera, kWidth, kHeight, T, kCar, box) != Status::kOk) {
                    continue;
                }
                const BoxOutline outline = box_outline(kCamera, kWidth, T, kCar);
                (outline[kTop].cut || outline[kBottom].cut ? cut : whole) += 1;
                // A side that comes near the camera is sampled coarsely in pixels.
                const double tolerance = 1e-2 * (bottom - top);
                EXPECT_NEAR(box.top, std::max(top, 0.0), tolerance) << z << " " << ix << " " << k;
                EXPECT_NEAR(box.bottom, bottom, tolerance) << z << " " << ix << " " << k;
            }
        }
    }
    EXPECT_GE(cut, 60 / kSweepShare);
    EXPECT_GE(whole, 300 / kSweepShare);
}

TEST(BoxOutline, ABoxInsideTheImageHasTheExtremeVertices) {
    const Pose T = car_at(2.0, 0.9, 20.0, 0.4);
    EdgeVertices vertices;
    ASSERT_EQ(extreme_vertices(kCamera, T, kCar, vertices), Status::kOk);
    const BoxOutline outline = box_outline(kCamera, kWidth, T, kCar);
    for (std::size_t e = 0; e < outline.size(); ++e) {
        ASSERT_TRUE(outline[e].valid);
        EXPECT_FALSE(outline[e].cut);
        EXPECT_EQ(outline[e].a.x, vertices[e].x);
        EXPECT_EQ(outline[e].a.y, vertices[e].y);
        EXPECT_EQ(outline[e].a.z, vertices[e].z);
    }
}

TEST(BoxOutline, ACarBesideTheCameraHasNoEdgeOnTheSideWhereItGoesOnBehind) {
    const Pose T = car_at(2.5, 0.9, 1.5, 0.0);  // from 0.45 m behind the camera to 3.45 m ahead, on the right
    const BoxOutline outline = box_outline(kCamera, kWidth, T, kCar);
    EXPECT_TRUE(outline[kLeft].valid);
    EXPECT_FALSE(outline[kRight].valid);
    Box2d box;
    ASSERT_EQ(seen_box(kCamera, kWidth, 375, T, kCar, box), Status::kOk);
    EXPECT_DOUBLE_EQ(box.right, kWidth - 1.0);
}

TEST(BoxOutline, NothingInViewIsSaidSo) {
    Box2d box{1.0, 2.0, 3.0, 4.0};
    for (const Pose& T : {car_at(0.0, 0.9, -20.0, 0.0), car_at(60.0, 0.9, 10.0, 0.0)}) {
        EXPECT_FALSE(box_outline(kCamera, kWidth, T, kCar)[kTop].valid);
        EXPECT_EQ(seen_box(kCamera, kWidth, 375, T, kCar, box), Status::kBehindCamera);
        EXPECT_EQ(box.left, 1.0) << "untouched";
    }
}

}  // namespace
}  // namespace semtrack
