// Where an object's window may start anew, and what tells one solution from another.
#include "estimate/object/object_starts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/object/object_scene.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

/// A car straight ahead with its true landmarks, seen in some frames.
struct Seen {
    explicit Seen(int features = 40) : scene([features] {
        ObjectSceneOptions o;
        o.features = features;
        o.start.p = Vec3(20.0, 3.0, -0.9);
        return o;
    }()) {
        for (int k = 0; k < 4; ++k) {
            scene.next();
        }
        ObjectWindow& window = scene.window();
        const ObjectFrame& now = window.newest();
        const Pose T_l_c = now.T_c_l.inverse();
        x.size_m = window.size_m;
        for (std::size_t k = 0; k < static_cast<std::size_t>(window.frames.size()); ++k) {
            x.state[k] = scene.truth();
        }
        for (std::size_t slot = 0; slot < static_cast<std::size_t>(features); ++slot) {
            const FeatureObservation& o = now.features[slot];
            if (!o.valid) {
                continue;
            }
            const Calibration& c = scene.calibration();
            const double z = c.left.fx * c.baseline_m / static_cast<double>(o.u - o.u_right);
            const Vec3 x_c((static_cast<double>(o.u) - c.left.cx) * z / c.left.fx,
                           (static_cast<double>(o.v) - c.left.cy) * z / c.left.fy, z);
            x.f_o[slot] = rot_z(-scene.truth().theta) * (T_l_c * x_c - scene.truth().p);
            window.landmarks[slot].valid = true;
            ++landmarks;
        }
    }
    [[nodiscard]] std::size_t last() const { return static_cast<std::size_t>(scene.window().frames.size() - 1); }
    [[nodiscard]] Vec3 in_world(std::size_t slot) const {
        return x.state[last()].p + rot_z(x.state[last()].theta) * x.f_o[slot];
    }
    /// Away from the camera, as a box with a hidden bottom would have it; what is seen stays in the world.
    void push_away(double factor) {
        const Vec3 before = x.state[last()].p;
        for (std::size_t k = 0; k <= last(); ++k) {
            const Vec3 camera = scene.window().frames[static_cast<int>(k)].T_c_l.inverse().t;
            x.state[k].p = camera + factor * (x.state[k].p - camera);
        }
        for (Vec3& f : x.f_o) {
            f -= rot_z(-x.state[last()].theta) * (x.state[last()].p - before);
        }
    }

    ObjectScene scene;
    ObjectVariables x{};
    int landmarks{0};
};

TEST(LandmarkStart, BringsAnObjectThatIsTooFarOrTooNearToItsOwnPoints) {
    for (const double factor : {1.5, 1.3, 0.6}) {
        Seen seen;
        ASSERT_GT(seen.landmarks, 8);
        seen.push_away(factor);
        const Vec3 point = seen.in_world(0);
        const double outside = outside_cost(seen.scene.window(), seen.x);
        ASSERT_TRUE(landmark_start(seen.scene.window(), seen.x)) << factor;
        const Vec3 off = seen.x.state[seen.last()].p - seen.scene.truth().p;
        EXPECT_LT(std::fabs(off(0)), 1.5) << factor;
        EXPECT_LT(std::fabs(off(1)), 0.4) << factor;
        EXPECT_NEAR((seen.in_world(0) - point).norm(), 0.0, 1e-9) << "landmarks stay in the world";
        EXPECT_LT(outside_cost(seen.scene.window(), seen.x), outside) << factor;
        EXPECT_FALSE(landmark_start(seen.scene.window(), seen.x)) << "it is there now";
    }
}

TEST(LandmarkStart, ThereIsNoneForAnObjectThatHasItsPointsOrHasTooFew) {
    Seen right;
    EXPECT_FALSE(landmark_start(right.scene.window(), right.x));
    Seen far;
    far.push_away(1.5);
    int kept = 0;
    for (ObjectLandmark& landmark : far.scene.window().landmarks) {
        kept += landmark.valid ? 1 : 0;
        landmark.valid = landmark.valid && kept <= 3;
    }
    EXPECT_FALSE(landmark_start(far.scene.window(), far.x)) << "three may be on something else";
    for (ObjectLandmark& landmark : far.scene.window().landmarks) {
        landmark.valid = false;
    }
    EXPECT_FALSE(landmark_start(far.scene.window(), far.x));
}

TEST(OutsideCost, IsSmallOnTheBodyAndBoundedFarFromIt) {
    Seen seen;
    EXPECT_LT(outside_cost(seen.scene.window(), seen.x), 2.5);  // stereo's noise at 20 m is twice its sigma
    seen.push_away(1.5);
    const double far = outside_cost(seen.scene.window(), seen.x);
    EXPECT_GT(far, 5.0);
    seen.push_away(3.0);
    EXPECT_NEAR(outside_cost(seen.scene.window(), seen.x), far, 0.5);
}

TEST(TurningCost, HoldsTheHeadingOfACarThatStoodByWhatIsKnownOfItAndNoMore) {
    Seen seen;
    ObjectWindow& window = seen.scene.window();
    const auto turned = [&](double rad) {
        ObjectVariables x = seen.x;
        x.state[seen.last()].theta = wrap_angle(window.newest().state.theta + rad);
        return turning_cost(window, x);
    };
    window.heading_information = 0.0;
    EXPECT_EQ(turned(0.5), 0.0) << "nothing is known";
    window.heading_information = 100.0;  // 0.1 rad
    EXPECT_NEAR(turned(0.1), 0.5, 1e-9);
    EXPECT_NEAR(turned(-0.1), 0.5, 1e-9);
    EXPECT_EQ(turned(3.1), kTurningMost);
    window.newest().state.theta = 3.1;  // across pi
    EXPECT_NEAR(turned(0.1), 0.5, 1e-9);
}

TEST(TwinStart, MirrorsTheHeadingAboutTheLineOfSightAndLeavesTheLandmarks) {
    Seen seen;
    for (std::size_t k = 0; k <= seen.last(); ++k) {
        seen.x.state[k].theta = 0.3;
    }
    const Vec3 point = seen.in_world(0);
    const Vec3 camera = seen.scene.window().newest().T_c_l.inverse().t;
    const Vec3 ray = seen.x.state[seen.last()].p - camera;
    const double sight = atan2_rad(ray(1), ray(0));
    ASSERT_TRUE(twin_start(seen.scene.window(), true, seen.x));
    EXPECT_NEAR(wrap_angle(seen.x.state[seen.last()].theta - (2.0 * sight - 0.3)), 0.0, 1e-12);
    EXPECT_NEAR((seen.in_world(0) - point).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace semtrack
