// The paper's matcher on walls and boards whose every match is known.
#include <gtest/gtest.h>

#include "front/feature/orb_extractor.hpp"
#include "front/match/orb_matcher.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

struct Counts {
    int features{0};
    int stereo{0};
    int tracked{0};
    int wrong{0};  // disparity or motion by more than a pixel
};

class FailingExtractor final : public FeatureExtractor {
public:
    Status extract(const ImageView& /*image*/, const OwnerMaskView& /*mask*/, const FeatureBudget& /*budget*/,
                   Keypoints& /*out*/) noexcept override {
        return Status::kInvalidArgument;
    }
};

class OrbMatcherTest : public ::testing::Test {
protected:
    void SetUp() override {
        matcher_->reset();
        matcher_->set_extractor(extractor_.get());
    }
    Status run(const PlaneFrame& frame, const PlaneScene& scene, const OwnerPriors& priors, bool with_right = true) {
        const Calibration calibration = scene.calibration();
        MatcherInput in = frame.input(calibration, priors, ++frame_);
        if (!with_right) {
            in.right = ImageView{};
        }
        return matcher_->process(in, *features_);
    }
    [[nodiscard]] Counts counts(int owner, double disparity_px, double moved_px) const {
        Counts c;
        for (const FeatureMeasurement& m : *features_) {
            if (m.owner != owner) {
                continue;
            }
            ++c.features;
            c.stereo += m.stereo ? 1 : 0;
            c.tracked += m.tracked ? 1 : 0;
            const double d = static_cast<double>(m.u) - static_cast<double>(m.u_right);
            const double moved = static_cast<double>(m.u) - static_cast<double>(m.previous_u);
            c.wrong +=
                (m.stereo && std::fabs(d - disparity_px) > 1.0) || (m.tracked && std::fabs(moved - moved_px) > 1.5) ? 1
                                                                                                                    : 0;
        }
        return c;
    }

    std::unique_ptr<OrbExtractor> extractor_ = std::make_unique<OrbExtractor>();
    std::unique_ptr<OrbMatcher> matcher_ = std::make_unique<OrbMatcher>();
    std::unique_ptr<FrameFeatures> features_ = std::make_unique<FrameFeatures>();
    int frame_{0};
};

TEST_F(OrbMatcherTest, FindsDisparityAndMotionOfAWall) {
    const PlaneScene scene;
    OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    priors[0].T_cur_prev = sideways(12.0, scene.wall_depth_m);
    ASSERT_EQ(run(PlaneFrame(scene, 12.0, 0, 0), scene, priors), Status::kOk);
    const Counts c = counts(0, scene.wall_disparity(), 12.0);
    EXPECT_GE(c.features, 150);
    EXPECT_GE(c.stereo, c.features / 2);
    EXPECT_GE(c.tracked, c.features / 2);
    EXPECT_LE(c.wrong, c.features / 20);
}

TEST_F(OrbMatcherTest, BoardAndWallKeepTheirOwnMatches) {
    PlaneScene scene;
    scene.board = true;
    OwnerPriors priors = still_priors(true);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    priors[0].T_cur_prev = sideways(3.0, scene.wall_depth_m);
    priors[1].T_cur_prev = sideways(-7.0, scene.board_depth_m);
    ASSERT_EQ(run(PlaneFrame(scene, 3.0, 0, -7.0), scene, priors), Status::kOk);
    const Counts board = counts(1, scene.board_disparity(), -7.0);
    EXPECT_GE(board.stereo, 15);
    EXPECT_GE(board.tracked, 15);
    EXPECT_LE(board.wrong, board.features / 8);
    int last = -1;
    for (const FeatureMeasurement& m : *features_) {
        EXPECT_GE(m.owner, last) << "sorted by owner";
        last = m.owner;
    }
}

TEST_F(OrbMatcherTest, DepthRangeOfTheOwnerBoundsItsStereoMatches) {
    const PlaneScene scene;  // at 20 m
    OwnerPriors priors = still_priors(false);
    priors[0].min_depth_m = 40.0;
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    for (const FeatureMeasurement& m : *features_) {
        if (m.stereo) {
            EXPECT_LT(m.u - m.u_right, 12.0F);
        }
    }
}

TEST_F(OrbMatcherTest, WithoutARightImageFeaturesAreFollowedAndNothingIsStereo) {
    const PlaneScene scene;
    const OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors, false), Status::kOk);
    const Counts c = counts(0, 0, 0);
    EXPECT_GT(c.tracked, 100);
    EXPECT_EQ(c.stereo, 0);
}

TEST_F(OrbMatcherTest, RejectedFeatureComesBackOnlyUnderAnotherId) {
    const PlaneScene scene;
    const OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    const FeatureMeasurement gone = (*features_)[10];
    matcher_->reject(gone.owner, gone.slot);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    for (const FeatureMeasurement& m : *features_) {
        EXPECT_NE(m.id, gone.id);
    }
}

TEST_F(OrbMatcherTest, MissingOrFailingExtractorIsReported) {
    const PlaneScene scene;
    const OwnerPriors priors = still_priors(false);
    const PlaneFrame frame(scene, 0, 0, 0);
    FailingExtractor failing;
    matcher_->set_extractor(&failing);
    EXPECT_EQ(run(frame, scene, priors), Status::kInvalidArgument);
    matcher_->set_extractor(nullptr);
    EXPECT_EQ(run(frame, scene, priors), Status::kInvalidArgument);
}

}  // namespace
}  // namespace semtrack
