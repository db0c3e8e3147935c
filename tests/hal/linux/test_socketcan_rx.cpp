// Speed and yaw rate from the bus: checked, stamped, not too old, and never more work than a bound.
#include <gtest/gtest.h>

#include "fake_kernel.hpp"
#include "hal/linux/socketcan_rx.hpp"

namespace semtrack::hal::test {
namespace {

struct Bus {
    explicit Bus(CanDialect dialect = CanDialect::kFd) {
        config.dialect = dialect;
        EXPECT_EQ(rx.open("can0", config), CanOpen::kOk);
    }
    void arrive(double speed, std::uint8_t counter, bool known = true) {
        VehicleMotionSignals s;
        s.speed = {speed, known};
        s.yaw_rate = {0.1, true};
        CanFrame f;
        encode_vehicle_motion(config, s, counter, f);
        Arrival a;
        a.frame.can_id = f.id | (f.extended ? CAN_EFF_FLAG : 0U);
        a.frame.len = f.length;
        std::copy_n(f.data.begin(), f.length, a.frame.data);
        a.size = f.fd ? CANFD_MTU : CAN_MTU;
        a.stamp_us = kernel.realtime_us();
        kernel.arrivals.push_back(a);
    }
    SourceResult poll() { return rx.poll(0, motion); }

    FakeKernel kernel{};
    CanConfig config{};
    SocketCanRx rx{kernel};
    VehicleMotion motion{};
};

TEST(SocketCanRx, HandsOutTheNewestMotionWithTheTimeOfItsReception) {
    for (const CanDialect dialect : {CanDialect::kFd, CanDialect::kClassic}) {
        Bus bus(dialect);
        EXPECT_EQ(bus.poll(), SourceResult::kNone);
        bus.arrive(10.0, 0);
        bus.kernel.now_us += 10000;
        bus.arrive(11.0, 1);
        const std::int64_t received = bus.kernel.realtime_us();
        bus.kernel.now_us += 30000;
        ASSERT_EQ(bus.poll(), SourceResult::kOk);
        EXPECT_NEAR(bus.motion.speed, 11.0, 0.0026);
        EXPECT_NEAR(bus.motion.yaw_rate, 0.1, 0.00006);
        EXPECT_EQ(bus.motion.time_us, received);
        EXPECT_EQ(bus.rx.counters().frames[0], 2U);
    }
}

TEST(SocketCanRx, AsksTheKernelForThatMessageOnly) {
    Bus bus;
    EXPECT_EQ(bus.kernel.filter_size, sizeof(can_filter));
    EXPECT_EQ(bus.kernel.filter.can_id, vehicle_motion_id(bus.config));
    EXPECT_EQ(bus.kernel.filter.can_mask, CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK);
}

TEST(SocketCanRx, TheTimeOfReceptionIsBroughtToTheImagesClock) {
    Bus bus;
    EXPECT_EQ(bus.rx.open("can0", bus.config, -bus.kernel.realtime_ahead_us), CanOpen::kOk);
    bus.arrive(5.0, 0);
    ASSERT_EQ(bus.poll(), SourceResult::kOk);
    EXPECT_EQ(bus.motion.time_us, bus.kernel.now_us);
}

TEST(SocketCanRx, WithoutAStampTheTimeOfReadingCounts) {
    Bus bus;
    bus.arrive(5.0, 0);
    bus.kernel.arrivals.back().stamp_us = -1;
    bus.kernel.now_us += 20000;
    ASSERT_EQ(bus.poll(), SourceResult::kOk);
    EXPECT_EQ(bus.motion.time_us, bus.kernel.realtime_us());
}

TEST(SocketCanRx, AnOldMotionIsNoneAndTheNextOneStartsAnew) {
    Bus bus;
    bus.arrive(10.0, 0);
    bus.kernel.now_us += SocketCanRx::kTimeout_us;
    EXPECT_EQ(bus.poll(), SourceResult::kOk);
    bus.kernel.now_us += 1;
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    EXPECT_EQ(bus.rx.counters().timeouts, 1U);
    bus.arrive(12.0, 200);
    EXPECT_EQ(bus.poll(), SourceResult::kOk) << "a counter far away is no fault after a pause";
}

TEST(SocketCanRx, WhatLayInTheQueueDuringAPauseIsOld) {
    Bus bus;
    for (std::uint8_t k = 0; k < 20; ++k) {
        bus.arrive(10.0, k);
    }
    bus.kernel.now_us += 3000000;
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
}

TEST(SocketCanRx, DamagedRepeatedAndForeignFramesAreNotUsed) {
    Bus bus;
    bus.arrive(10.0, 0);
    bus.arrive(99.0, 1);
    bus.kernel.arrivals.back().frame.data[5] ^= 1U;
    bus.arrive(98.0, 0);
    bus.arrive(97.0, 100);
    bus.arrive(96.0, 101);
    bus.kernel.arrivals.back().frame.can_id += 1U;
    ASSERT_EQ(bus.poll(), SourceResult::kOk);
    EXPECT_NEAR(bus.motion.speed, 10.0, 0.0026);
    const auto& frames = bus.rx.counters().frames;
    EXPECT_EQ(frames[static_cast<std::size_t>(E2eState::kOk)], 1U);
    EXPECT_EQ(frames[static_cast<std::size_t>(E2eState::kError)], 1U);
    EXPECT_EQ(frames[static_cast<std::size_t>(E2eState::kRepeated)], 1U);
    EXPECT_EQ(frames[static_cast<std::size_t>(E2eState::kWrongSequence)], 1U);
    EXPECT_EQ(frames[static_cast<std::size_t>(E2eState::kNoNewData)], 1U);
}

TEST(SocketCanRx, ASpeedThatTheSenderDoesNotKnowEndsTheMotion) {
    Bus bus;
    bus.arrive(10.0, 0);
    EXPECT_EQ(bus.poll(), SourceResult::kOk);
    bus.arrive(10.0, 1, false);
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    EXPECT_EQ(bus.rx.counters().not_available, 1U);
}

TEST(SocketCanRx, ABabblingSenderCostsABoundedNumberOfReads) {
    Bus bus;
    for (int k = 0; k < 1000; ++k) {
        bus.arrive(10.0, static_cast<std::uint8_t>(k));
    }
    const int calls = bus.kernel.calls;
    EXPECT_EQ(bus.poll(), SourceResult::kOk);
    EXPECT_EQ(bus.kernel.calls - calls, SocketCanRx::kMaxReads);
}

TEST(SocketCanRx, AnInterfaceThatIsDownOrGoneIsNoErrorAndComesBack) {
    Bus bus;
    bus.kernel.go_down();
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    bus.kernel.vanish();
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    const int calls = bus.kernel.calls;
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    EXPECT_EQ(bus.kernel.calls - calls, 1) << "one look whether it is back, none right after it";
    bus.kernel.come_back(11);
    bus.kernel.now_us += CanSocket::kLookPause_us;
    bus.kernel.up = true;
    EXPECT_EQ(bus.poll(), SourceResult::kNone);
    bus.arrive(7.0, 9);
    EXPECT_EQ(bus.poll(), SourceResult::kOk);
    EXPECT_EQ(bus.rx.counters().reopened, 1U);
    EXPECT_EQ(bus.rx.counters().downs, 2U);
}

}  // namespace
}  // namespace semtrack::hal::test
