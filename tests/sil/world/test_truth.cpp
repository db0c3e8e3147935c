#include "sil/world/truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "world_cases.hpp"

namespace semtrack::sil::world {
namespace {

struct Tightness {
    double outside{0};  ///< largest amount by which a silhouette leaves the projected box, px
    double side{0};     ///< largest gap between silhouette and box at the left or right edge
    double top{0};      ///< as share of the box's height: a roof is narrower than its box, wheels stand inside it
    double bottom{0};
    int checked{0};
};

Tightness tightness(ObjectClass object_class) {
    Tightness t;
    for (int k = 0; k < 16; ++k) {
        const Scenario s = with_user(quiet_street(), object_class, 0.4, 18.0, kTwoPi * k / 16.0 + 0.07);
        const Scene scene(s, 1);
        const Calibration c = world_calibration(s);
        const Silhouette seen = Renderer(scene, c).silhouettes(0)[0];
        const ObjectTruth truth = object_truth(scene, 0, 0);
        Box2d box;
        EXPECT_EQ(projected_box(c.left, truth.T_c_o, truth.size_m, box), Status::kOk);
        const double gaps[4] = {seen.whole.left - box.left, box.right - seen.whole.right, seen.whole.top - box.top,
                                box.bottom - seen.whole.bottom};
        for (const double gap : gaps) {
            t.outside = std::max(t.outside, -gap);
        }
        t.side = std::max({t.side, gaps[0], gaps[1]});
        t.top = std::max(t.top, gaps[2] / (box.bottom - box.top));
        t.bottom = std::max(t.bottom, gaps[3] / (box.bottom - box.top));
        ++t.checked;
    }
    EXPECT_EQ(t.checked, 16);
    return t;
}

TEST(WorldTruth, SilhouettesOfVehiclesLieInTheirProjectedBoxAndTouchItsEdges) {
    for (const ObjectClass c : {ObjectClass::kCar, ObjectClass::kVan, ObjectClass::kTruck}) {
        const Tightness t = tightness(c);
        EXPECT_LT(t.outside, 0.5) << type_name(c);
        EXPECT_LT(t.side, 6.0) << type_name(c);
        EXPECT_LT(t.top, 0.1) << type_name(c);
        EXPECT_LT(t.bottom, 0.1) << type_name(c);
    }
}

TEST(WorldTruth, SilhouettesOfPeopleLieInTheirProjectedBox) {
    for (const ObjectClass c : {ObjectClass::kPedestrian, ObjectClass::kCyclist}) {
        const Tightness t = tightness(c);
        EXPECT_LT(t.outside, 0.5) << type_name(c);
        EXPECT_LT(t.top, 0.06) << type_name(c);
        EXPECT_LT(t.bottom, 0.06) << type_name(c);
    }
}

TEST(WorldTruth, LabelsFollowKittisConventions) {
    for (int k = 0; k < 24; ++k) {
        const double heading = kTwoPi * k / 24.0 + 0.02;
        const Scenario s = with_user(quiet_street(), ObjectClass::kCar, 3.0, 14.0, heading);
        const Scene scene(s, 1);
        const Calibration c = world_calibration(s);
        const Label l = make_label(scene, c, 0, 0, Renderer(scene, c).silhouettes(0)[0]);
        EXPECT_NEAR(l.x, 3.0, 1e-9);
        EXPECT_NEAR(l.y, kCameraHeight_m, 1e-9);
        EXPECT_NEAR(l.z, 14.0, 1e-9);
        // Heading 0 looks away from the camera: KITTI's rotation_y is -90 degrees there.
        EXPECT_NEAR(wrap_angle(l.rotation_y - (heading - 0.5 * kPi)), 0.0, 1e-12);
        EXPECT_NEAR(wrap_angle(l.alpha - (l.rotation_y - atan2_rad(l.x, l.z))), 0.0, 1e-12);
        EXPECT_EQ(l.truncated, 0.0);
        EXPECT_EQ(l.occluded, 0);
        // Far from the borders between classes, alpha tells the class: 45 degrees each, 0 is the right side.
        const double corner = wrap_angle(l.alpha - 0.25 * kPi);
        const double off = corner / (0.5 * kPi) - std::floor(corner / (0.5 * kPi) + 0.5);
        if (std::fabs(off) < 0.2) {
            const int quarter = static_cast<int>(std::floor(corner / (0.5 * kPi) + 0.5));
            EXPECT_EQ(l.viewpoint.horizontal, (2 * quarter + 1 + 8) % 8) << l.alpha;
        }
        EXPECT_EQ(l.viewpoint.vertical, 1);
    }
}

TEST(WorldTruth, SharesOutsideTheImageAreTruncated) {
    const Scenario s = with_user(quiet_street(), ObjectClass::kCar, -6.2, 7.0, 0.0);
    const Scene scene(s, 1);
    const Calibration c = world_calibration(s);
    const Label l = make_label(scene, c, 0, 0, Renderer(scene, c).silhouettes(0)[0]);
    EXPECT_GT(l.truncated, 0.2);
    EXPECT_LT(l.truncated, 0.9);
    EXPECT_EQ(l.box.left, 0.0);
}

TEST(WorldTruth, OcclusionLevelsAreKittis) {
    EXPECT_EQ(occlusion_level(1.0), 0);
    EXPECT_EQ(occlusion_level(0.7), 1);
    EXPECT_EQ(occlusion_level(0.3), 2);
    EXPECT_EQ(occlusion_level(0.0), 3);
}

TEST(WorldTruth, EgoPosesStartAtTheIdentityAndStepAsFarAsTheSpeedSays) {
    const Scenario s = find_scenario("street");
    const Scene scene(s, 60);
    EXPECT_EQ(ego_truth(scene, 0).R, RigidTransform{}.R);
    EXPECT_EQ(ego_truth(scene, 0).t, RigidTransform{}.t);
    for (int frame = 1; frame < 60; ++frame) {
        const Pose a = to_pose(ego_truth(scene, frame - 1));
        const Pose b = to_pose(ego_truth(scene, frame));
        const Vec3 step = b.t - a.t;
        const double mean_speed = 0.5 * (scene.ego(frame - 1).speed + scene.ego(frame).speed);
        EXPECT_NEAR(std::sqrt(step.dot(step)), 0.1 * mean_speed, 0.02) << frame;
        EXPECT_NEAR((b.R * b.R.transpose() - Mat3::Identity()).norm(), 0.0, 1e-12);
    }
}

TEST(WorldTruth, ATurningCarKeepsItsRearAxleOnTheHeading) {
    Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, 15.0, 0.3);
    s.users[0].motion.speed = 5.0;
    s.users[0].motion.phases = {{2.0, 0.5, 0.1}, {1.0, -6.5, 0.0}};
    const Scene scene(s, 40);
    const double back = rear_axle_to_middle(s.users[0]);
    for (int frame = 1; frame < 40; ++frame) {
        const PathState& a = scene.user(0, frame - 1);
        const PathState& b = scene.user(0, frame);
        const auto axle = [&](const PathState& p) {
            const SinCos h = sin_cos(p.heading);
            return Vec2(p.x - back * h.sin, p.z - back * h.cos);
        };
        const Vec2 step = axle(b) - axle(a);
        const SinCos middle = sin_cos(0.5 * (a.heading + b.heading));
        EXPECT_NEAR(step(0) * middle.cos - step(1) * middle.sin, 0.0, 2e-3) << frame;
        EXPECT_NEAR(step(0) * middle.sin + step(1) * middle.cos, 0.05 * (a.speed + b.speed), 1e-2) << frame;
    }
    EXPECT_NEAR(object_truth(scene, 0, 10).yaw_rate, -0.1 * 5.5, 1e-9);  // a right turn is negative in V
    EXPECT_NEAR(object_truth(scene, 0, 39).speed, -0.5, 1e-9);           // braked beyond standstill: reversing
}

TEST(WorldTruth, AHillCarriesCameraAndCars) {
    Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, 30.0, 0.0);
    s.street.profile = {{20.0, 0.0}, {60.0, 2.0}};
    const Scene scene(s, 1);
    const Label l = make_label(scene, world_calibration(s), 0, 0, Silhouette{});
    EXPECT_NEAR(l.y, kCameraHeight_m - 0.5, 1e-9);
    EXPECT_NEAR(object_truth(scene, 0, 0).T_c_o.R(1, 0), -0.05, 1e-3);  // nose up
}

}  // namespace
}  // namespace semtrack::sil::world
