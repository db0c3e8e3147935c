// Encoder -> receiver: every value comes back within half a bit, or is flagged; never with the other sign.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>

#include "publish/list_decoder.hpp"
#include "publish/object_list.hpp"
#include "semtrack/can_receiver.hpp"
#include "support/object_lists.hpp"

namespace semtrack {
namespace {

using test::kListTime_us;

class CanReceiverTest : public ::testing::TestWithParam<CanDialect> {
protected:
    void SetUp() override { use(CanConfig{GetParam()}); }

    void use(const CanConfig& can) {
        encoder_.init(can);
        CanReceiverConfig config;
        config.can = can;
        ASSERT_EQ(receiver_.init(config), Status::kOk);
    }
    [[nodiscard]] const DialectSpec& dialect() const { return dialect_spec(GetParam()); }

    /// Encodes and hands all frames over; true when the last one, and no other, completed a list.
    bool exchange(std::int64_t age_us = 0) {
        (void)encoder_.encode(*output_, output_->ego.time_us + age_us, *frames_);
        now_us_ += 100000;
        for (int i = 0; i < frames_->size(); ++i) {
            const FrameResult result = receiver_.take((*frames_)[i], now_us_ + i, *list_);
            if (result != (i + 1 < frames_->size() ? FrameResult::kTaken : FrameResult::kListComplete)) {
                return false;
            }
        }
        return true;
    }

