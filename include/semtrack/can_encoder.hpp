// Output -> object list on CAN. The layout is one table (src/publish), docs/can/*.dbc say the same.
#ifndef SEMTRACK_CAN_ENCODER_HPP
#define SEMTRACK_CAN_ENCODER_HPP

#include <array>
#include <cstdint>

#include "semtrack/can_frame.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

enum class CanDialect : std::uint8_t {
    kFd = 0,  ///< CAN FD, 64-byte frames, two objects a frame, E2E Profile 5
    kClassic  ///< 8-byte frames, several an object, E2E Profile 11
};

struct CanConfig {
    CanDialect dialect{CanDialect::kFd};
    std::uint32_t base_id{0x600};  ///< of the header message; the others follow
    bool extended{false};          ///< 29-bit ids
};

/// A header and, in the larger dialect, eight frames for each of 32 objects.
inline constexpr int kMaxCanFrames = 4 + 8 * kMaxObjects;
using CanList = StaticVector<CanFrame, kMaxCanFrames>;

class CanEncoder {
public:
    void init(const CanConfig& config);
    /// Appends nothing to an old list: `frames` is cleared first. now_us: time of sending in the images' time base
    /// (the header holds the image's age). kCapacity: objects were left out, nearest and most certain first; the
    /// header counts them and the frames are complete all the same.
    Status encode(const Output& output, std::int64_t now_us, CanList& frames);
    /// Of the last list.
    [[nodiscard]] std::uint8_t list_counter() const { return list_counter_; }

private:
    CanConfig config_{};
    std::uint8_t list_counter_{0};
    std::array<std::uint8_t, 16> e2e_counter_{};  // per message of the table
};

}  // namespace semtrack

#endif
