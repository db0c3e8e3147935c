// Which signals a frame of each dialect carries, and where. A frame is: protection (e2e.hpp), ListCounter, in object
// messages the index of the frame's first record, then the message's signals one after the other.
#ifndef SEMTRACK_PUBLISH_MESSAGES_HPP
#define SEMTRACK_PUBLISH_MESSAGES_HPP

#include <cstdint>

#include "publish/signals.hpp"
#include "semtrack/can_encoder.hpp"

namespace semtrack {

inline constexpr std::uint8_t kProtocolVersion = 1;
inline constexpr int kMaxMessageSignals = 26;
inline constexpr int kMaxMessages = 11;
inline constexpr int kRecordIndexBits = 4;

struct MessageSpec {
    const char* name;
    std::uint8_t length;   ///< bytes
    std::uint8_t records;  ///< objects in one frame; 0: a message of the header, one a list
    std::uint8_t signals;
    std::array<SignalId, static_cast<std::size_t>(kMaxMessageSignals)> signal;
    const char* comment;
};

/// Message k has the CAN id base_id + k and the E2E data id kE2eFirstDataId + k. Those of the header come first.
struct DialectSpec {
    const char* name;
    bool fd;
    std::uint8_t messages;
    std::uint8_t header_messages;
    std::uint8_t max_objects;
    const char* index_name;  ///< of the record index: frame k starts with record k * records
    std::array<MessageSpec, static_cast<std::size_t>(kMaxMessages)> message;
    MessageSpec vehicle_motion;  ///< received by semtrack: message number `messages`; signals follow the protection
};

[[nodiscard]] const DialectSpec& dialect_spec(CanDialect dialect);

/// First bits of a frame's parts: behind the protection, ...
[[nodiscard]] int protection_bits(const DialectSpec& dialect);
[[nodiscard]] int list_counter_bit(const DialectSpec& dialect);
[[nodiscard]] int record_index_bit(const DialectSpec& dialect);
[[nodiscard]] int first_signal_bit(const DialectSpec& dialect, const MessageSpec& message);
/// All signals of one record (of the whole message for one of the header).
[[nodiscard]] int record_bits(const MessageSpec& message);

}  // namespace semtrack

#endif