    CanEncoder encoder_;
    CanReceiver receiver_;
    std::int64_t now_us_{5000};
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
    std::unique_ptr<CanList> frames_ = std::make_unique<CanList>();
    std::unique_ptr<ReceivedList> list_ = std::make_unique<ReceivedList>();
};

/// What may be on the bus for `sent`: half a bit off, or an end of the range and flagged.
void expect_value(SignalId id, const SignalValue& sent, const Received<double>& got) {
    const SignalSpec& s = signal_spec(id);
    const bool there = sent.available && std::isfinite(sent.value);
    ASSERT_EQ(got.valid, there) << s.name << " " << sent.value;
    if (!there) {
        EXPECT_EQ(got.value, 0.0) << s.name;
        return;
    }
    const double lowest = physical(s, 0);
    const double highest = physical(s, max_raw(s));
    const double half = 0.5 * s.scale * (1.0 + 1e-9) + 1e-12;
    if (sent.value < lowest - half || sent.value > highest + half) {
        EXPECT_TRUE(got.saturated) << s.name << " " << sent.value;
        EXPECT_EQ(got.value, sent.value < lowest ? lowest : highest) << s.name;
    } else {
        EXPECT_LE(std::fabs(got.value - sent.value), half) << s.name << " " << sent.value << " " << got.value;
    }
    EXPECT_FALSE(got.value * sent.value < 0.0 && std::fabs(sent.value) > half) << s.name << ": the other sign";
}

void expect_object(const SignalValues& sent, const ReceivedObject& o) {
    const auto value = [&](SignalId id) { return sent[static_cast<std::size_t>(id)]; };
    EXPECT_EQ(o.id, value(SignalId::kObjectId).value);
    EXPECT_EQ(static_cast<double>(o.object_class.value), value(SignalId::kClass).value);
    EXPECT_EQ(static_cast<double>(o.status.value), value(SignalId::kStatus).value);
    EXPECT_EQ(static_cast<double>(o.movement.value), value(SignalId::kMovement).value);
    EXPECT_TRUE(o.object_class.valid && o.status.valid && o.movement.valid && o.truncated.valid && o.occlusion.valid);
    EXPECT_EQ(o.truncated.value ? 1.0 : 0.0, value(SignalId::kTruncated).value);
    EXPECT_EQ(static_cast<double>(o.occlusion.value), value(SignalId::kOcclusion).value);
    EXPECT_EQ(o.reference_point.value, ReferencePoint::kBoxCentre);
    EXPECT_EQ(o.saturated ? 1.0 : 0.0, value(SignalId::kSaturated).value);
    const std::pair<SignalId, const Received<double>&> reals[] = {{SignalId::kExistence, o.existence},
                                                                  {SignalId::kAge, o.age},
                                                                  {SignalId::kPositionX, o.x},
                                                                  {SignalId::kPositionY, o.y},
                                                                  {SignalId::kPositionZ, o.z},
                                                                  {SignalId::kVelocityX, o.velocity_x},
                                                                  {SignalId::kVelocityY, o.velocity_y},
                                                                  {SignalId::kYaw, o.yaw},
                                                                  {SignalId::kYawRate, o.yaw_rate},
                                                                  {SignalId::kLength, o.length},
                                                                  {SignalId::kWidth, o.width},
                                                                  {SignalId::kHeight, o.height},
                                                                  {SignalId::kSigmaX, o.sigma_x},
                                                                  {SignalId::kSigmaY, o.sigma_y},
                                                                  {SignalId::kSigmaZ, o.sigma_z},
                                                                  {SignalId::kSigmaVelocityX, o.sigma_velocity_x},
                                                                  {SignalId::kSigmaVelocityY, o.sigma_velocity_y},
                                                                  {SignalId::kSigmaYaw, o.sigma_yaw}};
    for (const auto& [id, got] : reals) {
        expect_value(id, value(id), got);
    }
}

TEST_P(CanReceiverTest, RandomListsOfEverySizeComeBackWithinHalfABitOrFlagged) {
    Rng rng(11);
    int objects_seen = 0;
    for (const int objects : {0, 1, 2, 15, 16, 31, 32, 33, 80}) {
        for (int trial = 0; trial < 40; ++trial) {
            test::random_output(rng, objects, *output_);
            ASSERT_TRUE(exchange(static_cast<std::int64_t>(rng.next() % 8000000U)));
            ObjectOrder order;
            const int dropped = choose_objects(*output_, dialect().max_objects, order);
            ASSERT_EQ(list_->objects.size(), order.size());
            SignalValues sent;
            header_values(*output_, {encoder_.list_counter(), order.size(), dropped, output_->ego.time_us}, sent);
            const auto value = [&](SignalId id) { return sent[static_cast<std::size_t>(id)]; };
            EXPECT_EQ(list_->list_counter, encoder_.list_counter());
            expect_value(SignalId::kObjectsDropped, value(SignalId::kObjectsDropped), list_->objects_dropped);
            expect_value(SignalId::kEgoSpeed, value(SignalId::kEgoSpeed), list_->ego_speed);
            expect_value(SignalId::kEgoYawRate, value(SignalId::kEgoYawRate), list_->ego_yaw_rate);
            expect_value(SignalId::kSigmaEgoSpeed, value(SignalId::kSigmaEgoSpeed), list_->sigma_ego_speed);
            expect_value(SignalId::kSigmaEgoYawRate, value(SignalId::kSigmaEgoYawRate), list_->sigma_ego_yaw_rate);
            EXPECT_EQ(list_->ego_status.value, output_->ego.status);
            EXPECT_EQ(list_->ego_degraded.value, output_->health.ego_degraded);
            EXPECT_EQ(list_->no_right_image.value, output_->health.no_right_image);
            EXPECT_EQ(list_->no_detections.value, output_->health.no_detections);
            EXPECT_EQ(list_->road_not_plane.value, output_->health.road_not_plane);
            EXPECT_EQ(list_->frames_dropped, output_->health.frames_dropped % 65536U);
            for (int k = 0; k < order.size(); ++k) {
                object_values(output_->objects[order[k]], encoder_.list_counter(), sent);
                expect_object(sent, list_->objects[k]);
                ++objects_seen;
            }
            if (HasFailure()) {
                return;
            }
        }
    }
    EXPECT_GT(objects_seen, 3000);
    EXPECT_EQ(receiver_.counters().lists_complete, 9U * 40U);
    EXPECT_EQ(receiver_.counters().lists_broken, 0U);
}

TEST_P(CanReceiverTest, FullTableDropsTheFarthestAndSaysHowMany) {
    for (int k = 0; k < kMaxObjects; ++k) {
        ASSERT_TRUE(
            output_->objects.try_push_back(test::plain_object(static_cast<std::uint32_t>(k + 1), 5.0 + k, 0.0)));
    }
    output_->health.objects_untracked = 48;  // 80 in sight
    ASSERT_TRUE(exchange());
    EXPECT_EQ(list_->objects.size(), dialect().max_objects);
    EXPECT_NEAR(list_->objects[dialect().max_objects - 1].x.value, 4.0 + dialect().max_objects, 1e-9);
    const bool fits = dialect().fd;  // 16 + 48 in the classic dialect is more than the field holds
    EXPECT_EQ(list_->objects_dropped.value, fits ? 48.0 : 62.0);
    EXPECT_EQ(list_->objects_dropped.saturated, !fits);
    EXPECT_EQ(list_->saturated, !fits);
}

TEST_P(CanReceiverTest, EgoAndObjectsFarTooFastAreFlaggedWithTheirSign) {
    test::set_ego(*output_, kListTime_us, 300.0, -9.0);
    TrackedObject o = test::plain_object(1, 20.0, -120.0);
    o.velocity_v = {300.0, -300.0};
    ASSERT_TRUE(output_->objects.try_push_back(o));
    o = test::plain_object(2, 250.0, 120.0);
    ASSERT_TRUE(output_->objects.try_push_back(o));
    ASSERT_TRUE(exchange());
    EXPECT_TRUE(list_->saturated && list_->ego_speed.saturated && list_->ego_yaw_rate.saturated);
    EXPECT_NEAR(list_->ego_speed.value, 83.82, 1e-9);
    EXPECT_NEAR(list_->ego_yaw_rate.value, -2.0, 1e-9);
    const ReceivedObject& fast = list_->objects[0];
    EXPECT_TRUE(fast.saturated && fast.velocity_x.saturated && fast.velocity_y.saturated);
    EXPECT_FALSE(fast.x.saturated || fast.y.saturated);
    EXPECT_GT(fast.velocity_x.value, 80.0);
    EXPECT_LT(fast.velocity_y.value, -79.9);
    const ReceivedObject& far = list_->objects[1];
    EXPECT_FALSE(far.saturated);
    EXPECT_NEAR(far.x.value, 250.0, 0.005);
    EXPECT_NEAR(far.y.value, 120.0, 0.005);
}

TEST_P(CanReceiverTest, BaseIdAndLongIdsWorkAndOtherIdsAreIgnored) {
    CanConfig can{GetParam()};
    for (const auto& [base, extended] : {std::pair{0x123U, false}, std::pair{0x18FF0000U, true}}) {
        can.base_id = base;
        can.extended = extended;
        use(can);
        test::golden_output(*output_);
        ASSERT_TRUE(exchange());
        EXPECT_EQ(list_->objects.size(), 3);
        for (CanFrame f : *frames_) {
            f.extended = !f.extended;
            EXPECT_EQ(receiver_.take(f, now_us_, *list_), FrameResult::kIgnored);
        }
        CanFrame motion = (*frames_)[0];
        motion.id = base + dialect().messages;
        EXPECT_EQ(receiver_.take(motion, now_us_, *list_), FrameResult::kIgnored) << "VehicleMotion is not of the list";
        motion.id = base - 1U;
        EXPECT_EQ(receiver_.take(motion, now_us_, *list_), FrameResult::kIgnored);
        ASSERT_TRUE(exchange()) << "ignored frames change nothing";
    }
    CanReceiverConfig config;
    config.can = CanConfig{GetParam(), 0x7FF, false};
    EXPECT_EQ(receiver_.init(config), Status::kInvalidArgument);
    config.can.base_id = 0x600;
    config.timeout_us = 0;
    EXPECT_EQ(receiver_.init(config), Status::kInvalidArgument);
    EXPECT_EQ(receiver_.take((*frames_)[0], now_us_, *list_), FrameResult::kIgnored);
}

TEST_P(CanReceiverTest, GoldenFramesAreReproducedAndDecoded) {
    test::golden_output(*output_);
    ASSERT_TRUE(exchange(35000));
    std::ifstream file(std::string(SEMTRACK_GOLDEN_FRAMES) + (dialect().fd ? "/fd.log" : "/classic.log"));
    std::string stamp;
    std::string interface;
    std::string text;
    int rows = 0;
    for (; file >> stamp >> interface >> text; ++rows) {
        ASSERT_LT(rows, frames_->size());
        EXPECT_EQ(test::frame_text((*frames_)[rows]), text);
    }
    EXPECT_EQ(rows, frames_->size());
    EXPECT_EQ(list_->image_time_us, kListTime_us % (std::int64_t{1} << 40));
    EXPECT_EQ(list_->age_us.value, 35000);
    ASSERT_EQ(list_->objects.size(), 3);
    const ReceivedObject& car = list_->objects[0];
    EXPECT_EQ(car.id, 7);
    EXPECT_NEAR(car.x.value, 12.5, 1e-9);
    EXPECT_NEAR(car.y.value, 1.25, 1e-9);
    EXPECT_NEAR(car.velocity_x.value, 7.3, 1e-9);
    EXPECT_EQ(car.movement.value, MovementState::kMoving);
    const ReceivedObject& person = list_->objects[1];
    EXPECT_EQ(person.id, 4096 % 4095);
    EXPECT_EQ(person.object_class.value, ObjectClass::kPedestrian);
    EXPECT_EQ(person.status.value, TrackStatus::kCoasted);
    EXPECT_FALSE(person.yaw.valid);
    EXPECT_TRUE(person.truncated.value);
    const ReceivedObject& van = list_->objects[2];
    EXPECT_EQ(van.movement.value, MovementState::kOncoming);
    EXPECT_NEAR(van.yaw.value, 3.1, 0.0004);
    EXPECT_EQ(van.occlusion.value, 1);
}

INSTANTIATE_TEST_SUITE_P(Dialects, CanReceiverTest, ::testing::Values(CanDialect::kFd, CanDialect::kClassic),
                         [](const auto& dialect) { return dialect.param == CanDialect::kFd ? "Fd" : "Classic"; });

}  // namespace
}  // namespace semtrack
