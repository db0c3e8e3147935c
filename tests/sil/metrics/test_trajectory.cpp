#include "sil/metrics/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"

namespace semtrack::sil {
namespace {

Pose at(double x, double y, double z) {
    return {Mat3::Identity(), Vec3(x, y, z)};
}

Trajectory straight(int rows, double scale) {
    Trajectory out;
    for (int n = 0; n < rows; ++n) {
        out[n] = at(0.0, 0.0, scale * n);
    }
    return out;
}

Trajectory curve(int rows) {
    Trajectory out;
    for (int n = 0; n < rows; ++n) {
        out[n] = {so3_exp(Vec3(0.001 * n, 0.01 * n, -0.002 * n)), Vec3(0.01 * n * n, 0.002 * n, 1.1 * n)};
    }
    return out;
}

TEST(Trajectory, APathEqualToItsTruthHasNoErrors) {
    const TrajectoryErrors e = compare_trajectories(curve(200), curve(200));
    EXPECT_LT(*e.ate_rmse_m, 1e-9);
    EXPECT_LT(*e.rpe_trans_mean_m, 1e-12);
    EXPECT_LT(*e.rpe_rot_mean_deg, 1e-9);
    EXPECT_LT(*e.segment_trans_percent, 1e-9);
    EXPECT_GT(e.segments, 0);
}

TEST(Trajectory, AStraightPathOnePercentTooLongHasTheErrorsReckonedByHand) {
    // Errors 0.01 (n - 50), n = 0..100: the root of the mean square is 0.01 sqrt(850).
    const TrajectoryErrors e = compare_trajectories(straight(101, 1.01), straight(101, 1.0));
    EXPECT_NEAR(*e.ate_rmse_m, 0.01 * std::sqrt(850.0), 1e-12);
    EXPECT_NEAR(*e.ate_rmse_m, 0.29155, 1e-5);
    EXPECT_NEAR(*e.rpe_trans_mean_m, 0.01, 1e-12);
    EXPECT_NEAR(*e.rpe_trans_rms_m, 0.01, 1e-12);
    EXPECT_NEAR(*e.rpe_rot_mean_deg, 0.0, 1e-12);
    EXPECT_NEAR(*e.path_length_m, 101.0, 1e-9);
    EXPECT_NEAR(*e.truth_path_length_m, 100.0, 1e-9);
}

TEST(Trajectory, ATruthThatIsTurnedAndMovedMakesNoAbsoluteError) {
    Trajectory moved;
    const Pose T{so3_exp(Vec3(0.7, -2.0, 0.4)), Vec3(1000.0, -20.0, 5.0)};
    for (const auto& [n, pose] : curve(100)) {
        moved[n] = T * pose;
    }
    const TrajectoryErrors e = compare_trajectories(curve(100), moved);
    EXPECT_LT(*e.ate_rmse_m, 1e-9);
    EXPECT_LT(*e.rpe_trans_mean_m, 1e-9);
}

TEST(Trajectory, AHalfTurnIsFoundByTheAlignment) {
    std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    std::vector<Vec3> to;
    const Mat3 R = so3_exp(Vec3(0.0, kPi, 0.0));
    for (const Vec3& p : from) {
        to.push_back(R * p + Vec3(4, 5, 6));
    }
    const Pose T = align_se3(from, to);
    EXPECT_LT((T.R - R).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((T.t - Vec3(4, 5, 6)).norm(), 1e-12);
}

TEST(Trajectory, AMirroredPathIsNotAlignedByAReflection) {
    const std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<Vec3> to{{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_GT(align_se3(from, to).R.determinant(), 0.99);
}

TEST(Trajectory, AStandingPathAgainstAStandingTruthIsWithoutError) {
    const TrajectoryErrors e = compare_trajectories(straight(20, 0.0), straight(20, 0.0));
    EXPECT_EQ(*e.ate_rmse_m, 0.0);
    EXPECT_EQ(*e.rpe_trans_mean_m, 0.0);
    EXPECT_EQ(*e.path_length_m, 0.0);
    EXPECT_FALSE(e.segment_trans_percent.has_value());
}

TEST(Trajectory, AStandingPathAgainstAMovingTruthHasTheTruthsSpreadAsError) {
    const TrajectoryErrors e = compare_trajectories(straight(101, 0.0), straight(101, 1.0));
    EXPECT_NEAR(*e.ate_rmse_m, std::sqrt(850.0), 1e-9);
    EXPECT_NEAR(*e.rpe_trans_mean_m, 1.0, 1e-12);
}

TEST(Trajectory, BelowAHundredMetresThereAreNoSegments) {
    const TrajectoryErrors e = compare_trajectories(straight(61, 1.0), straight(61, 1.0));
    EXPECT_EQ(e.segments, 0);
    EXPECT_FALSE(e.segment_trans_percent.has_value());
    EXPECT_FALSE(e.segment_rot_deg_per_100m.has_value());
}

TEST(Trajectory, SegmentsOfAPathTwoPercentTooLongAreTwoPercentOff) {
    const TrajectoryErrors e = compare_trajectories(straight(251, 1.02), straight(251, 1.0));
    // A segment ends at the first frame beyond its length: 101 m for 100 m.
    EXPECT_NEAR(*e.segment_trans_percent, 2.0, 0.03);
    EXPECT_NEAR(*e.segment_rot_deg_per_100m, 0.0, 1e-9);
    EXPECT_EQ(e.segments, 15 + 5);  // starts 0..140 reach 100 m, 0..40 reach 200 m
}

TEST(Trajectory, OneRowHasAnAbsoluteErrorOfNothingAndNoRelativeOne) {
    const TrajectoryErrors e = compare_trajectories({{7, at(1, 2, 3)}}, {{7, at(0, 0, 0)}, {8, at(1, 0, 0)}});
    EXPECT_EQ(e.frames_compared, 1);
    EXPECT_EQ(*e.ate_rmse_m, 0.0);
    EXPECT_FALSE(e.rpe_trans_mean_m.has_value());
}

TEST(Trajectory, WithoutCommonFramesNothingIsKnown) {
    const TrajectoryErrors e = compare_trajectories({{1, at(0, 0, 0)}}, {{2, at(0, 0, 0)}});
    EXPECT_EQ(e.frames_compared, 0);
    EXPECT_FALSE(e.ate_rmse_m.has_value());
    EXPECT_FALSE(e.path_length_m.has_value());
}

TEST(Trajectory, RowsArePairedByFrameNumberAndAGapMakesNoRelativeError) {
    Trajectory result = straight(20, 1.0);
    for (int n = 8; n < 12; ++n) {
        result.erase(n);
    }
    const TrajectoryErrors e = compare_trajectories(result, straight(20, 1.0));
    EXPECT_EQ(e.frames_compared, 16);
    EXPECT_LT(*e.ate_rmse_m, 1e-9);
    EXPECT_LT(*e.rpe_trans_mean_m, 1e-12);  // a pair over the gap would have an error only if it were taken as a step
}

TEST(Trajectory, RotationErrorsAreInDegreesAStep) {
    Trajectory result;
    for (int n = 0; n < 10; ++n) {
        result[n] = {so3_exp(Vec3(0.0, 0.01 * n, 0.0)), Vec3::Zero()};
    }
    const TrajectoryErrors e = compare_trajectories(result, straight(10, 0.0));
    EXPECT_NEAR(*e.rpe_rot_mean_deg, 0.01 * 180.0 / kPi, 1e-9);
}

}  // namespace
}  // namespace semtrack::sil
