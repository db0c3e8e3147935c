#include "semtrack/can_encoder.hpp"

#include "publish/e2e.hpp"
#include "publish/object_list.hpp"

namespace semtrack {

namespace {

/// One frame of a message while it is filled.
struct Draft {
    const DialectSpec& dialect;
    int message;
    CanFrame frame{};
    int bit{0};  // where the next signal goes

    [[nodiscard]] const MessageSpec& spec() const { return dialect.message[static_cast<std::size_t>(message)]; }
};

Draft begin_frame(const CanConfig& config, const DialectSpec& dialect, int message, std::uint8_t list_counter,
                  int index) {
    Draft draft{dialect, message};
    draft.frame.id = config.base_id + static_cast<std::uint32_t>(message);
    draft.frame.extended = config.extended;
    draft.frame.fd = dialect.fd;
    draft.frame.length = draft.spec().length;
    put_bits(draft.frame.data, list_counter_bit(dialect), signal_spec(SignalId::kListCounter).length, list_counter);
    if (draft.spec().records > 0) {
        put_bits(draft.frame.data, record_index_bit(dialect), kRecordIndexBits, static_cast<std::uint64_t>(index));
    }
    draft.bit = first_signal_bit(dialect, draft.spec());
    return draft;
}

void put_record(Draft& draft, const SignalValues& values) {
    const MessageSpec& m = draft.spec();
    for (int i = 0; i < m.signals; ++i) {
        const SignalId id = m.signal[static_cast<std::size_t>(i)];
        const SignalSpec& s = signal_spec(id);
        put_bits(draft.frame.data, draft.bit, s.length, quantise(s, values[static_cast<std::size_t>(id)]).raw);
        draft.bit += s.length;
    }
}

void protect(Draft& draft, std::uint8_t& counter) {
    const auto data_id = static_cast<std::uint16_t>(kE2eFirstDataId + draft.message);
    if (draft.dialect.fd) {
        protect_profile5(draft.frame.data, draft.frame.length, data_id, counter);
        counter = static_cast<std::uint8_t>((counter + 1) % kProfile5Counters);
    } else {
        protect_profile11(draft.frame.data, draft.frame.length, data_id, counter);
        counter = static_cast<std::uint8_t>((counter + 1) % kProfile11Counters);
    }
}

}  // namespace

void CanEncoder::init(const CanConfig& config) {
    config_ = config;
    list_counter_ = 0xFF;  // the first list has 0
    e2e_counter_ = {};
}

Status CanEncoder::encode(const Output& output, std::int64_t now_us, CanList& frames) {
    const DialectSpec& dialect = dialect_spec(config_.dialect);
    ObjectOrder order;
    const int dropped = choose_objects(output, dialect.max_objects, order);
    list_counter_ = static_cast<std::uint8_t>(list_counter_ + 1U);
    frames.clear();
    SignalValues values;
    header_values(output, {list_counter_, order.size(), dropped, now_us}, values);
    bool fits = true;
    for (int m = 0; m < dialect.messages; ++m) {
        std::uint8_t& counter = e2e_counter_[static_cast<std::size_t>(m)];
        if (m < dialect.header_messages) {
            Draft draft = begin_frame(config_, dialect, m, list_counter_, 0);
            put_record(draft, values);
            protect(draft, counter);
            fits = frames.try_push_back(draft.frame) && fits;
            continue;
        }
        const int records = dialect.message[static_cast<std::size_t>(m)].records;
        for (int k = 0; k * records < order.size(); ++k) {
            Draft draft = begin_frame(config_, dialect, m, list_counter_, k);
            for (int slot = k * records; slot < (k + 1) * records; ++slot) {
                if (slot < order.size()) {
                    object_values(output.objects[order[slot]], list_counter_, values);
                } else {
                    values = SignalValues{};  // all ones
                }
                put_record(draft, values);
            }
            protect(draft, counter);
            fits = frames.try_push_back(draft.frame) && fits;
        }
    }
    return dropped > 0 || !fits ? Status::kCapacity : Status::kOk;
}

}  // namespace semtrack
