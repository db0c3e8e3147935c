// The sixteen viewpoint tables against a box that is turned and projected.
#include "model/box_geometry.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <limits>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"
#include "semtrack/capacity.hpp"

namespace semtrack {
namespace {

const PinholeCamera kCamera{700.0, 700.0, 620.0, 180.0};
const Vec3 kCar(3.9, 1.6, 1.5);

/// Object frame in a level camera: z up is -y of the camera; theta 0 looks along the camera's depth.
Pose car_at(double x, double y, double z, double theta) {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return {R_c_l * rot_z(theta), Vec3(x, y, z)};
}

Box2d brute_force(const Pose& T_c_o, const Vec3& size) {
    Box2d box{1e9, 1e9, -1e9, -1e9};
    for (int k = 0; k < 8; ++k) {
        const Vec3 c((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5, (k & 4) != 0 ? 0.5 : -0.5);
        const Vec2 p = project(kCamera, T_c_o * c.cwiseProduct(size));
        box.left = std::min(box.left, p(0));
        box.right = std::max(box.right, p(0));
        box.top = std::min(box.top, p(1));
        box.bottom = std::max(box.bottom, p(1));
    }
    return box;
}

TEST(Viewpoints, TableVerticesMakeTheProjectionsEdgesInEveryClass) {
    std::bitset<16> seen;
    int checked = 0;
    for (const double z : {6.0, 12.0, 40.0}) {
        for (const double y : {0.2, 1.6}) {  // roof hidden, roof seen
            for (int k = 0; k < 720; ++k) {
                const Pose T = car_at(0.25 * z, y, z, -kPi + k * kPi / 360.0);
                const Viewpoint view = visible_faces(T, kCar);
                const EdgeVertices& vertices = edge_vertices(view);
                const Box2d truth = brute_force(T, kCar);
                const bool one_face = view.horizontal % 2 == 0;
                for (int e = 0; e < kBoxEdges; ++e) {
                    if (one_face && e > kRight) {
                        continue;  // either end of the face may be the nearer one
                    }
                    const Vec2 p = project(kCamera, T * vertices[static_cast<std::size_t>(e)].scaled(kCar));
                    // Off the axis, perspective moves the extreme to a neighbour of the table's vertex by a little.
                    EXPECT_NEAR(p(e == kLeft || e == kRight ? 0 : 1), edge_value(truth, e),
                                0.12 * (truth.bottom - truth.top))
                        << "edge " << e << " view " << int{view.horizontal} << int{view.vertical};
                }
                seen.set(static_cast<std::size_t>(view.horizontal * 2 + view.vertical));
                ++checked;
            }
        }
    }
    EXPECT_TRUE(seen.all()) << seen;
    EXPECT_EQ(checked, 3 * 2 * 720);
}

TEST(Viewpoints, ExtremeVerticesAreExact) {
    for (int k = 0; k < 360; ++k) {
        const Pose T = car_at(-4.0, 1.2, 15.0, k * kPi / 180.0);
        EdgeVertices vertices;
        ASSERT_EQ(extreme_vertices(kCamera, T, kCar, vertices), Status::kOk);
        const Box2d truth = brute_force(T, kCar);
        for (int e = 0; e < kBoxEdges; ++e) {
            const Vec2 p = project(kCamera, T * vertices[static_cast<std::size_t>(e)].scaled(kCar));
            EXPECT_EQ(p(e == kLeft || e == kRight ? 0 : 1), edge_value(truth, e));
        }
    }
}

TEST(ProjectedBox, WholeBoxBehindIsRefusedAndAPartBehindIsCutAtTheNearPlane) {
    Box2d box;
    EXPECT_EQ(projected_box(kCamera, car_at(0, 1, -10.0, 0.3), kCar, box), Status::kBehindCamera);
    ASSERT_EQ(projected_box(kCamera, car_at(2.0, 1.2, 1.0, 0.0), kCar, box), Status::kOk);
    EXPECT_TRUE(std::isfinite(box.left) && std::isfinite(box.bottom));
    EXPECT_GT(box.right, 1242.0);
    ASSERT_EQ(projected_box(kCamera, car_at(1.0, 1.2, 20.0, 0.4), kCar, box), Status::kOk);
    const Box2d truth = brute_force(car_at(1.0, 1.2, 20.0, 0.4), kCar);
    EXPECT_DOUBLE_EQ(box.left, truth.left);
    EXPECT_DOUBLE_EQ(box.bottom, truth.bottom);
}

TEST(BoxOverlap, OfEqualDisjointAndHalfBoxes) {
    const Box2d a{0, 0, 10, 10};
    EXPECT_DOUBLE_EQ(box_overlap(a, a), 1.0);
    EXPECT_DOUBLE_EQ(box_overlap(a, {20, 0, 30, 10}), 0.0);
    EXPECT_DOUBLE_EQ(box_overlap(a, {5, 0, 15, 10}), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(box_overlap(a, {3, 3, 3, 3}), 0.0);
}

TEST(ClipBox, KeepsWhatIsInsideAndRefusesWhatIsNot) {
    Box2d out{1, 2, 3, 4};
    EXPECT_FALSE(clip_box({-20, 5, -1, 10}, 100, 50, out));
    EXPECT_EQ(out.left, 1.0);
    ASSERT_TRUE(clip_box({-20, 5, 200, 10}, 100, 50, out));
    EXPECT_EQ(out.left, 0.0);
    EXPECT_EQ(out.right, 99.0);
    EXPECT_FALSE(clip_box({std::numeric_limits<double>::quiet_NaN(), 0, 10, 10}, 100, 50, out));
}

TEST(ClassPriors, AreSizesOfRoadUsers) {
    for (int k = 0; k < kObjectClasses; ++k) {
        const ClassPrior& p = class_prior(static_cast<ObjectClass>(k));
        EXPECT_GT(p.size_m.minCoeff(), 0.3) << k;
        EXPECT_LT(p.size_m.maxCoeff(), 20.0) << k;
        EXPECT_GT(p.size_sigma_m.minCoeff(), 0.05) << k;
        EXPECT_TRUE((p.size_sigma_m.array() < p.size_m.array()).all()) << k;
        EXPECT_EQ(p.has_heading, p.motion == MotionModel::kVehicle) << k;
    }
    EXPECT_FALSE(class_prior(ObjectClass::kPedestrian).has_heading);
}

}  // namespace
}  // namespace semtrack
