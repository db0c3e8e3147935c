// One cycle over the interfaces: what it reads, what it sends, what it counts, what it leaves as it was.
#include <gtest/gtest.h>

#include <cfenv>
#include <memory>
#include <vector>

#include "semtrack/cycle.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

class FakeStereo final : public StereoSource {
public:
    [[nodiscard]] SourceResult next(StereoFrame& frame) noexcept override {
        frame.time_us = (time_us += 100000);
        frame.left = left;
        frame.right = right;
        if (broken) {
            frame.time_us = 1;  // not later than the last: the tracker refuses it
        }
        return result;
    }
    SourceResult result{SourceResult::kOk};
    std::int64_t time_us{0};
    bool broken{false};
    ImageView left{};
    ImageView right{};
};

class FakeDetections final : public DetectionSource {
public:
    [[nodiscard]] SourceResult poll(std::int64_t now_us,
                                    StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept override {
        DetectionList list;
        list.time_us = now_us;
        (void)lists.try_push_back(list);
        return result;
    }
    SourceResult result{SourceResult::kOk};
};

class FakeBus final : public CanTx {
public:
    [[nodiscard]] Result begin_list(int count, std::int64_t) noexcept override {
        announced.push_back(count);
        return begins;
    }
    [[nodiscard]] CanState state() const noexcept override { return bus; }
    [[nodiscard]] std::uint32_t lists_lost() const noexcept override { return lost; }
    [[nodiscard]] Result send(const CanFrame& frame, std::int64_t time_us) noexcept override {
        if (static_cast<int>(frames.size()) == room) {
            return Result::kBusy;
        }
        frames.push_back(frame);
        times_us.push_back(time_us);
        return Result::kSent;
    }
    std::vector<CanFrame> frames;
    std::vector<std::int64_t> times_us;
    int room{-1};  // frames until it is busy
    std::vector<int> announced;
    Result begins{Result::kSent};
    CanState bus{CanState::kActive};
    std::uint32_t lost{0};
};

class LateClock final : public Clock {
public:
    [[nodiscard]] std::int64_t now_us() noexcept override { return 250000; }
};

class CycleTest : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(tracker_->init(Config{}, PlaneScene{}.calibration()), Status::kOk);
        ports_.stereo = &stereo_;
        ports_.can = &bus_;
    }
    CycleResult step() { return cycle_->step(*tracker_, *output_); }
    void start(CanDialect dialect = CanDialect::kFd) {
        CanConfig config;
        config.dialect = dialect;
        cycle_->init(ports_, config);
    }

    FakeStereo stereo_;
    FakeDetections detections_;
    FakeBus bus_;
    LateClock clock_;
    CyclePorts ports_{};
    std::unique_ptr<Tracker> tracker_ = std::make_unique<Tracker>();
    std::unique_ptr<Cycle> cycle_ = std::make_unique<Cycle>();
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
};

TEST_F(CycleTest, SendsOneListForEveryFrameAtTheImagesTime) {
    start();
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(cycle_->counters().lists_sent, 2U);
    ASSERT_EQ(bus_.frames.size(), 2U);
    EXPECT_EQ(bus_.frames[0].id, 0x600U);
    EXPECT_EQ(bus_.times_us[1], 200000);
}

TEST_F(CycleTest, ListsReachTheTracker) {
    ports_.detections = &detections_;
    start();
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_FALSE(output_->health.no_detections);
    detections_.result = SourceResult::kNone;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_TRUE(output_->health.no_detections);
}

TEST_F(CycleTest, EndNoFrameAndSourceErrorProcessNothing) {
    ports_.detections = &detections_;
    start();
    stereo_.result = SourceResult::kEnd;
    EXPECT_EQ(step(), CycleResult::kEnd);
    stereo_.result = SourceResult::kNone;
    EXPECT_EQ(step(), CycleResult::kNoFrame);
    stereo_.result = SourceResult::kError;
    EXPECT_EQ(step(), CycleResult::kSourceError);
    stereo_.result = SourceResult::kOk;
    detections_.result = SourceResult::kError;
    EXPECT_EQ(step(), CycleResult::kSourceError);
    EXPECT_TRUE(bus_.frames.empty());
    detections_.result = SourceResult::kOk;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(output_->health.frames, 1U);
}

