// The object estimator on road users whose every state is known.
#include "estimate/object/object_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/object/object_scene.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

struct ObjectErrors {
    double position_m{0};  // means over the frames after the tenth
    double heading_rad{0};
    double speed{0};
    int standing{0};
    int frames{0};
};

class ObjectEstimatorTest : public ::testing::Test {
protected:
    ObjectErrors follow(const ObjectSceneOptions& options, int frames = 30, Cues cues = {}) {
        scene_ = std::make_unique<ObjectScene>(options);
        Config config;
        config.cues = cues;
        estimator_->init(scene_->calibration(), config);
        ObjectErrors e;
        for (int k = 0; k < frames; ++k) {
            scene_->next();
            report_ = estimator_->solve(scene_->window(), *system_, *step_);
            EXPECT_TRUE(report_.solved) << k;
            if (k < 10) {
                continue;
            }
            const ObjectState& x = scene_->window().newest().state;
            e.position_m += (x.p - scene_->truth().p).norm();
            e.heading_rad += std::fabs(wrap_angle(x.theta - scene_->truth().theta));
            e.speed += std::fabs(x.v - scene_->truth().v);
            e.standing += scene_->window().standing ? 1 : 0;
            ++e.frames;
        }
        e.position_m /= e.frames;
        e.heading_rad /= e.frames;
        e.speed /= e.frames;
        return e;
    }

    /// The ground is not where the scene's objects stand.
    static Cues cues(bool features) {
        Cues c;
        c.features = features;
        c.alignment = false;
        c.ground = false;
        return c;
    }

    std::unique_ptr<ObjectEstimator> estimator_ = std::make_unique<ObjectEstimator>();
    std::unique_ptr<NormalEquations> system_ = std::make_unique<NormalEquations>();
    std::unique_ptr<SolverStep> step_ = std::make_unique<SolverStep>();
    std::unique_ptr<ObjectScene> scene_;
    ObjectSolveReport report_{};
};

ObjectSceneOptions driving(double v, double delta, double theta = 0.0) {
    ObjectSceneOptions o;
    o.start.p = Vec3(14.0, 1.5, -0.9);
    o.start.theta = theta;
    o.start.v = v;
    o.start.delta = delta;
    return o;
}

TEST_F(ObjectEstimatorTest, ParkedCarStandsAndStaysInItsPlace) {
    ObjectSceneOptions o;
    o.start.p = Vec3(25.0, 4.0, -0.9);
    o.start.theta = 0.1;
    const ObjectErrors e = follow(o, 30, cues(true));
    EXPECT_EQ(e.standing, e.frames);
    EXPECT_EQ(e.speed, 0.0);
    EXPECT_LT(e.position_m, 0.6);
    EXPECT_LT(e.heading_rad, 0.1);
}

// Without boxes its features may be those of a car that passes.
TEST_F(ObjectEstimatorTest, ParkedCarDoesNotStartToMoveUnseen) {
    ObjectSceneOptions o;
    o.start.p = Vec3(25.0, 4.0, -0.9);
    (void)follow(o, 15, cues(true));
    ASSERT_TRUE(scene_->window().standing);
    scene_->drive_on(6.0);
    for (int k = 1; k <= 8; ++k) {
        scene_->next();
        scene_->window().newest().box.valid = false;
        report_ = estimator_->solve(scene_->window(), *system_, *step_);
        EXPECT_LE(std::fabs(scene_->window().newest().state.v), 1.0) << k;
    }
}

TEST_F(ObjectEstimatorTest, ParkedCarThatDrivesOffIsSeenToMoveWithinHalfASecond) {
    ObjectSceneOptions o;
    o.start.p = Vec3(25.0, 4.0, -0.9);
    (void)follow(o, 15, cues(true));
    ASSERT_TRUE(scene_->window().standing);
    scene_->drive_on(4.0);
    for (int k = 0; k < 10; ++k) {
        scene_->next();
        report_ = estimator_->solve(scene_->window(), *system_, *step_);
        const double v = scene_->window().newest().state.v;
        EXPECT_TRUE(k < 5 || v > 1.0) << k << ": " << v;
    }
    EXPECT_NEAR(scene_->window().newest().state.v, 4.0, 0.8);
}

TEST_F(ObjectEstimatorTest, SpeedOfALeadingCarComesFromItsFeatures) {
    const ObjectErrors with = follow(driving(6.0, 0.0), 30, cues(true));
    EXPECT_LT(with.speed, 0.15);
    EXPECT_LT(with.position_m, 0.5);
    EXPECT_EQ(with.standing, 0);
    const ObjectErrors without = follow(driving(6.0, 0.0), 30, cues(false));
    EXPECT_GT(without.speed, 1.5 * with.speed) << "boxes alone say less";
}

TEST_F(ObjectEstimatorTest, TurningCarIsFollowedByTheBicycleModel) {
    const ObjectErrors e = follow(driving(6.0, 0.12), 30, cues(true));
    EXPECT_LT(e.speed, 0.25);
    EXPECT_LT(e.heading_rad, 0.08);
    EXPECT_NEAR(scene_->window().newest().state.delta, 0.12, 0.06);
}

