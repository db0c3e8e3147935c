// Time at the receiver: the image's stamp over its wrap, its age, silence, and a list brought to another time.
#include <cmath>

#include "math/trig.hpp"
#include "support/receiver_rig.hpp"

namespace semtrack {
namespace {

using test::Frames;

constexpr std::int64_t kWrap_us = std::int64_t{1} << 40;
constexpr std::int64_t kDay_us = 86400000000;

class ReceiverTime : public test::ReceiverRig {
protected:
    /// One list, image at image_us, sent age_us later, its first frame received at own_us.
    bool list_at(std::int64_t image_us, std::int64_t own_us, std::int64_t age_us = 20000) {
        output_->ego.time_us = image_us;
        (void)encoder_.encode(*output_, image_us + age_us, *frames_);
        bool whole = false;
        for (int i = 0; i < frames_->size(); ++i) {
            whole = receiver_.take((*frames_)[i], own_us + 250 * i, *list_) == FrameResult::kListComplete;
        }
        return whole;
    }
};

TEST_P(ReceiverTime, ImageTimeIsUnwrappedOverItsWrapAndOverLongSilence) {
    std::int64_t image_us = kWrap_us - 150000;
    std::int64_t own_us = -40000;  // any clock
    for (const std::int64_t step_us : {std::int64_t{0}, std::int64_t{100000}, std::int64_t{100000}, kDay_us,
                                       30 * kDay_us, kWrap_us, 5 * kWrap_us + 1, std::int64_t{1}}) {
        image_us += step_us;
        own_us += step_us;
        ASSERT_TRUE(list_at(image_us, own_us)) << step_us;
        EXPECT_EQ(list_->image_time_us, image_us) << step_us;
        EXPECT_EQ(list_->received_us, own_us);
        ASSERT_TRUE(list_->taken_us.valid);
        EXPECT_EQ(list_->taken_us.value, own_us - 20000);
        EXPECT_EQ(list_->age_us.value, 20000);
    }
}

TEST_P(ReceiverTime, ClocksMayRunApartByADay) {
    ASSERT_TRUE(list_at(1000, 0));
    ASSERT_TRUE(list_at(1000 + kDay_us, 2 * kDay_us));
    EXPECT_EQ(list_->image_time_us, 1000 + kDay_us);
    ASSERT_TRUE(list_at(1000, 2 * kDay_us + 100000)) << "a sender whose clock was set back";
    EXPECT_EQ(list_->image_time_us, 1000);
}

TEST_P(ReceiverTime, ReferenceGivesTheFirstListItsFullTime) {
    config_.reference_time_us = test::kListTime_us - 12 * kDay_us;
    ASSERT_EQ(receiver_.init(config_), Status::kOk);
    ASSERT_TRUE(list_at(test::kListTime_us, 5));
    EXPECT_EQ(list_->image_time_us, test::kListTime_us);
}

TEST_P(ReceiverTime, AgeThatIsTooHighOrNegativeSaysNothingAboutTheOwnTime) {
    for (const std::int64_t age_us : {std::int64_t{7000000}, std::int64_t{-300}}) {
        ASSERT_TRUE(list_at(5000000, 100, age_us));
        EXPECT_TRUE(list_->age_us.saturated);
        EXPECT_TRUE(list_->saturated);
        EXPECT_FALSE(list_->taken_us.valid);
        EXPECT_EQ(list_->age_us.value, age_us > 0 ? 6553400 : 0);
    }
    ASSERT_TRUE(list_at(6000000, 200, 6553400));
    EXPECT_FALSE(list_->age_us.saturated);
    EXPECT_TRUE(list_->taken_us.valid);
}

TEST_P(ReceiverTime, ListIsOutOfDateAfterTheTimeOutAndTheSenderMayStartAgain) {
    EXPECT_TRUE(receiver_.timed_out(0)) << "no list yet";
    ASSERT_EQ(receive(next_list()).size(), 1U);
    const std::int64_t received_us = list_->received_us;
    EXPECT_FALSE(receiver_.timed_out(received_us + config_.timeout_us));
    EXPECT_TRUE(receiver_.timed_out(received_us + config_.timeout_us + 1));
    encoder_.init(config_.can);  // counters from 0
    (void)next_list();
    (void)next_list();
    now_us_ += config_.timeout_us + 100000;
    EXPECT_EQ(receive(next_list()).size(), 1U) << "after silence any counter may come";
    EXPECT_EQ(counters().timeouts, 1U);
    EXPECT_EQ(counters().lists_missed, 0U);
    EXPECT_FALSE(receiver_.timed_out(now_us_));
}

TEST_P(ReceiverTime, SilenceWithinAListBreaksIt) {
    Frames list = next_list();
    ASSERT_EQ(take(list[0]), FrameResult::kTaken);
    now_us_ += config_.timeout_us + 1;
    list.erase(list.begin());
    EXPECT_TRUE(receive(list).empty());
    EXPECT_EQ(counters().lists_broken, 1U);
    EXPECT_EQ(counters().timeouts, 1U);
    EXPECT_EQ(receive(next_list()).size(), 1U);
}

TEST_P(ReceiverTime, PollTellsWhatBecameOfTheLists) {
    EXPECT_EQ(receiver_.poll(), E2eState::kNoNewData);
    (void)receive(next_list());
    EXPECT_EQ(receiver_.poll(), E2eState::kOk);
    EXPECT_EQ(receiver_.poll(), E2eState::kNoNewData);
    (void)next_list();
    (void)receive(next_list());
    EXPECT_EQ(receiver_.poll(), E2eState::kOkSomeLost);
    Frames list = next_list();
    list.pop_back();
    (void)receive(list);
    EXPECT_EQ(receiver_.poll(), E2eState::kNoNewData) << "begun, not broken yet";
    (void)receive(next_list());
    EXPECT_EQ(receiver_.poll(), E2eState::kOkSomeLost);
    list = next_list();
    list[0].data[5] = static_cast<std::uint8_t>(list[0].data[5] ^ 1U);
    EXPECT_EQ(take(list[0]), FrameResult::kRefused);
    EXPECT_EQ(receiver_.poll(), E2eState::kError);
    list = next_list();
    (void)receive(list);
    EXPECT_EQ(receiver_.poll(), E2eState::kOkSomeLost);
    EXPECT_EQ(take(list.front()), FrameResult::kRefused);
    EXPECT_EQ(receiver_.poll(), E2eState::kRepeated);
}

/// A point that stands in the world stays there: the vehicle turns and drives, the list moves the other way.
TEST_P(ReceiverTime, BroughtToTimeStandingObjectsStandAndMovingOnesMove) {
    const double speed = 12.0;
    const double rate = 0.4;
    test::set_ego(*output_, 5000000, speed, rate);
    output_->objects.clear();
    TrackedObject standing = test::plain_object(1, 10.0, 3.0);
    standing.velocity_v = {0.0, 0.0};
    standing.yaw_rate = 0.0;
    standing.yaw_v = -3.1;
    TrackedObject moving = test::plain_object(2, 30.0, -3.0);
    moving.velocity_v = {6.0, 2.0};
    moving.yaw_rate = 0.25;
    ASSERT_TRUE(output_->objects.try_push_back(standing));
    ASSERT_TRUE(output_->objects.try_push_back(moving));
    ASSERT_TRUE(list_at(5000000, 1000000, 20000));
    const ReceivedList before = *list_;
    for (const std::int64_t step_us :
         {std::int64_t{0}, std::int64_t{50000}, std::int64_t{1000000}, std::int64_t{-200000}}) {
        *list_ = before;
        ASSERT_EQ(bring_to_time(before.taken_us.value + step_us, *list_), Status::kOk);
        const double dt = 1e-6 * static_cast<double>(step_us);
        const double w = list_->ego_yaw_rate.value;
        const double radius = list_->ego_speed.value / w;
        const double ego_x = radius * std::sin(w * dt);
        const double ego_y = radius * (1.0 - std::cos(w * dt));
        for (int k = 0; k < 2; ++k) {
            const ReceivedObject& o = list_->objects[k];
            const ReceivedObject& was = before.objects[k];
            const double x = ego_x + o.x.value * std::cos(w * dt) - o.y.value * std::sin(w * dt);  // in the old V
            const double y = ego_y + o.x.value * std::sin(w * dt) + o.y.value * std::cos(w * dt);
            EXPECT_NEAR(x, was.x.value + was.velocity_x.value * dt, 1e-9) << step_us;
            EXPECT_NEAR(y, was.y.value + was.velocity_y.value * dt, 1e-9) << step_us;
            const double turned = was.yaw.value + (was.yaw_rate.value - w) * dt;
            EXPECT_NEAR(wrap_angle(o.yaw.value - turned), 0.0, 1e-9);
            EXPECT_LE(std::fabs(o.yaw.value), kPi);
            EXPECT_NEAR(std::hypot(o.velocity_x.value, o.velocity_y.value),
                        std::hypot(was.velocity_x.value, was.velocity_y.value), 1e-9);
        }
        EXPECT_EQ(list_->image_time_us, before.image_time_us + step_us);
        EXPECT_EQ(list_->taken_us.value, before.taken_us.value + step_us);
    }
}

TEST_P(ReceiverTime, ListIsNotBroughtFarNorWithoutEgoMotion) {
    ASSERT_TRUE(list_at(5000000, 1000000));
    const std::int64_t taken_us = list_->taken_us.value;
    const double x = list_->objects[0].x.value;
    EXPECT_EQ(bring_to_time(taken_us + 1000001, *list_), Status::kInvalidArgument);
    EXPECT_EQ(bring_to_time(taken_us - 1000001, *list_), Status::kInvalidArgument);
    EXPECT_EQ(bring_to_time(INT64_MIN, *list_), Status::kInvalidArgument);
    list_->ego_speed.saturated = true;
    EXPECT_EQ(bring_to_time(taken_us, *list_), Status::kInvalidArgument);
    list_->ego_speed = {};
    EXPECT_EQ(bring_to_time(taken_us, *list_), Status::kInvalidArgument);
    EXPECT_EQ(list_->objects[0].x.value, x);
}

INSTANTIATE_TEST_SUITE_P(Dialects, ReceiverTime, ::testing::Values(CanDialect::kFd, CanDialect::kClassic),
                         test::dialect_name);

}  // namespace
}  // namespace semtrack