TEST_F(CycleTest, WithoutAStereoSourceThereIsAnErrorAndNoCrash) {
    ports_.stereo = nullptr;
    start();
    EXPECT_EQ(step(), CycleResult::kSourceError);
}

TEST_F(CycleTest, RefusedInputIsReportedAndNothingIsSent) {
    start();
    EXPECT_EQ(step(), CycleResult::kProcessed);
    stereo_.broken = true;
    EXPECT_EQ(step(), CycleResult::kRefused);
    EXPECT_EQ(bus_.frames.size(), 1U);
}

TEST_F(CycleTest, BusyBusDropsTheRestOfTheListAndCountsItOnce) {
    bus_.room = 2;
    start(CanDialect::kClassic);
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(cycle_->counters().frames_sent, 2U);
    EXPECT_EQ(cycle_->counters().lists_dropped, 1U);
    EXPECT_EQ(cycle_->counters().lists_sent, 0U);
    bus_.room = -1;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(cycle_->counters().lists_sent, 1U);
}

TEST_F(CycleTest, AListThatMayNotBeginSendsNoFrameAndCounts) {
    start(CanDialect::kClassic);
    bus_.begins = CanTx::Result::kBusOff;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_TRUE(bus_.frames.empty());
    EXPECT_EQ(cycle_->counters().lists_dropped, 1U);
    bus_.begins = CanTx::Result::kSent;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(static_cast<int>(bus_.frames.size()), bus_.announced.back()) << "as many frames as were announced";
    EXPECT_EQ(cycle_->counters().lists_sent, 1U);
}

TEST_F(CycleTest, HealthSaysHowTheBusIsAndWhatItLost) {
    start();
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(output_->health.can_state, CanState::kActive);
    EXPECT_EQ(output_->health.can_lists_dropped, 0U);
    bus_.begins = CanTx::Result::kBusOff;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    bus_.bus = CanState::kBusOff;
    bus_.lost = 3;
    EXPECT_EQ(step(), CycleResult::kProcessed);
    EXPECT_EQ(output_->health.can_state, CanState::kBusOff);
    EXPECT_EQ(output_->health.can_lists_dropped, 4U) << "one refused before this one, three lost by the bus";
}

TEST_F(CycleTest, AgeOfTheImageIsTheClocksTimeMinusTheImages) {
    ports_.clock = &clock_;
    start();
    EXPECT_EQ(step(), CycleResult::kProcessed);
    // ImageAge: bits 88..103 of the header, 0.1 ms.
    const int age = bus_.frames[0].data[11] | bus_.frames[0].data[12] << 8;
    EXPECT_EQ(age, 1500);
}

TEST_F(CycleTest, CallersRoundingModeIsNeitherUsedNorChanged) {
    const PlaneScene scene;
    const Calibration calibration = scene.calibration();
    const OwnerPriors none{};
    std::vector<std::unique_ptr<PlaneFrame>> images;
    for (int k = 0; k < 3; ++k) {
        images.push_back(std::make_unique<PlaneFrame>(scene, 8.0 * k, 0.0, 0.0));
    }
    std::array<RigidTransform, 2> poses;
    for (std::size_t run = 0; run < 2; ++run) {
        ASSERT_EQ(tracker_->init(Config{}, calibration), Status::kOk);
        stereo_.time_us = 0;
        start();
        for (const auto& image : images) {
            const MatcherInput in = image->input(calibration, none, 0);
            stereo_.left = in.left;
            stereo_.right = in.right;
            ASSERT_EQ(std::fesetround(run == 0 ? FE_TONEAREST : FE_UPWARD), 0);
            const CycleResult result = step();
            const int mode = std::fegetround();
            ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
            ASSERT_EQ(result, CycleResult::kProcessed);
            EXPECT_EQ(mode, run == 0 ? FE_TONEAREST : FE_UPWARD);
        }
        poses[run] = output_->ego.T_w_v;
    }
    EXPECT_NE(poses[0].t[1], 0.0);
    EXPECT_EQ(poses[0].t, poses[1].t);
    EXPECT_EQ(poses[0].R, poses[1].R);
}

}  // namespace
}  // namespace semtrack
