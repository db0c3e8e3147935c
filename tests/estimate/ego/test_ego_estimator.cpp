// Ego-motion on drives whose every pose and landmark is known.
#include "estimate/ego/ego_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "estimate/ego/drive_scene.hpp"
#include "math/cholesky6.hpp"

namespace semtrack {
namespace {

constexpr int kFrames = 60;

struct DriveErrors {
    double end_m{0};   // position at the end
    double step_m{0};  // mean of the motions' errors
    double step_rad{0};
    double nees{0};  // mean of e^T C^-1 e of the motions, 6 degrees of freedom
    int predicted{0};
};

class EgoEstimatorTest : public ::testing::Test {
protected:
    Status process(const FrameFeatures* features, const VehicleMotion* motion = nullptr) {
        EgoInput in;
        in.motion = motion;
        in.frame = ++frame_;
        in.time_us = DriveScene::kFrame_us * frame_;
        in.features = features;
        in.has_images = features != nullptr;
        return estimator_->process(in, *system_, *step_, *result_);
    }

    /// blind: frames without images.
    DriveErrors drive(const DriveOptions& options, int blind_from = -1, int blind_to = -1) {
        DriveScene scene(options);
        estimator_->init(scene.calibration());
        frame_ = 0;
        DriveErrors e;
        Pose last_truth;
        Pose last;
        int counted = 0;
        for (int k = 0; k < kFrames; ++k) {
            scene.next(*features_);
            const bool blind = k >= blind_from && k <= blind_to;
            const Status status = process(blind ? nullptr : features_.get());
            e.predicted += result_->status == EgoStatus::kPredicted ? 1 : 0;
            EXPECT_TRUE(blind || status == Status::kOk) << k;
            if (k > 0 && !blind) {
                const Pose truth = last_truth.inverse() * scene.T_w_c();
                const Pose error = truth.inverse() * (last.inverse() * result_->T_w_c);
                Vec6 xi;
                xi << error.t, so3_log(error.R);
                e.step_m += xi.head<3>().norm();
                e.step_rad += xi.tail<3>().norm();
                Vec6 weighted;
                if (solve6(result_->motion_covariance, xi, weighted)) {
                    e.nees += xi.dot(weighted);
                }
                ++counted;
            }
            last_truth = scene.T_w_c();
            last = result_->T_w_c;
        }
        e.step_m /= counted;
        e.step_rad /= counted;
        e.nees /= counted;
        e.end_m = (result_->T_w_c.t - scene.T_w_c().t).norm();
        return e;
    }

