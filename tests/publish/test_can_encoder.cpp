// The encoder: whole lists, their order, counters and protection; every value comes back within half a bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "math/rng.hpp"
#include "publish/e2e.hpp"
#include "publish/object_list.hpp"
#include "semtrack/can_encoder.hpp"
#include "support/object_lists.hpp"

namespace semtrack {
namespace {

constexpr std::int64_t kImageTime_us = 1317039265123456;

class CanEncoderTest : public ::testing::TestWithParam<CanDialect> {
protected:
    void SetUp() override {
        CanConfig config;
        config.dialect = GetParam();
        encoder_.init(config);
        output_->ego.time_us = kImageTime_us;
        output_->ego.status = EgoStatus::kTracked;
        output_->ego.speed = 8.4;
        output_->ego.yaw_rate = -0.12;
        output_->ego.sigma_speed = 0.11;
        output_->ego.sigma_yaw_rate = 0.004;
    }

    [[nodiscard]] const DialectSpec& dialect() const { return dialect_spec(GetParam()); }

    TrackedObject object(std::uint32_t id, double x, double y) { return test::plain_object(id, x, y); }
    void add(const TrackedObject& o) { ASSERT_TRUE(output_->objects.try_push_back(o)); }

    Status encode(std::int64_t age_us = 0) { return encoder_.encode(*output_, kImageTime_us + age_us, *frames_); }

    /// Raw value of a signal in the list; object -1: of the header. all_ones(63) when it was not found.
    [[nodiscard]] std::uint64_t raw(SignalId id, int object = -1) const {
        const DialectSpec& d = dialect();
        for (const CanFrame& f : *frames_) {
            const MessageSpec& m = d.message[f.id - 0x600U];
            int bit = first_signal_bit(d, m);
            const int first = static_cast<int>(get_bits(f.data, record_index_bit(d), kRecordIndexBits)) * m.records;
            for (int r = 0; r < (m.records > 0 ? m.records : 1); ++r) {
                for (int i = 0; i < m.signals; ++i) {
                    const SignalId here = m.signal[static_cast<std::size_t>(i)];
                    if (here == id && (m.records == 0 ? -1 : first + r) == object) {
                        return get_bits(f.data, bit, signal_spec(here).length);
                    }
                    bit += signal_spec(here).length;
                }
            }
        }
        return all_ones(63);
    }
    [[nodiscard]] double value(SignalId id, int object = -1) const {
        return physical(signal_spec(id), raw(id, object));
    }

    CanEncoder encoder_;
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
    std::unique_ptr<CanList> frames_ = std::make_unique<CanList>();
};

TEST_P(CanEncoderTest, EmptyListIsTheHeaderAlone) {
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(frames_->size(), dialect().header_messages);
    EXPECT_EQ(raw(SignalId::kObjectCount), 0U);
}

TEST_P(CanEncoderTest, HeaderSaysTimeAgeAndEgoMotion) {
    EXPECT_EQ(encode(35000), Status::kOk);
    EXPECT_EQ(raw(SignalId::kImageTime), static_cast<std::uint64_t>(kImageTime_us) & all_ones(40));
    EXPECT_NEAR(value(SignalId::kImageAge), 35.0, 0.05);
    EXPECT_NEAR(value(SignalId::kEgoSpeed), 8.4, 0.005);
    EXPECT_NEAR(value(SignalId::kEgoYawRate), -0.12, 0.00025);
    EXPECT_NEAR(value(SignalId::kSigmaEgoSpeed), 0.11, 0.005);
    EXPECT_EQ(raw(SignalId::kEgoStatus), 1U);
    EXPECT_EQ(raw(SignalId::kHeaderSaturated), 0U);
}

TEST_P(CanEncoderTest, HeaderSaysThatTheRoadIsNoPlane) {
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kRoadNotPlane), 0U);
    output_->health.road_not_plane = true;
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kRoadNotPlane), 1U);
}

