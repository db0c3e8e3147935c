// Patch matcher on walls and boards whose every match is known.
#include <gtest/gtest.h>

#include <set>

#include "front/match/patch_matcher.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

struct Errors {
    int features{0};
    int stereo{0};
    int tracked{0};
    double stereo_px{0};  // largest
    double motion_px{0};  // largest
    int wrong{0};         // stereo by more than 0.5 px or motion by more than 0.3 px
};

class PatchMatcherTest : public ::testing::Test {
protected:
    Status run(const PlaneFrame& frame, const PlaneScene& scene, const OwnerPriors& priors, bool with_right = true) {
        const Calibration calibration = scene.calibration();
        MatcherInput in = frame.input(calibration, priors, ++frame_);
        if (!with_right) {
            in.right = ImageView{};
        }
        return matcher_->process(in, *features_);
    }

    [[nodiscard]] Errors errors(int owner, double disparity_px, double moved_px) const {
        Errors e;
        for (const FeatureMeasurement& m : *features_) {
            if (m.owner != owner) {
                continue;
            }
            ++e.features;
            bool right = true;
            if (m.stereo) {
                ++e.stereo;
                const double d = static_cast<double>(m.u) - static_cast<double>(m.u_right);
                e.stereo_px = std::max(e.stereo_px, std::fabs(d - disparity_px));
                right = std::fabs(d - disparity_px) < 0.5;
            }
            if (m.tracked) {
                ++e.tracked;
                const double moved = static_cast<double>(m.u) - static_cast<double>(m.previous_u);
                e.motion_px = std::max(e.motion_px, std::fabs(moved - moved_px));
                right = right && std::fabs(moved - moved_px) < 0.3;
            }
            e.wrong += right ? 0 : 1;
        }
        return e;
    }

    std::unique_ptr<PatchMatcher> matcher_ = std::make_unique<PatchMatcher>();
    std::unique_ptr<FrameFeatures> features_ = std::make_unique<FrameFeatures>();
    int frame_{0};
};

TEST_F(PatchMatcherTest, FindsTheDisparityOfAWallBelowAPixel) {
    for (const double depth : {8.0, 20.0, 60.0}) {
        PlaneScene scene;
        scene.wall_depth_m = depth;
        matcher_->reset();
        ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, still_priors(false)), Status::kOk);
        const Errors e = errors(0, scene.wall_disparity(), 0.0);
        EXPECT_GE(e.features, 200) << depth;
        EXPECT_GE(e.stereo, e.features * 8 / 10) << depth;
        EXPECT_LT(e.stereo_px, 0.5) << depth;
    }
}

TEST_F(PatchMatcherTest, FollowsAWallThatMovesAsPredicted) {
    const PlaneScene scene;
    OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    priors[0].T_cur_prev = sideways(12.3, scene.wall_depth_m);
    for (int k = 1; k <= 4; ++k) {
        ASSERT_EQ(run(PlaneFrame(scene, 12.3 * k, 0, 0), scene, priors), Status::kOk);
        const Errors e = errors(0, scene.wall_disparity(), 12.3);
        EXPECT_GE(e.tracked, e.features * 7 / 10) << k;
        EXPECT_LT(e.motion_px, 0.3) << k;
    }
}

TEST_F(PatchMatcherTest, FollowsAcrossAPredictionThatIsAFewPixelsWrong) {
    const PlaneScene scene;
    OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    ASSERT_EQ(run(PlaneFrame(scene, 5.0, -2.0, 0), scene, priors), Status::kOk);
    const Errors e = errors(0, scene.wall_disparity(), 5.0);
    EXPECT_GE(e.tracked, e.features * 6 / 10);
    EXPECT_LT(e.motion_px, 0.3);
}

TEST_F(PatchMatcherTest, WhenTheWholeImageJumpsByMoreThanTheSearchReachesItsFeaturesAreKept) {
    const PlaneScene scene;
    for (const double jump : {-40.0, 0.0, 30.0}) {
        matcher_->reset();
        for (int k = 0; k < 3; ++k) {
            ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, still_priors(false)), Status::kOk);
        }
        const int before = features_->size();
        ASSERT_EQ(run(PlaneFrame(scene, 5.0, jump, 0), scene, still_priors(false)), Status::kOk);
        int tracked = 0;
        for (const FeatureMeasurement& m : *features_) {
            tracked += m.tracked ? 1 : 0;
            if (m.tracked) {
                EXPECT_NEAR(static_cast<double>(m.v - m.previous_v), jump, 0.5);
                EXPECT_NEAR(static_cast<double>(m.u - m.previous_u), 5.0, 0.5);
            }
        }
        EXPECT_GT(tracked, before * 6 / 10) << jump;  // others left the image
    }
}