    std::unique_ptr<EgoEstimator> estimator_ = std::make_unique<EgoEstimator>();
    std::unique_ptr<NormalEquations> system_ = std::make_unique<NormalEquations>();
    std::unique_ptr<SolverStep> step_ = std::make_unique<SolverStep>();
    std::unique_ptr<EgoResult> result_ = std::make_unique<EgoResult>();
    std::unique_ptr<FrameFeatures> features_ = std::make_unique<FrameFeatures>();
    std::uint32_t frame_{0};
};

TEST_F(EgoEstimatorTest, ExactMeasurementsGiveTheExactPath) {
    DriveOptions options;
    options.noise_px = 0.0;
    const DriveErrors e = drive(options);
    EXPECT_LT(e.end_m, 2e-3) << "pixels are single precision";
    EXPECT_LT(e.step_m, 1e-4);
    EXPECT_EQ(e.predicted, 0);
}

TEST_F(EgoEstimatorTest, NoisyMeasurementsGiveThePathToAFractionOfAPercent) {
    const DriveErrors e = drive({});
    EXPECT_LT(e.end_m, 0.003 * 0.8 * kFrames);
    EXPECT_LT(e.step_m, 0.012);
    EXPECT_LT(e.step_rad, 4e-4);
}

TEST_F(EgoEstimatorTest, FewerFeaturesAndMoreNoiseAreSeenInTheError) {
    const DriveErrors good = drive({});
    DriveOptions poor;
    poor.features = 60;
    poor.noise_px = 0.8;
    EXPECT_GT(drive(poor).step_m, 2.0 * good.step_m);
}

TEST_F(EgoEstimatorTest, AFifthOfOutliersDoesNotPullThePath) {
    DriveOptions options;
    options.outlier_share = 0.2;
    const DriveErrors e = drive(options);
    EXPECT_LT(e.end_m, 0.005 * 0.8 * kFrames);
    EXPECT_LT(e.step_m, 0.02);
    EXPECT_GT(result_->outliers.size(), 10);
}

TEST_F(EgoEstimatorTest, CovarianceOfTheMotionFitsItsErrors) {
    DriveOptions options;
    options.noise_px = 0.25;  // as the measurements say of themselves
    const DriveErrors e = drive(options);
    EXPECT_GT(e.nees, 1.0);
    EXPECT_LT(e.nees, 15.0);
}

TEST_F(EgoEstimatorTest, FramesWithoutImagesArePredictedAndTheMotionGoesOn) {
    DriveOptions options;
    const DriveErrors e = drive(options, 30, 31);
    EXPECT_EQ(e.predicted, 2);
    EXPECT_LT(e.end_m, 0.2);
}

TEST_F(EgoEstimatorTest, StandingCameraStaysWhereItIs) {
    DriveOptions options;
    options.step_m = 0.0;
    options.turn_rad = 0.0;
    const DriveErrors e = drive(options);
    EXPECT_LT(e.end_m, 0.01);
    EXPECT_LT(result_->T_prev_cur.t.norm(), 0.005);
}

TEST_F(EgoEstimatorTest, NoFeaturesAtAllIsAPredictionNotAnError) {
    DriveScene scene({});
    estimator_->init(scene.calibration());
    FrameFeatures& none = *features_;
    none.clear();
    ASSERT_EQ(process(&none), Status::kOk);
    EXPECT_EQ(result_->status, EgoStatus::kStart);
    EXPECT_EQ(process(&none), Status::kNotConverged);
    EXPECT_EQ(result_->status, EgoStatus::kPredicted);
    EXPECT_TRUE(is_finite(result_->T_w_c));
}

TEST_F(EgoEstimatorTest, TimeAndFrameNumbersHaveToGrow) {
    DriveScene scene({});
    estimator_->init(scene.calibration());
    scene.next(*features_);
    ASSERT_EQ(process(features_.get()), Status::kOk);
    frame_ = 0;
    EXPECT_EQ(process(features_.get()), Status::kInvalidArgument);
}

TEST_F(EgoEstimatorTest, FeaturesThatAreNotFiniteAreLeftOut) {
    DriveScene scene({});
    estimator_->init(scene.calibration());
    for (int k = 0; k < 5; ++k) {
        scene.next(*features_);
        for (int i = 0; i < features_->size(); i += 10) {
            (*features_)[i].u = std::nanf("");
        }
        ASSERT_EQ(process(features_.get()), Status::kOk);
    }
    EXPECT_LT((result_->T_w_c.t - scene.T_w_c().t).norm(), 0.05);
}

TEST_F(EgoEstimatorTest, GivenPoseIsTakenAsItIs) {
    DriveScene scene({});
    estimator_->init(scene.calibration());
    for (int k = 0; k < 6; ++k) {
        scene.next(*features_);
        EgoInput in;
        in.frame = ++frame_;
        in.time_us = DriveScene::kFrame_us * frame_;
        in.features = features_.get();
        in.has_images = true;
        const Pose given = scene.T_w_c();
        in.given_T_w_c = &given;
        ASSERT_EQ(estimator_->process(in, *system_, *step_, *result_), Status::kOk);
        EXPECT_EQ(result_->status, EgoStatus::kGiven);
        EXPECT_LT((result_->T_w_c.t - given.t).norm(), 1e-12);
    }
    Pose broken;
    broken.t(0) = std::nan("");
    EgoInput in;
    in.frame = ++frame_;
    in.time_us = DriveScene::kFrame_us * frame_;
    in.given_T_w_c = &broken;
    EXPECT_EQ(estimator_->process(in, *system_, *step_, *result_), Status::kInvalidArgument);
}

TEST_F(EgoEstimatorTest, HistoryHoldsTheRevisedPosesOfTheLastFrames) {
    DriveScene scene({});
    estimator_->init(scene.calibration());
    std::vector<Pose> truth;
    for (int k = 0; k < 20; ++k) {
        scene.next(*features_);
        truth.push_back(scene.T_w_c());
        ASSERT_EQ(process(features_.get()), Status::kOk);
    }
    for (std::uint32_t f = 1; f <= 20; ++f) {
        Pose T;
        ASSERT_TRUE(estimator_->history().find(f, T)) << f;
        EXPECT_LT((T.t - truth[f - 1].t).norm(), 0.08) << f;
    }
}

}  // namespace
}  // namespace semtrack
