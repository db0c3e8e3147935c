// What every receiver of CAN frames hands out: the result of the end-to-end check, and values that may be missing.
#ifndef SEMTRACK_RECEIVED_HPP
#define SEMTRACK_RECEIVED_HPP

#include <cstdint>

namespace semtrack {

/// Result of the end-to-end check of one frame, as AUTOSAR names them. Only kOk and kOkSomeLost carry usable data.
enum class E2eState : std::uint8_t {
    kOk = 0,         ///< the frame after the last one, or the first one after init or a time-out
    kOkSomeLost,     ///< counter 2 to 64 (Profile 5) or 2 to 7 (Profile 11) further: frames of this message are missing
    kRepeated,       ///< counter as in the last one
    kWrongSequence,  ///< counter further than that, or backwards; the next frame is compared with this one
    kError,          ///< CRC, length, frame format or data id
    kNoNewData       ///< not a frame of this message; nothing was checked
};
inline constexpr int kE2eStates = 6;

/// The receiver's memory of one message's counter.
struct E2eCheck {
    bool started{false};
    std::uint8_t counter{0};  ///< of the last frame whose CRC was right
};

[[nodiscard]] constexpr bool usable(E2eState state) {
    return state == E2eState::kOk || state == E2eState::kOkSomeLost;
}

/// A value in physical units. Not valid: sent as "not available" (or a code that this version does not know); value is
/// then T{} and says nothing. Saturated: the true value lies outside the signal's range, value is the end of it (also
/// said of a value that is exactly the end while another one of the same record is outside).
template <class T>
struct Received {
    T value{};
    bool valid{false};
    bool saturated{false};
};

}  // namespace semtrack

#endif