TEST_P(CanEncoderTest, EveryValueOfAnObjectComesBackWithinHalfABit) {
    Rng rng(7);
    for (std::uint32_t k = 0; k < 9; ++k) {
        TrackedObject o = object(k + 1, 10.0 + 15.0 * k, rng.uniform() * 40.0 - 20.0);
        o.velocity_v = {rng.uniform() * 140.0 - 70.0, rng.uniform() * 20.0 - 10.0};
        o.yaw_v = rng.uniform() * 6.28 - 3.14;
        add(o);
    }
    EXPECT_EQ(encode(), Status::kOk);
    ObjectOrder order;
    EXPECT_EQ(choose_objects(*output_, dialect().max_objects, order), 0);
    for (int k = 0; k < order.size(); ++k) {
        SignalValues expected;
        object_values(output_->objects[order[k]], encoder_.list_counter(), expected);
        for (int i = kFirstObjectSignal; i < kListSignals; ++i) {
            const auto id = static_cast<SignalId>(i);
            const SignalValue& v = expected[static_cast<std::size_t>(i)];
            ASSERT_TRUE(v.available) << signal_spec(id).name;
            EXPECT_NEAR(value(id, k), v.value, 0.5001 * signal_spec(id).scale) << signal_spec(id).name << " " << k;
        }
    }
}

TEST_P(CanEncoderTest, EveryFrameHasItsLengthCountersAndAValidCrc) {
    for (std::uint32_t k = 0; k < 5; ++k) {
        add(object(k + 1, 10.0 * (k + 1), 0.0));
    }
    std::array<int, 16> next{};
    for (int list = 0; list < 300; ++list) {
        EXPECT_EQ(encode(), Status::kOk);
        for (const CanFrame& f : *frames_) {
            const std::uint32_t m = f.id - 0x600U;
            const auto data_id = static_cast<std::uint16_t>(kE2eFirstDataId + m);
            ASSERT_EQ(f.length, dialect().message[m].length);
            ASSERT_EQ(get_bits(f.data, list_counter_bit(dialect()), 8), static_cast<std::uint64_t>(list % 256));
            if (dialect().fd) {
                ASSERT_EQ(get_bits(f.data, 0, 16), profile5_crc(f.data, f.length, data_id));
                ASSERT_EQ(f.data[2], next[m] % 256);
            } else {
                ASSERT_EQ(f.data[0], profile11_crc(f.data, f.length, data_id));
                ASSERT_EQ(f.data[1] & 0xF, next[m] % 15);
                ASSERT_EQ(f.data[1] >> 4, 6);
            }
            ++next[m];
        }
    }
}

TEST_P(CanEncoderTest, NothingFollowsTheCountAndUnusedSlotsAreAllOnes) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        add(object(k + 1, 10.0 * (k + 1), 0.0));
    }
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kObjectCount), 3U);
    if (dialect().fd) {
        EXPECT_EQ(frames_->size(), 1 + 2);
        EXPECT_EQ(raw(SignalId::kObjectId, 3), all_ones(12));
        EXPECT_EQ(raw(SignalId::kSaturated, 3), all_ones(2));
    } else {
        EXPECT_EQ(frames_->size(), 4 + 3 * 7);
    }
}

TEST_P(CanEncoderTest, FullTableSendsTheNearestAndCountsTheRest) {
    for (int k = 0; k < kMaxObjects; ++k) {
        add(object(static_cast<std::uint32_t>(k + 1), 200.0 - 5.0 * k, 0.0));
    }
    const int dropped = kMaxObjects - dialect().max_objects;
    EXPECT_EQ(encode(), dropped > 0 ? Status::kCapacity : Status::kOk);
    EXPECT_EQ(raw(SignalId::kObjectsDropped), static_cast<std::uint64_t>(dropped));
    EXPECT_EQ(raw(SignalId::kObjectCount), static_cast<std::uint64_t>(dialect().max_objects));
    EXPECT_EQ(raw(SignalId::kObjectId, 0), static_cast<std::uint64_t>(kMaxObjects));
    EXPECT_NEAR(value(SignalId::kPositionX, 0), 45.0, 0.01);
    EXPECT_NEAR(value(SignalId::kPositionX, dialect().max_objects - 1), 45.0 + 5.0 * (dialect().max_objects - 1), 0.01);
}