TEST_F(PatchMatcherTest, WhenNothingIsLikeBeforeNothingIsFollowed) {
    PlaneScene scene;
    for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, still_priors(false)), Status::kOk);
    }
    ASSERT_EQ(run(PlaneFrame(scene, 5000.0, 3000.0, 0), scene, still_priors(false)), Status::kOk);  // elsewhere
    int tracked = 0;
    for (const FeatureMeasurement& m : *features_) {
        tracked += m.tracked ? 1 : 0;
    }
    EXPECT_LT(tracked, features_->size() / 4) << "smooth patches are alike by chance; RANSAC is there for them";
    EXPECT_GT(features_->size(), 200) << "new ones are taken";
}

TEST_F(PatchMatcherTest, AFeatureThatIsNotSeenForAFrameOrTwoIsFoundAgainUnderItsId) {
    for (const int hidden : {1, 2, 3}) {
        matcher_->reset();
        PlaneScene scene;
        OwnerPriors priors = still_priors(false);
        priors[0].T_cur_prev = sideways(4.0, scene.wall_depth_m);
        int k = 0;
        for (; k < 5; ++k) {
            ASSERT_EQ(run(PlaneFrame(scene, 4.0 * k, 0, 0), scene, priors), Status::kOk);
        }
        std::set<std::uint32_t> before;
        for (const FeatureMeasurement& m : *features_) {
            if (m.u > 240.0F && m.u < 390.0F && m.v > 80.0F && m.v < 160.0F && m.age >= 3) {
                before.insert(m.id);
            }
        }
        ASSERT_GE(before.size(), 15U);
        scene.gain = 0.0;  // the left camera is blind
        for (int i = 0; i < hidden; ++i, ++k) {
            ASSERT_EQ(run(PlaneFrame(scene, 4.0 * k, 0, 0), scene, priors), Status::kOk);
        }
        scene.gain = 1.0;
        ASSERT_EQ(run(PlaneFrame(scene, 4.0 * k, 0, 0), scene, priors), Status::kOk);
        std::size_t again = 0;
        for (const FeatureMeasurement& m : *features_) {
            again += before.count(m.id);
        }
        if (hidden <= 2) {
            EXPECT_GE(again, before.size() / 2) << hidden;
        } else {
            EXPECT_LE(again, before.size() / 4) << "after three frames they are gone";
        }
    }
}

TEST_F(PatchMatcherTest, IdentityLastsWhileAFeatureIsSeenAndIdsAreNeverUsedTwice) {
    const PlaneScene scene;
    OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    std::uint32_t highest = 0;
    for (const FeatureMeasurement& m : *features_) {
        highest = std::max(highest, m.id);
        EXPECT_FALSE(m.tracked);
    }
    priors[0].T_cur_prev = sideways(60.0, scene.wall_depth_m);
    ASSERT_EQ(run(PlaneFrame(scene, 60.0, 0, 0), scene, priors), Status::kOk);
    int born = 0;
    for (const FeatureMeasurement& m : *features_) {
        EXPECT_EQ(m.tracked, m.id <= highest);
        EXPECT_EQ(m.age > 0, m.tracked);
        born += m.tracked ? 0 : 1;
    }
    EXPECT_GT(born, 5);
}

TEST_F(PatchMatcherTest, BoardAndWallKeepTheirOwnDisparityAndMotion) {
    PlaneScene scene;
    scene.board = true;
    OwnerPriors priors = still_priors(true);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    priors[0].T_cur_prev = sideways(3.0, scene.wall_depth_m);
    priors[1].T_cur_prev = sideways(-7.0, scene.board_depth_m);
    ASSERT_EQ(run(PlaneFrame(scene, 3.0, 0, -7.0), scene, priors), Status::kOk);
    const Errors board = errors(1, scene.board_disparity(), -7.0);
    EXPECT_GE(board.stereo, 30);
    EXPECT_GE(board.tracked, 20);
    EXPECT_LE(board.wrong, board.features / 8) << "some patches at the board's edge hold the wall";
    int last = -1;
    for (const FeatureMeasurement& m : *features_) {
        EXPECT_GE(m.owner, last) << "sorted by owner";
        last = m.owner;
    }
}

