// Published covariances against exact truth, over many drives: noise of the features, and a calibration whose
// disparities are off by a tenth of a pixel, another one on every drive.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "estimate/ego/drive_scene.hpp"
#include "estimate/ego/ego_estimator.hpp"
#include "math/cholesky6.hpp"
#include "support/sweep.hpp"

namespace semtrack {
namespace {

constexpr int kDrives = 24;
constexpr int kFrames = 50;
constexpr double kInside95 = 1.96 * 1.96;
constexpr double kSix95 = 12.59;  // chi squared of 6 degrees of freedom

struct Shares {
    int motions{0};
    int along_inside{0};
    int yaw_inside{0};
    int poses{0};
    int pose_inside{0};  ///< of the last pose of each drive, all six
    double along_nees{0};
    double pose_nees{0};  ///< per degree of freedom
};

Vec6 error_of(const Pose& truth, const Pose& estimate) {
    const Pose d = truth.inverse() * estimate;
    Vec6 out;
    out << d.t, so3_log(orthonormalised(d.R));
    return out;
}

void add_drive(const DriveOptions& options, Shares& s) {
    DriveScene scene(options);
    const auto estimator = std::make_unique<EgoEstimator>();
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto result = std::make_unique<EgoResult>();
    const auto features = std::make_unique<FrameFeatures>();
    estimator->init(scene.calibration());
    Pose truth_before;
    for (int k = 0; k < kFrames; ++k) {
        scene.next(*features);
        EgoInput in;
        in.frame = static_cast<std::uint32_t>(k + 1);
        in.time_us = DriveScene::kFrame_us * (k + 1);
        in.features = features.get();
        in.has_images = true;
        ASSERT_EQ(estimator->process(in, *system, *step, *result), Status::kOk);
        if (k > 0) {
            const Vec6 e = error_of(truth_before.inverse() * scene.T_w_c(), result->T_prev_cur);
            const double along = e(2) * e(2) / result->motion_covariance(2, 2);
            ++s.motions;
            s.along_nees += along;
            s.along_inside += along < kInside95 ? 1 : 0;
            s.yaw_inside += e(4) * e(4) < kInside95 * result->motion_covariance(4, 4) ? 1 : 0;
        }
        truth_before = scene.T_w_c();
    }
    const Vec6 e = error_of(scene.T_w_c(), result->T_w_c);
    Vec6 weighted;
    ASSERT_TRUE(solve6(result->covariance, e, weighted));
    const double nees = e.dot(weighted);
    ++s.poses;
    s.pose_nees += nees / 6.0;
    s.pose_inside += nees < kSix95 ? 1 : 0;
}

Shares shares(double noise_px, double disparity_sigma_px) {
    Shares s;
    Rng rng(5U);
    for (int d = 0; d < kDrives / kSweepShare; ++d) {
        DriveOptions options;
        options.seed = static_cast<std::uint32_t>(d + 1);
        options.noise_px = noise_px;
        options.disparity_error_px = disparity_sigma_px * normal(rng);
        add_drive(options, s);
    }
    std::printf(
        "noise %.2f px, disparity %.2f px: along NEES %.2f inside %.3f, yaw inside %.3f, last pose NEES %.2f "
        "inside %.3f\n",
        noise_px, disparity_sigma_px, s.along_nees / s.motions, static_cast<double>(s.along_inside) / s.motions,
        static_cast<double>(s.yaw_inside) / s.motions, s.pose_nees / s.poses,
        static_cast<double>(s.pose_inside) / s.poses);
    return s;
}

TEST(EgoCovariance, NineMotionsOfTenLieInsideTheir95PercentInterval) {
    for (const double noise : {0.15, 0.6}) {
        const Shares s = shares(noise, kDisparityError_px);
        EXPECT_GE(s.along_inside, 9 * s.motions / 10) << noise;
        EXPECT_GE(s.yaw_inside, 9 * s.motions / 10) << noise;
        EXPECT_GE(s.pose_inside, 9 * s.poses / 10) << noise;
        EXPECT_GT(s.along_nees, 0.2 * s.motions) << noise << ": far too careful";
        EXPECT_GT(s.pose_nees, 0.1 * s.poses) << noise << ": far too careful";
    }
}

TEST(EgoCovariance, ADisparityErrorBeyondItsSigmaIsSeen) {
    const Shares s = shares(0.15, 5.0 * kDisparityError_px);
    EXPECT_LT(s.along_inside, 7 * s.motions / 10);
}

}  // namespace
}  // namespace semtrack
