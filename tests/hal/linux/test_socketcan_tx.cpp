// A list gets out whole and in order, as far as the bus allows, without waiting and without anything stale.
#include <gtest/gtest.h>

#include "can_lists.hpp"

namespace semtrack::hal::test {
namespace {

using Result = CanTx::Result;

TEST(SocketCanTx, SendsAListInOrderWithTheFramesAsTheyAre) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 3), Result::kSent);
    ASSERT_EQ(kernel.sent.size(), 5U);
    for (int k = 0; k < 5; ++k) {
        const canfd_frame& f = kernel.sent[static_cast<std::size_t>(k)];
        EXPECT_EQ(f.can_id, k == 0 ? 0x600U : 0x601U);
        EXPECT_EQ(f.len, 64);
        EXPECT_EQ(f.flags, CANFD_BRS);
        EXPECT_EQ(f.data[0], 3);
        EXPECT_EQ(f.data[1], k);
        EXPECT_EQ(kernel.sizes[static_cast<std::size_t>(k)], static_cast<int>(CANFD_MTU));
    }
    EXPECT_EQ(tx.counters().lists_sent, 1U);
    EXPECT_EQ(tx.counters().frames_sent, 5U);
    EXPECT_EQ(tx.lists_lost(), 0U);
    EXPECT_EQ(tx.state(), CanState::kActive);
}

TEST(SocketCanTx, SendsClassicFramesAndLongIds) {
    FakeKernel kernel;
    kernel.mtu = CAN_MTU;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", false), CanOpen::kOk);
    CanFrame f = list_frame(1, 0, false);
    f.id = 0x18FF0600U;
    f.extended = true;
    EXPECT_EQ(tx.send(f, 0), Result::kSent) << "a frame alone is a list of its own";
    ASSERT_EQ(kernel.sent.size(), 1U);
    EXPECT_EQ(kernel.sent[0].can_id, 0x18FF0600U | CAN_EFF_FLAG);
    EXPECT_EQ(kernel.sizes[0], static_cast<int>(CAN_MTU));
}

TEST(SocketCanTx, RefusesFramesThatTheInterfaceCannotCarry) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    CanFrame odd = list_frame(0, 0);
    odd.length = 63;
    EXPECT_EQ(tx.send(odd, 0), Result::kInvalidFrame);
    CanFrame far = list_frame(0, 0);
    far.id = 0x800;
    EXPECT_EQ(tx.send(far, 0), Result::kInvalidFrame);
    EXPECT_EQ(tx.send(list_frame(0, 0, false), 0), Result::kInvalidFrame) << "the dialect was fixed at open()";
    EXPECT_EQ(tx.begin_list(0, 0), Result::kInvalidFrame);
    EXPECT_EQ(tx.begin_list(kMaxCanFrames + 1, 0), Result::kInvalidFrame);
    EXPECT_TRUE(kernel.sent.empty());
    EXPECT_EQ(offer(tx, 1), Result::kSent) << "and goes on";
}

TEST(SocketCanTx, ReceivesNothingButErrors) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(kernel.filter_size, 0U);
    const auto has = [&kernel](int level, int name) {
        const std::string option = std::to_string(level) + ":" + std::to_string(name);
        return std::count(kernel.options.begin(), kernel.options.end(), option) == 1;
    };
    EXPECT_TRUE(has(SOL_CAN_RAW, CAN_RAW_ERR_FILTER));
    EXPECT_TRUE(has(SOL_CAN_RAW, CAN_RAW_FD_FRAMES));
    EXPECT_TRUE(has(SOL_SOCKET, SO_SNDBUF));
}

