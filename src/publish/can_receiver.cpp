#include "semtrack/can_receiver.hpp"

#include "publish/e2e.hpp"
#include "publish/list_decoder.hpp"

namespace semtrack {

namespace {

constexpr std::uint32_t kHighestStandardId = 0x7FF;
constexpr std::uint32_t kHighestExtendedId = 0x1FFFFFFF;

/// later - earlier without overflow: clocks may start anywhere.
std::int64_t elapsed_us(std::int64_t later, std::int64_t earlier) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier));
}

/// A signal of the dialect's first message.
std::uint64_t first_frame_signal(const DialectSpec& dialect, const FrameBytes& data, SignalId id) {
    const MessageSpec& m = dialect.message[0];
    int bit = first_signal_bit(dialect, m);
    for (int i = 0; i < m.signals; ++i) {
        const SignalId here = m.signal[static_cast<std::size_t>(i)];
        if (here == id) {
            return get_bits(data, bit, signal_spec(here).length);
        }
        bit += signal_spec(here).length;
    }
    return all_ones(signal_spec(id).length);
}

std::uint8_t list_counter_of(const DialectSpec& dialect, const FrameBytes& data) {
    return static_cast<std::uint8_t>(
        get_bits(data, list_counter_bit(dialect), signal_spec(SignalId::kListCounter).length));
}

}  // namespace

Status CanReceiver::init(const CanReceiverConfig& config) {
    *this = CanReceiver{};
    config_ = config;
    const std::uint32_t highest = config.can.extended ? kHighestExtendedId : kHighestStandardId;
    const std::uint32_t messages = dialect_spec(config.can.dialect).messages;
    ready_ = config.can.base_id <= highest - messages && config.timeout_us > 0;
    return ready_ ? Status::kOk : Status::kInvalidArgument;
}

FrameResult CanReceiver::take(const CanFrame& frame, std::int64_t now_us, ReceivedList& list) {
    const DialectSpec& dialect = dialect_spec(config_.can.dialect);
    const std::uint32_t message = frame.id - config_.can.base_id;  // wraps for lower ids
    if (!ready_ || frame.extended != config_.can.extended || message >= dialect.messages) {
        ++counters_.frames[static_cast<std::size_t>(E2eState::kNoNewData)];
        return FrameResult::kIgnored;
    }
    restart_after_silence(now_us);
    const auto m = static_cast<int>(message);
    const E2eState state = check(frame, m);
    ++counters_.frames[static_cast<std::size_t>(state)];
    if (!usable(state)) {
        return refuse(state);
    }
    if (m == 0) {
        if (!begin_list(frame, now_us)) {
            return refuse(E2eState::kError);
        }
    } else if (!is_next(frame, m)) {
        ++counters_.frames_out_of_place;
        return refuse(E2eState::kError);
    }
    for (std::size_t i = 0; i < frame.length; ++i) {
        bytes_[size_++] = frame.data[i];
    }
    ++next_;
    return next_ == total_ ? finish(list) : FrameResult::kTaken;
}

/// After a time-out the counters say nothing any more: the sender may have started again.
void CanReceiver::restart_after_silence(std::int64_t now_us) {
    if (heard_ && elapsed_us(now_us, heard_us_) > config_.timeout_us) {
        ++counters_.timeouts;
        give_up();
        checks_ = {};
        counted_ = false;
    }
    heard_ = true;
    heard_us_ = now_us;
}

E2eState CanReceiver::check(const CanFrame& frame, int message) {
    const DialectSpec& dialect = dialect_spec(config_.can.dialect);
    const int length = dialect.message[static_cast<std::size_t>(message)].length;
    if (frame.fd != dialect.fd || frame.length != length) {
        return E2eState::kError;
    }
    const auto data_id = static_cast<std::uint16_t>(kE2eFirstDataId + message);
    E2eCheck& memory = checks_[static_cast<std::size_t>(message)];
    return dialect.fd ? check_profile5(frame.data, length, data_id, memory)
                      : check_profile11(frame.data, length, data_id, memory);
}

