// Every errno, and the interface and the controller in all their moods.
#include <gtest/gtest.h>

#include "can_lists.hpp"

namespace semtrack::hal::test {
namespace {

using Result = CanTx::Result;

TEST(SocketCanOpen, SaysWhatIsWrong) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    EXPECT_EQ(tx.open("", true), CanOpen::kBadName);
    EXPECT_EQ(tx.open("abcdefghijklmnop", true), CanOpen::kBadName) << "16 characters";
    EXPECT_EQ(kernel.calls, 0);
    EXPECT_EQ(tx.open("abcdefghijklmno", true), CanOpen::kNoInterface) << "15 are legal";
    EXPECT_EQ(tx.open("can1", true), CanOpen::kNoInterface);
    kernel.mtu = CAN_MTU;
    EXPECT_EQ(tx.open("can0", true), CanOpen::kClassicOnly);
    EXPECT_EQ(tx.open("can0", false), CanOpen::kOk);
    for (const auto& [error, result] : {std::pair{-EAFNOSUPPORT, CanOpen::kNoSocketCan},
                                        {-EPROTONOSUPPORT, CanOpen::kNoSocketCan},
                                        {-EPERM, CanOpen::kNotAllowed},
                                        {-EACCES, CanOpen::kNotAllowed},
                                        {-EMFILE, CanOpen::kFailed}}) {
        kernel.open_error = error;
        EXPECT_EQ(tx.open("can0", false), result) << error;
        EXPECT_EQ(tx.fd(), -1);
        EXPECT_EQ(tx.state(), CanState::kDown);
        EXPECT_EQ(offer(tx, 1, kListFrames, false), Result::kBusOff) << "not open: refused, not crashed";
    }
    kernel.open_error = 0;
    kernel.bind_error = -ENODEV;  // an interface that is no CAN
    EXPECT_EQ(tx.open("can0", false), CanOpen::kNoInterface);
    kernel.bind_error = 0;
    kernel.option_error = -ENOPROTOOPT;
    EXPECT_EQ(tx.open("can0", false), CanOpen::kFailed);
    EXPECT_EQ(kernel.opened, kernel.closed) << "no descriptor is left";
    for (int r = 0; r <= static_cast<int>(CanOpen::kFailed); ++r) {
        EXPECT_GT(std::string(text(static_cast<CanOpen>(r))).size(), 3U);
    }
}

struct Burst {
    int error;
    int length;
    int after;  ///< good writes before it
};

/// 100 lists, one burst; every list that appears is whole, and no cycle makes more than ten calls a frame.
void expect_whole_lists(const Burst& burst) {
    SCOPED_TRACE(testing::Message() << "errno " << -burst.error << " x " << burst.length << " after " << burst.after);
    FakeKernel kernel;
    kernel.writes.assign(static_cast<std::size_t>(burst.after), 0);
    kernel.writes.insert(kernel.writes.end(), static_cast<std::size_t>(burst.length), burst.error);
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    int taken = 0;
    for (int list = 0; list < 100; ++list) {
        const int calls = kernel.calls;
        const std::size_t sent = kernel.sent.size();
        taken += offer(tx, list) == Result::kSent ? 1 : 0;
        (void)tx.service(60);
        const int frames = static_cast<int>(kernel.sent.size() - sent);
        EXPECT_LE(kernel.calls - calls, 10 + 2 * frames) << list;
        if (frames > 0) {
            EXPECT_EQ(kernel.sent.back().data[0], list) << "nothing but the current list";
        }
        kernel.now_us += kPeriod_us;
    }
    EXPECT_TRUE(kernel.writes.empty());
    int whole = 0;
    int broken = 0;
    for (const auto& [list, frames] : frames_of_lists(kernel)) {
        ++(frames == kListFrames ? whole : broken);
    }
    const SocketCanCounters& c = tx.counters();
    EXPECT_EQ(static_cast<int>(c.lists_sent), whole);
    EXPECT_EQ(static_cast<int>(c.lists_broken), broken);
    EXPECT_LE(broken, 1) << "only the one that an outage met half way";
    EXPECT_EQ(c.lists_sent + c.lists_refused + c.lists_unsent + c.lists_broken, 100U);
    EXPECT_EQ(taken, static_cast<int>(c.lists_sent + tx.lists_lost()));
    EXPECT_EQ(frames_of_lists(kernel).at(99), kListFrames) << "good again";
    EXPECT_EQ(tx.state(), CanState::kActive);
}

TEST(SocketCanFaults, BurstsOfEveryErrorLeaveListsWholeOrAbsent) {
    for (const int error : {-EAGAIN, -ENOBUFS, -ENOMEM, -EINTR, -ENETDOWN, -EINVAL, -EPERM, -EMSGSIZE, 8}) {
        for (const int length : {1, 2, 3, 20, 60}) {
            for (const int after : {50, 51, 52, 54}) {  // at a list's first frame, within it, at its last
                expect_whole_lists({error, length, after});
            }
        }
    }
}

TEST(SocketCanFaults, AShortPauseWithinAListDoesNotBreakIt) {
    for (const int error : {-EAGAIN, -ENOBUFS, 8, -EINTR}) {
        FakeKernel kernel;
        kernel.writes = {0, 0, error, error};
        SocketCanTx tx(kernel);
        ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
        EXPECT_EQ(offer(tx, 1), Result::kSent);
        EXPECT_TRUE(tx.service(60)) << error;
        EXPECT_EQ(tx.counters().lists_sent, 1U) << error;
        EXPECT_EQ(kernel.sent.size(), 5U);
    }
}

TEST(SocketCanFaults, CountsWhatTheKernelSaid) {
    FakeKernel kernel;
    kernel.writes = {-EAGAIN, -ENOBUFS, 16, -EPERM};
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    for (int list = 0; list < 5; ++list) {
        (void)offer(tx, list);
    }
    const SocketCanCounters& c = tx.counters();
    EXPECT_EQ(c.busy, 1U);
    EXPECT_EQ(c.no_buffers, 1U);
    EXPECT_EQ(c.short_writes, 1U);
    EXPECT_EQ(c.other_errors, 1U);
    EXPECT_EQ(c.lists_sent, 1U);
}

TEST(SocketCanFaults, AnInterfaceThatWasDownGoesOnWithTheCurrentList) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1), Result::kSent);
    kernel.go_down();
    for (int list = 2; list < 32; ++list) {
        const int calls = kernel.calls;
        EXPECT_EQ(offer(tx, list), Result::kBusOff);
        EXPECT_LE(kernel.calls - calls, 4);
        EXPECT_EQ(tx.state(), CanState::kDown);
        kernel.now_us += kPeriod_us;
    }
    kernel.up = true;
    EXPECT_EQ(offer(tx, 32), Result::kSent);
    EXPECT_EQ(tx.state(), CanState::kActive);
    EXPECT_EQ(kernel.sent.back().data[0], 32);
    EXPECT_EQ(kernel.sent.size(), 10U);
    EXPECT_EQ(tx.counters().downs, 1U);
    EXPECT_EQ(tx.counters().lists_refused, 30U);
    EXPECT_EQ(tx.lists_lost(), 0U);
    EXPECT_EQ(kernel.opened, 1) << "the socket stays";
}

