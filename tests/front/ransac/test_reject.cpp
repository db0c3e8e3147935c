#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "scene.hpp"

namespace semtrack {
namespace {

using testing::add;
using testing::judge;
using testing::Scene;
using testing::SceneShape;
using testing::Verdict;

Pose driving() {
    return {so3_exp(Vec3(0.004, -0.01, 0.002)), Vec3(0.03, 0.01, -1.3)};
}

struct Bench {
    std::unique_ptr<Scene> scene = std::make_unique<Scene>();
    std::unique_ptr<OutlierRejection> rejection = std::make_unique<OutlierRejection>();
    Verdict run(const SceneShape& shape, std::uint32_t seed) {
        *scene = Scene{};
        add(*scene, shape, seed);
        rejection->run(scene->features, scene->calibration, seed);
        return judge(*scene, *rejection, shape.owner);
    }
};

void expect_clean(const SceneShape& shape, double recall, double leak, int seeds = 20) {
    Bench bench;
    Verdict all;
    for (int seed = 1; seed <= seeds; ++seed) {
        const Verdict v = bench.run(shape, static_cast<std::uint32_t>(seed));
        EXPECT_GE(v.recall(), recall - 0.1) << "seed " << seed;
        all.inliers += v.inliers;
        all.inliers_kept += v.inliers_kept;
        all.outliers += v.outliers;
        all.outliers_kept += v.outliers_kept;
    }
    EXPECT_GE(all.recall(), recall);
    EXPECT_LE(all.leak(), leak);
    ::testing::Test::RecordProperty("recall", std::to_string(all.recall()));
    ::testing::Test::RecordProperty("leak", std::to_string(all.leak()));
}

TEST(OutlierRejection, GivenThirtyPercentOutliersInABackgroundKeepsTheRestAndNothingElse) {
    SceneShape shape;
    shape.points = 500;
    shape.T_now_before = driving();
    expect_clean(shape, 0.97, 0.01);
}

TEST(OutlierRejection, GivenNoStereoTheEpipolarGeometryAloneFindsOutliersOffTheirLine) {
    SceneShape shape;
    shape.points = 500;
    shape.stereo = false;
    shape.T_now_before = driving();
    expect_clean(shape, 0.97, 0.12);  // the rest lies within a pixel of its epipolar line
}

TEST(OutlierRejection, WorksForAnOncomingObjectInASmallWindow) {
    SceneShape shape;
    shape.owner = 5;
    shape.points = 100;
    shape.T_now_before = {so3_exp(Vec3(0.0, 0.02, 0.0)), Vec3(-0.1, 0.0, -2.4)};
    shape.near_m = 13.0;
    shape.far_m = 16.0;
    shape.left = 400.0;
    shape.right = 520.0;
    shape.top = 150.0;
    shape.bottom = 230.0;
    expect_clean(shape, 0.95, 0.02);
}

TEST(OutlierRejection, WorksForPureForwardMotion) {
    SceneShape shape;
    shape.points = 300;
    shape.T_now_before.t = Vec3(0.0, 0.0, -1.5);
    expect_clean(shape, 0.97, 0.01);
}

TEST(OutlierRejection, WorksForPointsOnAPlane) {
    SceneShape shape;
    shape.points = 300;
    shape.planar = true;
    shape.far_m = 25.0;
    shape.left = 400.0;
    shape.right = 900.0;
    shape.T_now_before = driving();
    expect_clean(shape, 0.95, 0.01);
}

TEST(OutlierRejection, WorksForATurnOnTheSpotWhereNoEpipolarGeometryExists) {
    SceneShape shape;
    shape.points = 300;
    shape.T_now_before.R = so3_exp(Vec3(0.0, 0.03, 0.0));
    expect_clean(shape, 0.95, 0.01);
}

TEST(OutlierRejection, GivenAStandingEgoRejectsTheOneFeatureThatMoved) {
    for (const bool stereo : {true, false}) {
        SceneShape shape;
        shape.points = 80;
        shape.outlier_share = 0.0;
        shape.stereo = stereo;
        Bench bench;
        (void)bench.run(shape, 3);
        bench.scene->features[17].u += 9.0F;
        bench.scene->features[17].u_right += 9.0F;
        bench.rejection->run(bench.scene->features, bench.scene->calibration, 3);
        for (int i = 0; i < 80; ++i) {
            EXPECT_EQ(bench.rejection->inlier(i), i != 17) << i << " stereo " << stereo;
        }
        EXPECT_EQ(bench.rejection->rejected(0), 1);
    }
}

TEST(OutlierRejection, GivenAStandingEgoJudgesFeaturesWithoutDepthByTheMotionOfTheOthers) {
    SceneShape shape;
    shape.points = 60;
    shape.outlier_share = 0.0;
    Bench bench;
    (void)bench.run(shape, 5);
    for (const int i : {7, 8}) {
        bench.scene->features[i].stereo = false;
    }
    bench.scene->features[8].v += 6.0F;
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 5);
    EXPECT_TRUE(bench.rejection->inlier(7));
    EXPECT_FALSE(bench.rejection->inlier(8));
}

TEST(OutlierRejection, SeesAWrongDisparityThatTheLeftImageCannot) {
    SceneShape shape;
    shape.points = 120;
    shape.outlier_share = 0.0;
    shape.T_now_before = driving();
    Bench bench;
    (void)bench.run(shape, 7);
    bench.scene->features[40].u_right -= 15.0F;
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 7);
    EXPECT_FALSE(bench.rejection->inlier(40));
    EXPECT_LE(bench.rejection->rejected(0), 4);
}

