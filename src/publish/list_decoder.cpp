#include "publish/list_decoder.hpp"

namespace semtrack {

namespace {

using S = SignalId;
using RawValues = std::array<std::uint64_t, static_cast<std::size_t>(kSignals)>;

template <class Record>
struct RealMember {
    SignalId id;
    Received<double> Record::*member;
};

constexpr std::array<RealMember<ReceivedObject>, 18> kObjectReals{{
    {S::kExistence, &ReceivedObject::existence},
    {S::kAge, &ReceivedObject::age},
    {S::kPositionX, &ReceivedObject::x},
    {S::kPositionY, &ReceivedObject::y},
    {S::kPositionZ, &ReceivedObject::z},
    {S::kVelocityX, &ReceivedObject::velocity_x},
    {S::kVelocityY, &ReceivedObject::velocity_y},
    {S::kYaw, &ReceivedObject::yaw},
    {S::kYawRate, &ReceivedObject::yaw_rate},
    {S::kLength, &ReceivedObject::length},
    {S::kWidth, &ReceivedObject::width},
    {S::kHeight, &ReceivedObject::height},
    {S::kSigmaX, &ReceivedObject::sigma_x},
    {S::kSigmaY, &ReceivedObject::sigma_y},
    {S::kSigmaZ, &ReceivedObject::sigma_z},
    {S::kSigmaVelocityX, &ReceivedObject::sigma_velocity_x},
    {S::kSigmaVelocityY, &ReceivedObject::sigma_velocity_y},
    {S::kSigmaYaw, &ReceivedObject::sigma_yaw},
}};

constexpr std::array<RealMember<ReceivedList>, 5> kHeaderReals{{
    {S::kObjectsDropped, &ReceivedList::objects_dropped},
    {S::kEgoSpeed, &ReceivedList::ego_speed},
    {S::kEgoYawRate, &ReceivedList::ego_yaw_rate},
    {S::kSigmaEgoSpeed, &ReceivedList::sigma_ego_speed},
    {S::kSigmaEgoYawRate, &ReceivedList::sigma_ego_yaw_rate},
}};

[[nodiscard]] std::uint64_t raw_of(const RawValues& raws, SignalId id) {
    return raws[static_cast<std::size_t>(id)];
}

/// saturated: the record's flag. The value that left its range stands at an end of it.
[[nodiscard]] Received<double> real(const RawValues& raws, SignalId id, bool saturated) {
    const SignalSpec& s = signal_spec(id);
    const std::uint64_t raw = raw_of(raws, id);
    if (raw > max_raw(s)) {
        return {};
    }
    return {physical(s, raw), true, saturated && (raw == 0U || raw == max_raw(s))};
}

/// How many codes a value table names; they start at 0 without gaps.
[[nodiscard]] std::uint64_t codes_of(const SignalSpec& s) {
    constexpr int kLongestTable = 128;
    std::uint64_t codes = 1;
    for (int i = 0; i < kLongestTable && s.values[i] != '\0'; ++i) {
        codes += s.values[i] == ';' ? 1U : 0U;
    }
    return codes;
}

template <class Code>
[[nodiscard]] Received<Code> code(const RawValues& raws, SignalId id) {
    const std::uint64_t raw = raw_of(raws, id);
    if (raw >= codes_of(signal_spec(id))) {
        return {};
    }
    return {static_cast<Code>(raw), true, false};
}

[[nodiscard]] Received<bool> flag(const RawValues& raws, SignalId id) {
    const std::uint64_t raw = raw_of(raws, id);
    return {raw == 1U, raw <= 1U, false};
}

/// Reads one record (or the header message) of a frame into raws.
void read_record(const DialectSpec& dialect, const MessageSpec& m, const std::uint8_t* bytes, int record,
                 RawValues& raws) {
    FrameBytes data{};
    for (std::size_t i = 0; i < m.length; ++i) {
        data[i] = bytes[i];
    }
    int bit = first_signal_bit(dialect, m) + record * record_bits(m);
    for (int i = 0; i < m.signals; ++i) {
        const SignalId id = m.signal[static_cast<std::size_t>(i)];
        const int length = signal_spec(id).length;
        raws[static_cast<std::size_t>(id)] = get_bits(data, bit, length);
        bit += length;
    }
}

/// All signals of one slot, from each of the object messages.
void read_slot(const DialectSpec& dialect, const std::uint8_t* bytes, int objects, int slot, RawValues& raws) {
    std::size_t offset = 0;
    for (int k = 0; k < dialect.messages; ++k) {
        const MessageSpec& m = dialect.message[static_cast<std::size_t>(k)];
        if (k < dialect.header_messages) {
            offset += m.length;
            continue;
        }
        const auto frame = static_cast<std::size_t>(slot / m.records);
        read_record(dialect, m, bytes + offset + frame * m.length, slot % m.records, raws);
        offset += static_cast<std::size_t>(frames_of(m, objects)) * m.length;
    }
}

[[nodiscard]] bool slot_is_used(const RawValues& raws) {
    return raw_of(raws, S::kObjectId) <= max_raw(signal_spec(S::kObjectId));
}

/// As many objects as the count says, and none behind them.
[[nodiscard]] bool slots_agree(const DialectSpec& dialect, const std::uint8_t* bytes, int objects) {
    const int records = dialect.message[static_cast<std::size_t>(dialect.header_messages)].records;
    const int slots = frames_of(dialect.message[static_cast<std::size_t>(dialect.header_messages)], objects) * records;
    RawValues raws{};
    for (int slot = 0; slot < slots; ++slot) {
        read_slot(dialect, bytes, objects, slot, raws);
        if (slot_is_used(raws) != (slot < objects)) {
            return false;
        }
    }
    return true;
}

void decode_object(const RawValues& raws, ReceivedObject& o) {
    o = ReceivedObject{};
    o.id = static_cast<std::uint16_t>(raw_of(raws, S::kObjectId));
    o.saturated = raw_of(raws, S::kSaturated) != 0U;
    for (const auto& entry : kObjectReals) {
        o.*entry.member = real(raws, entry.id, o.saturated);
    }
    o.object_class = code<ObjectClass>(raws, S::kClass);
    o.status = code<TrackStatus>(raws, S::kStatus);
    o.movement = code<MovementState>(raws, S::kMovement);
    o.truncated = flag(raws, S::kTruncated);
    o.occlusion = code<std::uint8_t>(raws, S::kOcclusion);
    o.reference_point = code<ReferencePoint>(raws, S::kReferencePoint);
}

void decode_header(const RawValues& raws, ReceivedList& list) {
    list.saturated = raw_of(raws, S::kHeaderSaturated) != 0U;
    for (const auto& entry : kHeaderReals) {
        list.*entry.member = real(raws, entry.id, list.saturated);
    }
    const Received<double> age_ms = real(raws, S::kImageAge, list.saturated);
    list.age_us = {static_cast<std::int64_t>(age_ms.value * 1000.0 + 0.5), age_ms.valid, age_ms.saturated};
    list.ego_status = code<EgoStatus>(raws, S::kEgoStatus);
    list.ego_degraded = flag(raws, S::kEgoDegraded);
    list.no_right_image = flag(raws, S::kNoRightImage);
    list.no_detections = flag(raws, S::kNoDetections);
    list.road_not_plane = flag(raws, S::kRoadNotPlane);
    list.frames_dropped = static_cast<std::uint16_t>(raw_of(raws, S::kFramesDropped));
}

}  // namespace

int frames_of(const MessageSpec& message, int objects) {
    return (objects + message.records - 1) / message.records;
}

int list_frames(const DialectSpec& dialect, int objects) {
    int frames = dialect.header_messages;
    for (int k = dialect.header_messages; k < dialect.messages; ++k) {
        frames += frames_of(dialect.message[static_cast<std::size_t>(k)], objects);
    }
    return frames;
}

bool decode_list(const DialectSpec& dialect, const std::uint8_t* bytes, int objects, ReceivedList& list,
                 std::uint64_t& raw_time) {
    if (!slots_agree(dialect, bytes, objects)) {
        return false;
    }
    RawValues raws{};
    std::size_t offset = 0;
    for (int k = 0; k < dialect.header_messages; ++k) {
        const MessageSpec& m = dialect.message[static_cast<std::size_t>(k)];
        read_record(dialect, m, bytes + offset, 0, raws);
        offset += m.length;
    }
    decode_header(raws, list);
    raw_time = raw_of(raws, S::kImageTime);
    list.objects.clear();
    ReceivedObject object;
    for (int slot = 0; slot < objects; ++slot) {
        read_slot(dialect, bytes, objects, slot, raws);
        decode_object(raws, object);
        (void)list.objects.try_push_back(object);  // objects <= dialect.max_objects <= kMaxObjects
    }
    return true;
}

}  // namespace semtrack