TEST(SocketCanFaults, AnInterfaceThatIsDownAtTheStartMayComeUpLater) {
    FakeKernel kernel;
    kernel.up = false;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1), Result::kBusOff);
    kernel.up = true;
    EXPECT_EQ(offer(tx, 2), Result::kSent);
}

TEST(SocketCanFaults, AnInterfaceThatVanishedIsFoundAgainUnderAnotherIndex) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1), Result::kSent);
    kernel.vanish();
    for (int list = 2; list < 12; ++list) {
        const int calls = kernel.calls;
        EXPECT_EQ(offer(tx, list), Result::kBusOff);
        EXPECT_LE(kernel.calls - calls, 2);
        EXPECT_EQ(tx.state(), CanState::kDown);
        kernel.now_us += kPeriod_us;
    }
    kernel.come_back(12);
    kernel.now_us += CanSocket::kLookPause_us;
    EXPECT_EQ(offer(tx, 12), Result::kSent);
    EXPECT_EQ(frames_of_lists(kernel).at(12), kListFrames);
    EXPECT_EQ(tx.counters().reopened, 1U);
    EXPECT_EQ(tx.counters().downs, 1U);
    EXPECT_EQ(tx.state(), CanState::kActive);
}

TEST(SocketCanFaults, AnInterfaceThatWasReplacedBetweenTwoListsCostsNone) {
    for (const int error : {-ENODEV, -ENXIO}) {
        FakeKernel kernel;
        SocketCanTx tx(kernel);
        ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
        kernel.index = 9;
        kernel.writes = {error};
        EXPECT_EQ(offer(tx, 1), Result::kSent);
        EXPECT_EQ(frames_of_lists(kernel).at(1), kListFrames);
        EXPECT_EQ(tx.counters().reopened, 1U);
    }
}

