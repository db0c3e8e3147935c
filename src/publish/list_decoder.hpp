// Bytes of a whole list -> physical values, by the table.
#ifndef SEMTRACK_PUBLISH_LIST_DECODER_HPP
#define SEMTRACK_PUBLISH_LIST_DECODER_HPP

#include <cstdint>

#include "publish/messages.hpp"
#include "semtrack/can_receiver.hpp"

namespace semtrack {

/// Frames of one object message in a list.
[[nodiscard]] int frames_of(const MessageSpec& message, int objects);
/// Frames of a whole list.
[[nodiscard]] int list_frames(const DialectSpec& dialect, int objects);

/// `bytes`: the data of all frames of the list, one behind the other in the order of sending. Everything of `list` is
/// written but image_time_us, received_us and taken_us, for which raw_time is the header's ImageTime. False, and the
/// list untouched: an object has no id, or a slot behind the last object has one.
[[nodiscard]] bool decode_list(const DialectSpec& dialect, const std::uint8_t* bytes, int objects, ReceivedList& list,
                               std::uint64_t& raw_time);

}  // namespace semtrack

#endif
