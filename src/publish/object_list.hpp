// What the object list says: which objects, in which order, and the physical value of every signal. Values are in V of
// the image's time; velocities are over ground.
#ifndef SEMTRACK_PUBLISH_OBJECT_LIST_HPP
#define SEMTRACK_PUBLISH_OBJECT_LIST_HPP

#include <cstdint>

#include "publish/messages.hpp"
#include "publish/signals.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// ObjectId is the track's id modulo this: all ones of 12 bits means that the slot is not used.
inline constexpr std::uint32_t kObjectIds = 4095;

/// Indices into Output::objects, in the order of the list.
using ObjectOrder = StaticVector<std::uint8_t, kMaxObjects>;

/// Nearest and most certain first: by distance divided by the existence probability, then by id. Objects without a
/// finite position are left out. Returns how many were left out.
int choose_objects(const Output& output, int max_objects, ObjectOrder& order);

struct ListFacts {
    std::uint8_t list_counter{0};
    int objects{0};
    int dropped{0};
    std::int64_t now_us{0};  ///< of sending, in the images' time base
};
/// Fills the header's signals; the others are not available.
void header_values(const Output& output, const ListFacts& facts, SignalValues& values);
/// Fills an object's signals, with list_counter as in the header.
void object_values(const TrackedObject& object, std::uint8_t list_counter, SignalValues& values);

}  // namespace semtrack

#endif