TEST(SocketCanFaults, AnInterfaceThatComesBackWithoutFdIsRefusedAndNotAbused) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    kernel.mtu = CAN_MTU;
    for (int list = 0; list < 5; ++list) {
        EXPECT_EQ(offer(tx, list), Result::kBusOff);
        EXPECT_EQ(tx.state(), CanState::kDown);
    }
    EXPECT_TRUE(kernel.sent.empty());
    EXPECT_EQ(tx.counters().other_errors, 5U);
    kernel.mtu = CANFD_MTU;
    EXPECT_EQ(offer(tx, 5), Result::kSent);
}

TEST(SocketCanFaults, BusOffStopsListsUntilTheControllerIsRestarted) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1), Result::kSent);
    kernel.error_frame(CAN_ERR_BUSOFF);
    kernel.carrier = false;
    for (int list = 2; list < 32; ++list) {
        EXPECT_EQ(offer(tx, list), Result::kBusOff);
        EXPECT_EQ(tx.state(), CanState::kBusOff);
        kernel.now_us += kPeriod_us;
    }
    kernel.carrier = true;
    kernel.error_frame(CAN_ERR_RESTARTED);
    EXPECT_EQ(offer(tx, 32), Result::kSent);
    EXPECT_EQ(kernel.sent.back().data[0], 32);
    EXPECT_EQ(kernel.sent.size(), 10U);
    EXPECT_EQ(tx.counters().bus_offs, 1U);
    EXPECT_EQ(tx.state(), CanState::kActive);
}

TEST(SocketCanFaults, BusOffWithoutNewsOfARestartIsTriedAgainAfterAPause) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    kernel.error_frame(CAN_ERR_BUSOFF);
    EXPECT_EQ(offer(tx, 1), Result::kBusOff);
    kernel.now_us += SocketCanTx::kBusOffPause_us - 1;
    EXPECT_EQ(offer(tx, 2), Result::kBusOff);
    kernel.now_us += 1;
    EXPECT_EQ(offer(tx, 3), Result::kSent);
    EXPECT_EQ(tx.counters().bus_offs, 1U);
}

TEST(SocketCanFaults, BusOffInTheMiddleOfAListGivesItUp) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    kernel.stuck = true;
    EXPECT_EQ(offer(tx, 1, 17), Result::kSent);
    kernel.error_frame(CAN_ERR_BUSOFF);
    EXPECT_EQ(offer(tx, 2, 17), Result::kBusOff);
    EXPECT_FALSE(tx.waiting());
    EXPECT_EQ(tx.counters().lists_broken, 1U);
}

TEST(SocketCanFaults, ErrorPassiveIsSaidAndTakenBack) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    kernel.error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
    EXPECT_EQ(offer(tx, 1), Result::kSent) << "frames still go out";
    EXPECT_EQ(tx.state(), CanState::kErrorPassive);
    kernel.error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE);
    EXPECT_EQ(offer(tx, 2), Result::kSent);
    EXPECT_EQ(tx.counters().error_passives, 1U) << "it was so already";
    kernel.error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
    EXPECT_EQ(offer(tx, 3), Result::kSent);
    EXPECT_EQ(tx.state(), CanState::kActive);
}

TEST(SocketCanFaults, AStormOfErrorFramesDoesNotHoldUpACycle) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    for (int k = 0; k < 1000; ++k) {
        kernel.error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW);
    }
    const int calls = kernel.calls;
    EXPECT_EQ(offer(tx, 1), Result::kSent);
    EXPECT_LE(kernel.calls - calls, 10 + 2 * kListFrames);
}

}  // namespace
}  // namespace semtrack::hal::test