TEST(OutlierRejection, GivenSevenOrEightFeaturesTheRigidMotionDecides) {
    for (const int n : {5, 6, 7, 8}) {
        SceneShape shape;
        shape.owner = 2;
        shape.points = n;
        shape.outlier_share = 0.0;
        shape.near_m = 10.0;
        shape.far_m = 14.0;
        shape.T_now_before = driving();
        Bench bench;
        const Verdict clean = bench.run(shape, 11);
        EXPECT_EQ(clean.inliers_kept, n);
        if (n < 6) {
            continue;
        }  // five of five are needed for a consensus
        bench.scene->features[n - 2].v += 12.0F;
        bench.rejection->run(bench.scene->features, bench.scene->calibration, 11);
        for (int i = 0; i < n; ++i) {
            EXPECT_EQ(bench.rejection->inlier(i), i != n - 2) << i << " of " << n;
        }
    }
}

TEST(OutlierRejection, GivenFewerThanFiveFeaturesOrNoneKeepsAll) {
    for (const int n : {0, 1, 4}) {
        SceneShape shape;
        shape.points = n;
        shape.outlier_share = 1.0;
        Bench bench;
        const Verdict v = bench.run(shape, 1);
        EXPECT_EQ(v.outliers_kept, n);
        EXPECT_EQ(bench.rejection->rejected(0), 0);
    }
}

TEST(OutlierRejection, KeepsIdenticalPointsAndPointsOnALine) {
    Bench bench;
    for (int i = 0; i < 40; ++i) {
        FeatureMeasurement m;
        m.tracked = true;
        m.stereo = true;
        m.previous_stereo = true;
        m.u = m.previous_u = 300.0F;
        m.v = m.previous_v = 200.0F;
        m.u += 5.0F;
        m.u_right = 290.0F;
        m.previous_u_right = 285.0F;
        ASSERT_TRUE(bench.scene->features.try_push_back(m));
    }
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 1);
    EXPECT_EQ(bench.rejection->rejected(0), 0);
    for (int i = 0; i < 40; ++i) {
        bench.scene->features[i].previous_u += static_cast<float>(4 * i);
        bench.scene->features[i].u += static_cast<float>(4 * i);
        bench.scene->features[i].previous_u_right += static_cast<float>(4 * i);
        bench.scene->features[i].u_right += static_cast<float>(4 * i);
    }
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 1);
    EXPECT_EQ(bench.rejection->rejected(0), 0);
}