TEST_F(PatchMatcherTest, DepthRangeOfTheOwnerBoundsItsStereoMatches) {
    const PlaneScene scene;  // at 20 m
    OwnerPriors priors = still_priors(false);
    priors[0].min_depth_m = 30.0;
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    for (const FeatureMeasurement& m : *features_) {
        if (m.stereo) {
            const double d = static_cast<double>(m.u) - static_cast<double>(m.u_right);
            EXPECT_LT(d, PlaneScene::kFocal_px * PlaneScene::kBaseline_m / 30.0 + 2.5);
        }
    }
    EXPECT_LT(errors(0, 0, 0).stereo, 60);
}

TEST_F(PatchMatcherTest, ChangeOfBrightnessBetweenTheCamerasDoesNotMatter) {
    PlaneScene scene;
    scene.gain = 0.85;
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, still_priors(false)), Status::kOk);
    const Errors e = errors(0, scene.wall_disparity(), 0.0);
    EXPECT_GE(e.stereo, 160);
    EXPECT_LT(e.stereo_px, 0.5);
}

TEST_F(PatchMatcherTest, RowOffsetOfTheRightCameraIsMeasured) {
    PlaneScene scene;
    scene.row_offset_px = 0.5;
    const OwnerPriors priors = still_priors(false);
    for (int k = 0; k < 40; ++k) {
        ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    }
    EXPECT_NEAR(matcher_->row_offset_px(), 0.5, 0.15);
    EXPECT_LT(errors(0, scene.wall_disparity(), 0.0).stereo_px, 0.5);
}

TEST_F(PatchMatcherTest, WithoutARightImageFeaturesAreFollowedAndNothingIsStereo) {
    const PlaneScene scene;
    OwnerPriors priors = still_priors(false);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    ASSERT_EQ(run(PlaneFrame(scene, 0.5, 0, 0), scene, priors, false), Status::kOk);
    const Errors e = errors(0, 0, 0.5);
    EXPECT_GT(e.tracked, 150);
    EXPECT_EQ(e.stereo, 0);
}

TEST_F(PatchMatcherTest, BudgetIsKeptAndAnOwnerWithoutPriorIsEmptied) {
    PlaneScene scene;
    scene.board = true;
    OwnerPriors priors = still_priors(true, 50);
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    EXPECT_LE(errors(0, 0, 0).features, 50);
    EXPECT_GT(errors(1, 0, 0).features, 0);
    EXPECT_LE(errors(1, 0, 0).features, 60);
    priors[1].active = false;
    ASSERT_EQ(run(PlaneFrame(scene, 0, 0, 0), scene, priors), Status::kOk);
    EXPECT_EQ(errors(1, 0, 0).features, 0);
}

TEST_F(PatchMatcherTest, RejectedFeatureComesBackOnlyUnderAnotherId) {
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

TEST_F(PatchMatcherTest, FlatImageHasNoFeaturesAndAWrongSizeIsRefused) {
    const PlaneScene scene;
    const OwnerPriors priors = still_priors(false);
    const Calibration calibration = scene.calibration();
    const PlaneFrame frame(scene, 0, 0, 0);
    MatcherInput in = frame.input(calibration, priors, 1);
    const std::vector<std::uint8_t> flat(static_cast<std::size_t>(PlaneScene::kWidth) * PlaneScene::kHeight, 90);
    in.left = in.right = {flat.data(), PlaneScene::kWidth, PlaneScene::kHeight, PlaneScene::kWidth};
    EXPECT_EQ(matcher_->process(in, *features_), Status::kOk);
    EXPECT_TRUE(features_->empty());
    in = frame.input(calibration, priors, 2);
    in.left.width = 100;
    EXPECT_EQ(matcher_->process(in, *features_), Status::kInvalidArgument);
}

}  // namespace
}  // namespace semtrack