TEST_P(CanEncoderTest, UncertainObjectsComeBehindCertainOnesOfTheSameDistance) {
    TrackedObject doubtful = object(1, 20.0, 0.0);
    doubtful.existence = 0.3;
    add(doubtful);
    add(object(2, 25.0, 0.0));
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kObjectId, 0), 2U);
}

TEST_P(CanEncoderTest, ValueOutsideItsRangeIsFlaggedOnItsObjectOnly) {
    TrackedObject wild = object(1, 20.0, 0.0);
    wild.velocity_v[0] = 500.0;
    add(wild);
    add(object(2, 40.0, 0.0));
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kVelocityX, 0), max_raw(signal_spec(SignalId::kVelocityX)));
    EXPECT_EQ(raw(SignalId::kSaturated, 0), 1U);
    EXPECT_EQ(raw(SignalId::kSaturated, 1), 0U);
}

TEST_P(CanEncoderTest, ObjectWithoutAFinitePositionIsLeftOutAndOtherBadValuesAreNotAvailable) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    add(object(1, nan, 0.0));
    TrackedObject o = object(2, 30.0, 0.0);
    o.yaw_rate = nan;
    add(o);
    EXPECT_EQ(encode(), Status::kCapacity);
    EXPECT_EQ(raw(SignalId::kObjectCount), 1U);
    EXPECT_EQ(raw(SignalId::kObjectId, 0), 2U);
    EXPECT_EQ(raw(SignalId::kYawRate, 0), all_ones(12));
}

TEST_P(CanEncoderTest, StandingPersonHasNoHeadingAndAnUnknownSigmaIsNotZero) {
    TrackedObject person = object(1, 12.0, 3.0);
    person.object_class = ObjectClass::kPedestrian;
    person.has_heading = false;
    person.speed = 0.1;
    person.sigma_position_v = {0.0, 0.2, 0.1};
    add(person);
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kYaw, 0), all_ones(13));
    EXPECT_EQ(raw(SignalId::kSigmaYaw, 0), all_ones(8));
    EXPECT_EQ(raw(SignalId::kSigmaX, 0), all_ones(10));
}

TEST_P(CanEncoderTest, IdWrapsBeforeItsAllOnesAndAgeStopsAtItsEnd) {
    TrackedObject o = object(4095, 12.0, 0.0);
    o.age = 100000;
    add(o);
    EXPECT_EQ(encode(), Status::kOk);
    EXPECT_EQ(raw(SignalId::kObjectId, 0), 0U);
    EXPECT_EQ(raw(SignalId::kAge, 0), all_ones(10) - 1U);
    EXPECT_EQ(raw(SignalId::kSaturated, 0), 0U);
}

TEST_P(CanEncoderTest, BaseIdAndLongIdsMoveTheFramesButNotTheProtection) {
    add(object(1, 12.0, 0.0));
    EXPECT_EQ(encode(), Status::kOk);
    const CanFrame usual = (*frames_)[frames_->size() - 1];
    CanConfig config;
    config.dialect = GetParam();
    config.base_id = 0x18FF0000;
    config.extended = true;
    encoder_.init(config);
    EXPECT_EQ(encode(), Status::kOk);
    const CanFrame& moved = (*frames_)[frames_->size() - 1];
    EXPECT_EQ(moved.id, usual.id - 0x600U + 0x18FF0000U);
    EXPECT_TRUE(moved.extended);
    EXPECT_EQ(moved.data, usual.data);
}

INSTANTIATE_TEST_SUITE_P(Dialects, CanEncoderTest, ::testing::Values(CanDialect::kFd, CanDialect::kClassic),
                         [](const auto& dialect) { return dialect.param == CanDialect::kFd ? "Fd" : "Classic"; });

}  // namespace
}  // namespace semtrack
