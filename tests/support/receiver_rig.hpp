// An encoder and a receiver with a bus in between that a test may disturb.
#ifndef SEMTRACK_TESTS_SUPPORT_RECEIVER_RIG_HPP
#define SEMTRACK_TESTS_SUPPORT_RECEIVER_RIG_HPP

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "publish/e2e.hpp"
#include "publish/messages.hpp"
#include "semtrack/can_receiver.hpp"
#include "support/object_lists.hpp"

namespace semtrack::test {

using Frames = std::vector<CanFrame>;

class ReceiverRig : public ::testing::TestWithParam<CanDialect> {
protected:
    void SetUp() override {
        config_.can.dialect = GetParam();
        encoder_.init(config_.can);
        ASSERT_EQ(receiver_.init(config_), Status::kOk);
        golden_output(*output_);
    }
    [[nodiscard]] const DialectSpec& dialect() const { return dialect_spec(GetParam()); }
    [[nodiscard]] const CanReceiverCounters& counters() const { return receiver_.counters(); }

    /// The next list of the same three objects, 100 ms later.
    Frames next_list() {
        output_->ego.time_us += 100000;
        (void)encoder_.encode(*output_, output_->ego.time_us + 35000, *frames_);
        return {frames_->begin(), frames_->end()};
    }
    FrameResult take(const CanFrame& frame) { return receiver_.take(frame, now_us_, *list_); }
    /// The lists that came out, by their counter.
    std::vector<int> receive(const Frames& frames) {
        std::vector<int> whole;
        for (const CanFrame& f : frames) {
            now_us_ += 250;
            if (take(f) == FrameResult::kListComplete) {
                whole.push_back(list_->list_counter);
            }
        }
        return whole;
    }
    /// A receiver that heard whole lists up to `before` hears `disturbed`, then a whole list: that one always comes.
    /// Returns what came of `disturbed`.
    std::vector<int> disturb(const Frames& before, const Frames& disturbed, const Frames& after) {
        EXPECT_EQ(receiver_.init(config_), Status::kOk);
        EXPECT_EQ(receive(before).size(), 1U);
        const std::vector<int> whole = receive(disturbed);
        EXPECT_EQ(receive(after).size(), 1U) << "the list after the fault is whole again";
        return whole;
    }
    /// Writes the protection of the frame's message anew.
    void protect(CanFrame& frame, std::uint8_t counter) const {
        const auto data_id = static_cast<std::uint16_t>(kE2eFirstDataId + frame.id - config_.can.base_id);
        if (dialect().fd) {
            protect_profile5(frame.data, frame.length, data_id, counter);
        } else {
            protect_profile11(frame.data, frame.length, data_id, counter);
        }
    }
    [[nodiscard]] std::uint8_t counter_of(const CanFrame& f) const {
        return dialect().fd ? f.data[2] : static_cast<std::uint8_t>(f.data[1] & 0xFU);
    }
    [[nodiscard]] std::uint32_t errors() const { return counters().frames[static_cast<std::size_t>(E2eState::kError)]; }

    CanReceiverConfig config_{};
    CanEncoder encoder_;
    CanReceiver receiver_;
    std::int64_t now_us_{777};
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
    std::unique_ptr<CanList> frames_ = std::make_unique<CanList>();
    std::unique_ptr<ReceivedList> list_ = std::make_unique<ReceivedList>();
};

inline std::string dialect_name(const ::testing::TestParamInfo<CanDialect>& info) {
    return info.param == CanDialect::kFd ? "Fd" : "Classic";
}

}  // namespace semtrack::test

#endif