TEST(OutlierRejection, RejectsWhatIsNotFiniteAndJudgesTheOthersAsIfItWereNotThere) {
    SceneShape shape;
    shape.points = 100;
    shape.outlier_share = 0.0;
    shape.T_now_before = driving();
    Bench bench;
    (void)bench.run(shape, 9);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    bench.scene->features[3].u = nan;
    bench.scene->features[20].previous_v = std::numeric_limits<float>::infinity();
    bench.scene->features[50].u_right = nan;
    bench.scene->features[51].previous_u_right = 1e30F;
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 9);
    for (const int i : {3, 20, 50, 51}) {
        EXPECT_FALSE(bench.rejection->inlier(i)) << i;
    }
    EXPECT_LE(bench.rejection->rejected(0), 7);
    bench.scene->features[60].tracked = false;
    bench.scene->features[60].v = nan;
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 9);
    EXPECT_FALSE(bench.rejection->inlier(60));
}

TEST(OutlierRejection, GivenOnlyNoiseRejectsNothingOrKeepsOnlyWhatAgrees) {
    SceneShape shape;
    shape.points = 60;
    shape.outlier_share = 1.0;
    shape.T_now_before = driving();
    Bench bench;
    const Verdict v = bench.run(shape, 2);
    EXPECT_TRUE(v.outliers_kept == 60 || v.outliers_kept < 40) << v.outliers_kept;
}

TEST(OutlierRejection, KeepsNewFeatures) {
    SceneShape shape;
    shape.points = 100;
    shape.T_now_before = driving();
    Bench bench;
    (void)bench.run(shape, 4);
    for (int i = 0; i < 100; ++i) {
        bench.scene->features[i].tracked = false;
    }
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 4);
    EXPECT_EQ(bench.rejection->rejected(0), 0);
}

TEST(OutlierRejection, JudgesEachOwnerOnItsOwn) {
    Bench bench;
    SceneShape shape;
    shape.points = 300;
    shape.T_now_before = driving();
    add(*bench.scene, shape, 21);
    shape.points = 60;
    shape.near_m = 10.0;
    shape.far_m = 13.0;
    for (const std::uint8_t owner : {std::uint8_t{4}, std::uint8_t{32}}) {
        shape.owner = owner;
        shape.T_now_before.t = Vec3(owner == 4 ? 0.8 : -0.9, 0.0, owner == 4 ? 0.2 : -1.9);
        shape.left = owner == 4 ? 100.0 : 700.0;
        shape.right = shape.left + 150.0;
        add(*bench.scene, shape, owner);
    }
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 21);
    for (const int owner : {0, 4, 32}) {
        const Verdict v = judge(*bench.scene, *bench.rejection, owner);
        EXPECT_GE(v.recall(), 0.95) << owner;
        EXPECT_LE(v.leak(), 0.05) << owner;
        EXPECT_EQ(bench.rejection->rejected(owner), v.inliers - v.inliers_kept + v.outliers - v.outliers_kept);
    }
    EXPECT_EQ(bench.rejection->rejected(7), 0);
}

TEST(OutlierRejection, GivesTheSameVerdictsForTheSameInputWhateverRanBefore) {
    SceneShape shape;
    shape.points = 200;
    shape.T_now_before = driving();
    Bench a;
    Bench b;
    (void)b.run(shape, 77);  // leaves other contents in the working memory
    (void)a.run(shape, 5);
    (void)b.run(shape, 5);
    for (int i = 0; i < 200; ++i) {
        ASSERT_EQ(a.rejection->inlier(i), b.rejection->inlier(i));
    }
}

TEST(OutlierRejection, HoldsAtFullCapacity) {
    Bench bench;
    SceneShape shape;
    shape.T_now_before = driving();
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        shape.owner = static_cast<std::uint8_t>(owner);
        shape.points = feature_slots(owner);
        add(*bench.scene, shape, static_cast<std::uint32_t>(owner) + 1U);
    }
    ASSERT_TRUE(bench.scene->features.full());
    bench.rejection->run(bench.scene->features, bench.scene->calibration, 1);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        EXPECT_GE(judge(*bench.scene, *bench.rejection, owner).recall(), 0.9) << owner;
    }
}

}  // namespace
}  // namespace semtrack