bool CanReceiver::begin_list(const CanFrame& frame, std::int64_t now_us) {
    const DialectSpec& dialect = dialect_spec(config_.can.dialect);
    give_up();  // the last one was not whole
    const std::uint8_t counter = list_counter_of(dialect, frame.data);
    if (counted_) {
        const auto missed = static_cast<std::uint8_t>(counter - list_counter_ - 1);
        counters_.lists_missed += missed;
        new_loss_ = new_loss_ || missed > 0;
    }
    counted_ = true;
    list_counter_ = counter;
    const std::uint64_t objects = first_frame_signal(dialect, frame.data, SignalId::kObjectCount);
    if (first_frame_signal(dialect, frame.data, SignalId::kProtocolVersion) != kProtocolVersion ||
        objects > dialect.max_objects) {
        ++counters_.lists_refused;
        return false;
    }
    objects_ = static_cast<int>(objects);
    total_ = list_frames(dialect, objects_);
    begun_us_ = now_us;
    return true;
}

/// next_ counts the list's frames in the order of sending: the header's, then each object message's in turn.
bool CanReceiver::is_next(const CanFrame& frame, int message) const {
    const DialectSpec& dialect = dialect_spec(config_.can.dialect);
    if (next_ == 0 || list_counter_of(dialect, frame.data) != list_counter_) {
        return false;
    }
    if (message < dialect.header_messages) {
        return message == next_;
    }
    int place = dialect.header_messages;
    for (int k = dialect.header_messages; k < message; ++k) {
        place += frames_of(dialect.message[static_cast<std::size_t>(k)], objects_);
    }
    const auto index = static_cast<int>(get_bits(frame.data, record_index_bit(dialect), kRecordIndexBits));
    return index < frames_of(dialect.message[static_cast<std::size_t>(message)], objects_) && place + index == next_;
}

FrameResult CanReceiver::finish(ReceivedList& list) {
    std::uint64_t raw_time = 0;
    const DialectSpec& dialect = dialect_spec(config_.can.dialect);
    if (!decode_list(dialect, bytes_.data(), objects_, list, raw_time)) {
        ++counters_.frames_out_of_place;
        return refuse(E2eState::kError);
    }
    image_time_us_ = unwrap(raw_time);
    list.list_counter = list_counter_;
    list.image_time_us = image_time_us_;
    list.received_us = begun_us_;
    list.taken_us = {};
    if (list.age_us.valid && !list.age_us.saturated) {
        list.taken_us = {elapsed_us(begun_us_, list.age_us.value), true, false};
    }
    ++counters_.lists_complete;
    whole_ = true;
    whole_us_ = begun_us_;
    new_list_ = true;
    next_ = 0;
    size_ = 0;
    return FrameResult::kListComplete;
}

/// The time congruent to raw that lies nearest to what this receiver's own clock makes of the last list's.
std::int64_t CanReceiver::unwrap(std::uint64_t raw) const {
    const int bits = signal_spec(SignalId::kImageTime).length;
    const std::uint64_t modulus = all_ones(bits) + 1U;
    std::uint64_t from = static_cast<std::uint64_t>(config_.reference_time_us);  // not before this
    if (whole_) {
        const auto passed = static_cast<std::uint64_t>(elapsed_us(begun_us_, whole_us_));
        from = static_cast<std::uint64_t>(image_time_us_) + passed - modulus / 2U;
    }
    return static_cast<std::int64_t>(from + ((raw - from) & (modulus - 1U)));
}

FrameResult CanReceiver::refuse(E2eState state) {
    refused_ = state;
    new_loss_ = true;
    give_up();
    return FrameResult::kRefused;
}

void CanReceiver::give_up() {
    if (next_ > 0) {
        ++counters_.lists_broken;
        new_loss_ = true;
    }
    next_ = 0;
    size_ = 0;
}

E2eState CanReceiver::poll() {
    E2eState state = refused_;
    if (new_list_) {
        state = new_loss_ ? E2eState::kOkSomeLost : E2eState::kOk;
    }
    new_list_ = false;
    new_loss_ = false;
    refused_ = E2eState::kNoNewData;
    return state;
}

bool CanReceiver::timed_out(std::int64_t now_us) const {
    return !whole_ || elapsed_us(now_us, whole_us_) > config_.timeout_us;
}

}  // namespace semtrack
