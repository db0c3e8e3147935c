// The message that semtrack receives: values within half a bit, gaps in the counter, and nothing from a bad frame.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "publish/signals.hpp"
#include "semtrack/vehicle_motion_frame.hpp"

namespace semtrack {
namespace {

class VehicleMotionFrame : public ::testing::TestWithParam<CanDialect> {
protected:
    VehicleMotionFrame() { config_.dialect = GetParam(); }

    [[nodiscard]] CanFrame frame(const VehicleMotionSignals& signals, std::uint8_t counter = 0) const {
        CanFrame out;
        encode_vehicle_motion(config_, signals, counter, out);
        return out;
    }
    [[nodiscard]] int counters() const { return GetParam() == CanDialect::kFd ? 256 : 15; }

    CanConfig config_{};
    E2eCheck check_{};
    VehicleMotionSignals out_{};
};

VehicleMotionSignals motion(double speed, double yaw_rate) {
    return {{speed, true}, {yaw_rate, true}, {0.06, true}, {0.004, true}};
}

TEST_P(VehicleMotionFrame, ValuesComeBackWithinHalfABitWithTheirSign) {
    for (const double speed : {0.0, -0.0, 0.0024, -0.0026, 13.9, -2.5, 83.3, -99.99, 227.6}) {
        const double yaw_rate = speed / 80.0;
        check_ = E2eCheck{};
        ASSERT_EQ(decode_vehicle_motion(config_, frame(motion(speed, yaw_rate)), check_, out_), E2eState::kOk);
        ASSERT_TRUE(out_.speed.valid && out_.yaw_rate.valid && out_.sigma_speed.valid && out_.sigma_yaw_rate.valid);
        EXPECT_NEAR(out_.speed.value, speed, 0.0025 + 1e-9);
        EXPECT_NEAR(out_.yaw_rate.value, yaw_rate, 0.00005 + 1e-9);
        EXPECT_NEAR(out_.sigma_speed.value, 0.06, 0.01);
        EXPECT_NEAR(out_.sigma_yaw_rate.value, 0.004, 0.0005);
    }
}

TEST_P(VehicleMotionFrame, ValueThatIsMissingOrBeyondItsRangeIsNotAvailableNeverAnother) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double speed : {228.0, -100.1, 1e9, -1e9, nan, std::numeric_limits<double>::infinity()}) {
        check_ = E2eCheck{};
        ASSERT_EQ(decode_vehicle_motion(config_, frame(motion(speed, 0.1)), check_, out_), E2eState::kOk);
        EXPECT_FALSE(out_.speed.valid) << speed;
        EXPECT_EQ(out_.speed.value, 0.0);
        EXPECT_TRUE(out_.yaw_rate.valid);
        VehicleMotion untouched;
        untouched.time_us = 77;
        EXPECT_FALSE(to_vehicle_motion(out_, 1000, untouched));
        EXPECT_EQ(untouched.time_us, 77);
    }
}

TEST_P(VehicleMotionFrame, MissingSigmaKeepsTheDefault) {
    VehicleMotionSignals signals = motion(10.0, 0.2);
    signals.sigma_speed = {};
    ASSERT_EQ(decode_vehicle_motion(config_, frame(signals), check_, out_), E2eState::kOk);
    VehicleMotion m;
    ASSERT_TRUE(to_vehicle_motion(out_, 123456, m));
    EXPECT_EQ(m.time_us, 123456);
    EXPECT_NEAR(m.speed, 10.0, 0.0025);
    EXPECT_EQ(m.sigma_speed, VehicleMotion{}.sigma_speed);
    EXPECT_NEAR(m.sigma_yaw_rate, 0.004, 0.0005);
}

TEST_P(VehicleMotionFrame, EveryStepOfTheCounterHasItsState) {
    const int limit = GetParam() == CanDialect::kFd ? 64 : 7;
    for (int delta = 0; delta < counters(); ++delta) {
        check_ = E2eCheck{};
        const int start = counters() - 2;  // the step wraps
        ASSERT_EQ(decode_vehicle_motion(config_, frame(motion(1, 0), static_cast<std::uint8_t>(start)), check_, out_),
                  E2eState::kOk);
        const auto next = static_cast<std::uint8_t>((start + delta) % counters());
        const E2eState expected = delta == 0       ? E2eState::kRepeated
                                  : delta == 1     ? E2eState::kOk
                                  : delta <= limit ? E2eState::kOkSomeLost
                                                   : E2eState::kWrongSequence;
        EXPECT_EQ(decode_vehicle_motion(config_, frame(motion(2, 0), next), check_, out_), expected) << delta;
        EXPECT_NEAR(out_.speed.value, usable(expected) ? 2.0 : 1.0, 1e-9) << delta;
    }
}

TEST_P(VehicleMotionFrame, EveryFlippedBitIsAnErrorAndChangesNothing) {
    const CanFrame good = frame(motion(12.0, -0.3), 5);
    ASSERT_EQ(decode_vehicle_motion(config_, frame(motion(3.0, 0.0), 4), check_, out_), E2eState::kOk);
    for (unsigned bit = 0; bit < 8U * good.length; ++bit) {
        CanFrame bad = good;
        bad.data[bit / 8] = static_cast<std::uint8_t>(bad.data[bit / 8] ^ (1U << (bit % 8)));
        ASSERT_EQ(decode_vehicle_motion(config_, bad, check_, out_), E2eState::kError) << bit;
        ASSERT_NEAR(out_.speed.value, 3.0, 1e-9);
    }
    EXPECT_EQ(decode_vehicle_motion(config_, good, check_, out_), E2eState::kOk) << "errors do not move the counter";
}

TEST_P(VehicleMotionFrame, OtherIdsAreNoNewDataAndOtherFormatsAreErrors) {
    const CanFrame good = frame(motion(12.0, -0.3));
    CanFrame other = good;
    other.id += 1;
    EXPECT_EQ(decode_vehicle_motion(config_, other, check_, out_), E2eState::kNoNewData);
    other = good;
    other.extended = !other.extended;
    EXPECT_EQ(decode_vehicle_motion(config_, other, check_, out_), E2eState::kNoNewData);
    other = good;
    other.fd = !other.fd;
    EXPECT_EQ(decode_vehicle_motion(config_, other, check_, out_), E2eState::kError);
    other = good;
    other.length = 7;
    EXPECT_EQ(decode_vehicle_motion(config_, other, check_, out_), E2eState::kError);
    EXPECT_FALSE(check_.started);
    EXPECT_EQ(good.id, GetParam() == CanDialect::kFd ? 0x602U : 0x60BU);
}

INSTANTIATE_TEST_SUITE_P(Dialects, VehicleMotionFrame, ::testing::Values(CanDialect::kFd, CanDialect::kClassic),
                         [](const auto& dialect) { return dialect.param == CanDialect::kFd ? "Fd" : "Classic"; });

}  // namespace
}  // namespace semtrack