TEST_F(ObjectEstimatorTest, OncomingCarKeepsASignedHeadingAcrossPi) {
    ObjectSceneOptions o = driving(8.0, 0.0, kPi - 0.02);
    o.start.p = Vec3(55.0, 3.0, -0.9);
    const ObjectErrors e = follow(o, 24, cues(true));
    EXPECT_LT(e.heading_rad, 0.1);
    EXPECT_LT(e.speed, 0.6);
    EXPECT_GT(scene_->window().newest().state.v, 7.0);
}

TEST_F(ObjectEstimatorTest, ReversingCarHasANegativeSpeed) {
    ObjectSceneOptions o = driving(-3.0, 0.0);
    o.start.p = Vec3(30.0, 2.0, -0.9);
    const ObjectErrors e = follow(o, 30, cues(true));
    EXPECT_LT(e.speed, 0.3);
    EXPECT_LT(scene_->window().newest().state.v, -2.5);
}

TEST_F(ObjectEstimatorTest, PedestrianWalksAcrossWithoutAHeading) {
    ObjectSceneOptions o;
    o.object_class = ObjectClass::kPedestrian;
    o.size_m = Vec3(0.7, 0.6, 1.75);
    o.start = {Vec3(22.0, 4.0, -0.8), -0.5 * kPi, 1.4, 0.0};
    o.features = 15;
    o.ego_step_m = 0.3;
    const ObjectErrors e = follow(o, 30, cues(true));
    EXPECT_LT(e.position_m, 0.6);
    EXPECT_LT(std::fabs(scene_->window().newest().state.v - 1.4), 0.5);
}

TEST_F(ObjectEstimatorTest, FeaturesOnTheWallBehindAreCulled) {
    constexpr int kSeeds = 16;
    ObjectSceneOptions o = driving(6.0, 0.0);
    o.outliers = 6;
    double squares = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        o.seed = static_cast<std::uint32_t>(seed);
        int culled = 0;
        scene_ = std::make_unique<ObjectScene>(o);
        Config config;
        config.cues = cues(true);
        estimator_->init(scene_->calibration(), config);
        for (int k = 0; k < 20; ++k) {
            scene_->next();
            report_ = estimator_->solve(scene_->window(), *system_, *step_);
            for (const std::int16_t slot : report_.culled) {
                culled += slot < o.outliers ? 1 : 0;
            }
        }
        EXPECT_GE(culled, o.outliers) << "seed " << seed;
        const double off_mps = scene_->window().newest().state.v - 6.0;
        squares += off_mps * off_mps;
    }
    // The matcher finds them again at once, and in its first two frames such a point is not told from the car's own.
    EXPECT_LT(std::sqrt(squares / kSeeds), 1.0);  // measured: 0.82; never culled: 1.66
}

TEST_F(ObjectEstimatorTest, SizeMovesFromThePriorTowardsTheTruthAndItsSigmaShrinks) {
    ObjectSceneOptions o;
    o.start.p = Vec3(18.0, 3.5, -0.9);
    o.size_m = Vec3(4.4, 1.75, 1.70);
    (void)follow(o, 30, cues(true));
    const ObjectWindow& w = scene_->window();
    const ClassPrior& prior = class_prior(ObjectClass::kCar);
    EXPECT_LT(std::fabs(w.size_m(2) - 1.70), std::fabs(prior.size_m(2) - 1.70));
    EXPECT_LT(w.size_covariance(2, 2), prior.size_sigma_m(2) * prior.size_sigma_m(2));
}

TEST_F(ObjectEstimatorTest, CovarianceIsPositiveAndGrowsWithTheDistance) {
    ObjectSceneOptions near;
    near.start.p = Vec3(22.0, 3.0, -0.9);
    (void)follow(near, 15, cues(true));
    const double near_x = scene_->window().covariance(0, 0);
    ObjectSceneOptions far = near;
    far.start.p = Vec3(60.0, 3.0, -0.9);
    (void)follow(far, 15, cues(true));
    EXPECT_GT(near_x, 0.0);
    EXPECT_GT(scene_->window().covariance(0, 0), 2.0 * near_x);
}

TEST_F(ObjectEstimatorTest, OneFrameIsEnoughToStartAndNothingMeasuredChangesNothing) {
    ObjectSceneOptions o;
    scene_ = std::make_unique<ObjectScene>(o);
    estimator_->init(scene_->calibration(), Config{});
    scene_->next();
    EXPECT_TRUE(estimator_->solve(scene_->window(), *system_, *step_).solved);
    EXPECT_LT((scene_->window().newest().state.p - scene_->truth().p).norm(), 2.5);
    ObjectWindow empty;
    EXPECT_FALSE(estimator_->solve(empty, *system_, *step_).solved);
}

}  // namespace
}  // namespace semtrack
