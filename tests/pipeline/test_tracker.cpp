// The tracker as its caller sees it: what it refuses, what it survives, what it says.
#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>

#include "semtrack/tracker.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

constexpr std::int64_t kFrame_us = 100000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A camera that moves to the left past a wall, so that the wall's image moves to the right by 8 px a frame.
constexpr double kFlow_px = 8.0;

class TrackerTest : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(tracker_->init(Config{}, scene_.calibration()), Status::kOk);
        for (int k = 0; k < 4; ++k) {
            frames_.push_back(std::make_unique<PlaneFrame>(scene_, kFlow_px * k, 0.0, 0.0));
        }
    }
    [[nodiscard]] Input input(int frame) const {
        static const OwnerPriors kNone{};
        const MatcherInput m = frames_[static_cast<std::size_t>(frame)]->input(calibration_, kNone, 0);
        Input in;
        in.time_us = kFrame_us * (frame + 1);
        in.left = m.left;
        in.right = m.right;
        return in;
    }
    Status run(const Input& in) { return tracker_->process(in, *output_); }
    void run_frames(int from, int to) {
        for (int k = from; k <= to; ++k) {
            ASSERT_EQ(run(input(k)), Status::kOk);
        }
    }
    [[nodiscard]] double sideways_m() const { return output_->ego.T_w_v.t[1]; }  // V's y is to the left
    [[nodiscard]] double step_m() const { return kFlow_px * scene_.wall_depth_m / PlaneScene::kFocal_px; }

    PlaneScene scene_{};
    Calibration calibration_ = scene_.calibration();
    std::vector<std::unique_ptr<PlaneFrame>> frames_;
    std::unique_ptr<Tracker> tracker_ = std::make_unique<Tracker>();
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
};

TEST_F(TrackerTest, EgoMotionPastAWallIsMeasured) {
    run_frames(0, 3);
    EXPECT_EQ(output_->ego.status, EgoStatus::kTracked);
    EXPECT_NEAR(sideways_m(), 3.0 * step_m(), 0.02);
    EXPECT_NEAR(output_->ego.T_w_v.t[0], 0.0, 0.05);
    EXPECT_GT(output_->ego.inliers, 100);
    EXPECT_GT(output_->points.size(), 200);
}

TEST_F(TrackerTest, FirstFrameIsTheOriginAndSaysSo) {
    run_frames(0, 0);
    EXPECT_EQ(output_->ego.status, EgoStatus::kStart);
    EXPECT_EQ(sideways_m(), 0.0);
    EXPECT_EQ(output_->health.frames, 1U);
    EXPECT_TRUE(output_->health.no_detections);
}

TEST_F(TrackerTest, ImpossibleCalibrationIsRefused) {
    const auto refused = [this](auto change) {
        Calibration c = scene_.calibration();
        change(c);
        return tracker_->init(Config{}, c) == Status::kInvalidArgument;
    };
    EXPECT_TRUE(refused([](Calibration& c) { c.baseline_m = 0.0; }));
    EXPECT_TRUE(refused([](Calibration& c) { c.left.fx = -1.0; }));
    EXPECT_TRUE(refused([](Calibration& c) { c.right.cx = kNan; }));
    EXPECT_TRUE(refused([](Calibration& c) { c.width = kMaxImageWidth + 1; }));
    EXPECT_TRUE(refused([](Calibration& c) { c.T_v_c.R[0] = 5.0; }));
    EXPECT_FALSE(refused([](Calibration&) {}));
}

TEST_F(TrackerTest, NothingIsProcessedBeforeInit) {
    Tracker& fresh = *(tracker_ = std::make_unique<Tracker>());
    EXPECT_EQ(fresh.process(input(0), *output_), Status::kInvalidArgument);
}

TEST_F(TrackerTest, RefusedInputLeavesOutputAndStateUntouched) {
    run_frames(0, 1);
    const double before = sideways_m();
    Input backwards = input(2);
    backwards.time_us = kFrame_us * 2;
    EXPECT_EQ(run(backwards), Status::kInvalidArgument);
    Input small = input(2);
    small.left.width = 100;
    EXPECT_EQ(run(small), Status::kInvalidArgument);
    Input torn = input(2);
    torn.right.stride = 10;
    EXPECT_EQ(run(torn), Status::kInvalidArgument);
    VehicleMotion motion;
    motion.speed = kNan;
    Input wild = input(2);
    wild.motion = &motion;
    EXPECT_EQ(run(wild), Status::kInvalidArgument);
    RigidTransform pose;
    pose.t[1] = kNan;
    Input lost = input(2);
    lost.T_w_v = &pose;
    EXPECT_EQ(run(lost), Status::kInvalidArgument);
    EXPECT_EQ(sideways_m(), before);
    EXPECT_EQ(output_->health.frames, 2U);
    run_frames(2, 3);
    EXPECT_NEAR(sideways_m(), 3.0 * step_m(), 0.02);
}

