#include "sil/sources.hpp"

#include <gtest/gtest.h>

#include "math/so3.hpp"

namespace semtrack::sil {
namespace {

/// Frames 10..15, 100 ms apart; frame 12 was dropped, frame `broken` cannot be read.
class FakeSequence final : public Sequence {
public:
    explicit FakeSequence(int broken = -1) : broken_(broken) {}
    [[nodiscard]] const DriveCameras& cameras() const override { return cameras_; }
    [[nodiscard]] int first_frame() const override { return 10; }
    [[nodiscard]] int last_frame() const override { return 15; }
    [[nodiscard]] std::int64_t time_us(int frame) const override { return 5000000 + 100000LL * frame; }
    void load(int frame, GreyImage& left, GreyImage& right) override {
        if (frame == broken_) {
            throw InputError("frame.png: broken");
        }
        left = right = GreyImage{};
        if (frame != 12) {
            left = {2, 1, {static_cast<std::uint8_t>(frame), 0}};
            right = {2, 1, {0, static_cast<std::uint8_t>(frame)}};
        }
    }
    [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return frames_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return truth_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override { return lists_; }

    DriveCameras cameras_{};

private:
    int broken_;
    std::vector<Label> labels_;
    std::vector<int> frames_;
    std::map<int, RigidTransform> truth_;
    std::map<int, std::vector<Detection>> lists_;
};

SequenceStereoSource::Settings settings(int first, int last, bool ahead = true) {
    SequenceStereoSource::Settings s;
    s.first = first;
    s.last = last;
    s.ahead = ahead;
    return s;
}

class StereoSources : public testing::TestWithParam<bool> {};

TEST_P(StereoSources, HandsOverEveryFrameOfTheRangeWithItsTimeAndThenEnds) {
    FakeSequence sequence;
    StageTimer timer;
    SequenceStereoSource source(sequence, settings(10, 13, GetParam()), timer);
    StereoFrame frame;
    for (int n = 10; n <= 13; ++n) {
        ASSERT_EQ(source.next(frame), SourceResult::kOk);
        EXPECT_EQ(source.frame(), n);
        EXPECT_EQ(frame.time_us, sequence.time_us(n));
        EXPECT_EQ(frame.left.empty(), n == 12);
        if (n != 12) {
            EXPECT_EQ(frame.left.at(0, 0), n);
            EXPECT_EQ(frame.right.at(1, 0), n);
        }
    }
    EXPECT_EQ(source.next(frame), SourceResult::kEnd);
    EXPECT_EQ(source.next(frame), SourceResult::kEnd);
    EXPECT_EQ(source.frame(), 13);
}

TEST_P(StereoSources, ABrokenImageIsAnErrorOfItsOwnFrameAndIsThrownAgain) {
    FakeSequence sequence(11);
    StageTimer timer;
    SequenceStereoSource source(sequence, settings(10, 15, GetParam()), timer);
    StereoFrame frame;
    EXPECT_EQ(source.next(frame), SourceResult::kOk);
    EXPECT_EQ(source.next(frame), SourceResult::kError);
    EXPECT_EQ(frame.time_us, sequence.time_us(10)) << "the output is untouched";
    EXPECT_THROW(source.rethrow(), InputError);
}

INSTANTIATE_TEST_SUITE_P(AheadAndNot, StereoSources, testing::Bool());

TEST(StereoSource, WithoutImagesEveryViewIsEmpty) {
    FakeSequence sequence(10);
    StageTimer timer;
    SequenceStereoSource::Settings s = settings(10, 10);
    s.images = false;
    SequenceStereoSource source(sequence, s, timer);
    StereoFrame frame;
    EXPECT_EQ(source.next(frame), SourceResult::kOk);
    EXPECT_TRUE(frame.left.empty() && frame.right.empty());
    EXPECT_EQ(source.next(frame), SourceResult::kEnd);
}

TEST(StereoSource, MayBeLeftBeforeItsEnd) {
    FakeSequence sequence;
    StageTimer timer;
    SequenceStereoSource source(sequence, settings(10, 15), timer);
    StereoFrame frame;
    EXPECT_EQ(source.next(frame), SourceResult::kOk);
}

using Lists = StaticVector<DetectionList, kMaxDetectionLists>;

std::map<int, std::vector<Detection>> three_lists() {
    Detection d;
    d.score = 0.5;
    return {{9, {d}}, {10, {d, d}}, {11, {}}, {14, {d}}};
}

TEST(DetectionSource, AFrameWithoutRowsHasNoListAndAnEmptyListIsOne) {
    FakeSequence sequence;
    DelayedDetectionSource source(sequence, three_lists(), 10, 15, 0);
    Lists lists;
    ASSERT_EQ(source.poll(sequence.time_us(10), lists), SourceResult::kOk);
    ASSERT_EQ(lists.size(), 1);
    EXPECT_EQ(lists[0].items.size(), 2);
    lists.clear();
    ASSERT_EQ(source.poll(sequence.time_us(11), lists), SourceResult::kOk);
    EXPECT_EQ(lists[0].items.size(), 0);
    lists.clear();
    EXPECT_EQ(source.poll(sequence.time_us(12), lists), SourceResult::kNone);
    EXPECT_EQ(lists.size(), 0);
}

TEST(DetectionSource, ADelayedListCarriesTheTimeOfItsOwnImage) {
    FakeSequence sequence;
    DelayedDetectionSource source(sequence, three_lists(), 10, 15, 2);
    Lists lists;
    EXPECT_EQ(source.poll(sequence.time_us(11), lists), SourceResult::kNone);
    ASSERT_EQ(source.poll(sequence.time_us(12), lists), SourceResult::kOk);
    EXPECT_EQ(lists[0].time_us, sequence.time_us(10));
    EXPECT_EQ(source.poll(sequence.time_us(15), lists), SourceResult::kOk);
    EXPECT_EQ(lists.size(), 2) << "the list of frame 14 is due after the last frame";
    EXPECT_EQ(source.lists_handed_over(), 2);
}

TEST(DetectionSource, MoreListsThanFitAreHandedOverInTheNextCycle) {
    FakeSequence sequence;
    std::map<int, std::vector<Detection>> by_frame;
    for (int n = 10; n <= 15; ++n) {
        by_frame[n];
    }
    DelayedDetectionSource source(sequence, by_frame, 10, 15, 0);
    Lists lists;
    EXPECT_EQ(source.poll(sequence.time_us(15), lists), SourceResult::kOk);
    EXPECT_EQ(lists.size(), kMaxDetectionLists);
    lists.clear();
    EXPECT_EQ(source.poll(sequence.time_us(15), lists), SourceResult::kOk);
    EXPECT_EQ(lists.size(), 6 - kMaxDetectionLists);
}

TEST(DetectionSource, DetectionsBeyondTheCapacityAreCounted) {
    FakeSequence sequence;
    DelayedDetectionSource source(
        sequence, {{10, std::vector<Detection>(static_cast<std::size_t>(kMaxDetections) + 3U)}}, 10, 15, 0);
    Lists lists;
    ASSERT_EQ(source.poll(sequence.time_us(10), lists), SourceResult::kOk);
    EXPECT_EQ(lists[0].items.size(), kMaxDetections);
    EXPECT_EQ(lists[0].dropped, 3U);
}

TEST(EgoPoseSource, TheFirstProcessedFrameIsTheWorldAndTheMountTurnsTheAxes) {
    FakeSequence sequence;
    std::map<int, RigidTransform> poses;
    for (int n = 10; n <= 15; ++n) {  // camera 0 drives along its z; the file starts somewhere else
        poses[n] =
            to_rigid_transform({so3_exp(Vec3(0.1, 0.2, 0.3)), so3_exp(Vec3(0.1, 0.2, 0.3)) * Vec3(0, 0, 2.0 * n)});
    }
    GivenPoseSource source(sequence, poses, Calibration{}.T_v_c, 11, 15, "poses.txt");
    RigidTransform T;
    ASSERT_EQ(source.poll(sequence.time_us(11), T), SourceResult::kOk);
    EXPECT_LT((to_pose(T).R - Mat3::Identity()).cwiseAbs().maxCoeff() + to_pose(T).t.norm(), 1e-12);
    ASSERT_EQ(source.poll(sequence.time_us(13), T), SourceResult::kOk);
    EXPECT_LT((to_pose(T).t - Vec3(4.0, 0.0, 0.0)).norm(), 1e-12) << "V's x is the camera's z";
    EXPECT_EQ(source.poll(sequence.time_us(10), T), SourceResult::kNone);
}

TEST(EgoPoseSource, ACameraBesideCameraZeroSwingsWhenTheCarTurns) {
    FakeSequence sequence;
    sequence.cameras_.t_c0_c = {0.5, 0.0, 0.0};
    const Mat3 turn = so3_exp(Vec3(0.0, 0.1, 0.0));
    const std::map<int, RigidTransform> poses{{10, RigidTransform{}}, {11, to_rigid_transform({turn, Vec3::Zero()})}};
    GivenPoseSource source(sequence, poses, Calibration{}.T_v_c, 10, 11, "poses.txt");
    RigidTransform T;
    ASSERT_EQ(source.poll(sequence.time_us(11), T), SourceResult::kOk);
    const Vec3 moved_c = turn * Vec3(0.5, 0, 0) - Vec3(0.5, 0, 0);
    EXPECT_LT((to_pose(T).t - Vec3(moved_c(2), -moved_c(0), -moved_c(1))).norm(), 1e-12);
}

TEST(EgoPoseSource, AFrameWithoutPoseIsRefusedByName) {
    FakeSequence sequence;
    const std::map<int, RigidTransform> poses{{10, {}}, {12, {}}};
    try {
        GivenPoseSource source(sequence, poses, Calibration{}.T_v_c, 10, 12, "poses.txt");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "poses.txt: no pose for frame 11");
    }
}

TEST(VehicleMotionRows, HandOverTheNewestRowThatIsNotTooOld) {
    std::map<std::int64_t, VehicleMotion> rows;
    rows[100000].speed = 1.0;
    rows[200000].speed = 2.0;
    VehicleMotionRows source(rows);
    VehicleMotion motion;
    EXPECT_EQ(source.poll(99999, motion), SourceResult::kNone);
    EXPECT_EQ(source.poll(100000, motion), SourceResult::kOk);
    EXPECT_EQ(motion.speed, 1.0);
    EXPECT_EQ(source.poll(199999, motion), SourceResult::kOk);
    EXPECT_EQ(motion.speed, 1.0);
    EXPECT_EQ(source.poll(400000, motion), SourceResult::kOk);
    EXPECT_EQ(motion.speed, 2.0);
    EXPECT_EQ(source.poll(400001, motion), SourceResult::kNone);
    EXPECT_EQ(source.handed_over(), 3);
}

}  // namespace
}  // namespace semtrack::sil