TEST(SocketCanTx, GivesALongListToTheKernelPieceByPieceAndWaitsOnlyInService) {
    FakeKernel kernel;
    kernel.mtu = CAN_MTU;
    kernel.frame_us = 270;  // classic CAN at 500 kbit/s
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", false), CanOpen::kOk);
    const std::int64_t before = kernel.now_us;
    constexpr int kFrames = 4 + 7 * 16;
    EXPECT_EQ(offer(tx, 1, kFrames, false), Result::kSent);
    EXPECT_EQ(kernel.now_us, before) << "sending does not wait";
    EXPECT_EQ(kernel.sent.size(), 6U);
    EXPECT_TRUE(tx.waiting());
    EXPECT_TRUE(tx.service(60));
    EXPECT_EQ(kernel.sent.size(), static_cast<std::size_t>(kFrames));
    EXPECT_LT(kernel.now_us - before, 40000) << "the bus itself takes 31 ms";
    EXPECT_LT(kernel.calls, 3 * kFrames);
    EXPECT_EQ(tx.counters().lists_sent, 1U);
}

TEST(SocketCanTx, WithoutServiceTheListGoesOnWithTheNextOneWhichIsRefused) {
    FakeKernel kernel;
    kernel.frame_us = 400;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1, 17), Result::kSent);
    kernel.now_us += kPeriod_us;
    EXPECT_EQ(offer(tx, 2, 17), Result::kBusy) << "list 1 has sent 12 of 17 frames";
    kernel.now_us += kPeriod_us;
    EXPECT_EQ(offer(tx, 3, 17), Result::kSent) << "list 1 is too old by now";
    EXPECT_EQ(tx.counters().lists_broken, 1U);
    EXPECT_EQ(tx.counters().lists_refused, 1U);
    EXPECT_EQ(tx.lists_lost(), 1U) << "the refused one was told";
}

TEST(SocketCanTx, AStalledBusNeverHoldsAWholeOldList) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    kernel.stuck = true;  // nobody acknowledges
    for (int list = 1; list <= 30; ++list) {
        (void)offer(tx, list, 3);  // three frames would fit in the socket
        (void)tx.service(60);
        kernel.now_us += kPeriod_us;
    }
    for (const auto& [list, frames] : frames_of_lists(kernel)) {
        EXPECT_LT(frames, 3) << "list " << list << " would come whole, but seconds late";
    }
    kernel.stuck = false;
    kernel.frame_us = 400;
    const std::size_t old = kernel.sent.size();
    EXPECT_EQ(offer(tx, 31, 3), Result::kSent);
    EXPECT_TRUE(tx.service(60));
    ASSERT_EQ(kernel.sent.size(), old + 3);
    EXPECT_EQ(kernel.sent[old].data[0], 31) << "the first list after the pause is the current one";
    EXPECT_EQ(tx.counters().lists_sent, 1U);
    EXPECT_EQ(tx.lists_lost() + tx.counters().lists_refused, 30U) << "every list is accounted for";
}

TEST(SocketCanTx, AListThatNeverBeganGivesWayToItsSuccessor) {
    FakeKernel kernel;
    kernel.writes = {-EAGAIN};
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(offer(tx, 1), Result::kSent) << "taken over";
    EXPECT_EQ(offer(tx, 2), Result::kSent);
    const auto lists = frames_of_lists(kernel);
    EXPECT_EQ(lists.count(1), 0U);
    EXPECT_EQ(lists.at(2), kListFrames);
    EXPECT_EQ(tx.counters().lists_unsent, 1U);
}

TEST(SocketCanTx, AnUnfinishedListOfTheCallerIsGivenUp) {
    FakeKernel kernel;
    SocketCanTx tx(kernel);
    ASSERT_EQ(tx.open("can0", true), CanOpen::kOk);
    EXPECT_EQ(tx.begin_list(3, 0), Result::kSent);
    EXPECT_EQ(tx.send(list_frame(1, 0), 0), Result::kSent);
    EXPECT_FALSE(tx.service(20)) << "its frames are not all here";
    EXPECT_EQ(offer(tx, 2), Result::kSent);
    EXPECT_EQ(tx.counters().lists_broken, 1U);
    EXPECT_EQ(frames_of_lists(kernel).at(2), kListFrames);
}

}  // namespace
}  // namespace semtrack::hal::test