TEST_F(TrackerTest, DroppedFrameIsPredictedAndCountedAndTheNextOneIsTracked) {
    run_frames(0, 1);
    Input dropped = input(2);
    dropped.left = dropped.right = ImageView{};
    ASSERT_EQ(run(dropped), Status::kOk);
    EXPECT_EQ(output_->ego.status, EgoStatus::kPredicted);
    EXPECT_TRUE(output_->health.ego_degraded);
    EXPECT_EQ(output_->health.frames_dropped, 1U);
    EXPECT_NEAR(sideways_m(), 2.0 * step_m(), 0.05) << "the motion goes on";
    run_frames(3, 3);
    EXPECT_EQ(output_->ego.status, EgoStatus::kTracked);
    EXPECT_NEAR(sideways_m(), 3.0 * step_m(), 0.03);
}

TEST_F(TrackerTest, MissingRightImageIsSurvivedAndCounted) {
    run_frames(0, 1);
    Input in = input(2);
    in.right = ImageView{};
    ASSERT_EQ(run(in), Status::kOk);
    EXPECT_TRUE(output_->health.no_right_image);
    EXPECT_EQ(output_->health.frames_without_right, 1U);
    EXPECT_NEAR(sideways_m(), 2.0 * step_m(), 0.05);
}

TEST_F(TrackerTest, FirstFramesWithoutImagesDoNotHurt) {
    Input blind;
    for (int k = 0; k < 3; ++k) {
        blind.time_us = 1000 * (k + 1);
        ASSERT_EQ(run(blind), Status::kOk);
    }
    run_frames(0, 3);
    EXPECT_NEAR(sideways_m(), 3.0 * step_m(), 0.02);
}

TEST_F(TrackerTest, ImpossibleDetectionsAreDroppedAndCountedAndNothingBecomesNan) {
    StaticVector<DetectionList, kMaxDetectionLists> lists;
    DetectionList list;
    list.time_us = kFrame_us;
    const auto add = [&list](double left, double top, double right, double bottom) {
        Detection d;
        d.box = {left, top, right, bottom};
        d.score = 0.9;
        ASSERT_TRUE(list.items.try_push_back(d));
    };
    add(kNan, 10, 50, 60);
    add(60, 10, 50, 60);      // inverted
    add(-200, 10, -100, 60);  // outside
    add(10, 10, 10, 10);      // no extent
    add(1e300, 10, 2e300, 60);
    ASSERT_TRUE(lists.try_push_back(list));
    Input in = input(0);
    in.detections = &lists;
    ASSERT_EQ(run(in), Status::kOk);
    EXPECT_EQ(output_->health.detections_dropped, 5U);
    EXPECT_TRUE(output_->objects.empty());
    run_frames(1, 2);
    EXPECT_TRUE(std::isfinite(sideways_m()));
}

TEST_F(TrackerTest, ListOfNoKnownFrameIsCountedAsTooLate) {
    run_frames(0, 2);
    StaticVector<DetectionList, kMaxDetectionLists> lists;
    DetectionList list;
    list.time_us = kFrame_us * 3 - 40000;  // between two images
    ASSERT_TRUE(lists.try_push_back(list));
    Input in = input(3);
    in.detections = &lists;
    ASSERT_EQ(run(in), Status::kOk);
    EXPECT_EQ(output_->health.lists_too_late, 1U);
}

TEST_F(TrackerTest, GivenPoseIsTakenAsItIs) {
    RigidTransform pose;
    pose.t = {3.0, -1.0, 0.5};
    Input in = input(0);
    in.T_w_v = &pose;
    ASSERT_EQ(run(in), Status::kOk);
    pose.t = {4.0, -1.0, 0.5};
    in = input(1);
    in.T_w_v = &pose;
    ASSERT_EQ(run(in), Status::kOk);
    EXPECT_EQ(output_->ego.status, EgoStatus::kGiven);
    EXPECT_NEAR(output_->ego.T_w_v.t[0], 4.0, 1e-12);
    EXPECT_NEAR(output_->ego.speed, 10.0, 1e-6);
}

TEST_F(TrackerTest, SameInputGivesTheSameBytesAfterASecondInit) {
    run_frames(0, 3);
    const EgoState first = output_->ego;
    ASSERT_EQ(tracker_->init(Config{}, scene_.calibration()), Status::kOk);
    run_frames(0, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(output_->ego.T_w_v.t[i], first.T_w_v.t[i]);
    }
    EXPECT_EQ(output_->ego.inliers, first.inliers);
}

TEST_F(TrackerTest, TheCallersRoundingChangesNothingAndIsGivenBack) {
    run_frames(0, 2);
    const std::array<double, 3> wanted = output_->ego.T_w_v.t;
    const int before = std::fegetround();
    ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
    const Status again = tracker_->init(Config{}, scene_.calibration());
    for (int k = 0; k <= 2; ++k) {
        EXPECT_EQ(run(input(k)), Status::kOk);
    }
    const int after = std::fegetround();
    ASSERT_EQ(std::fesetround(before), 0);
    EXPECT_EQ(again, Status::kOk);
    EXPECT_EQ(after, FE_UPWARD);
    EXPECT_EQ(output_->ego.T_w_v.t, wanted);
}

}  // namespace
}  // namespace semtrack
