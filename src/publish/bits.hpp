// Signals in the bytes of a frame: little-endian (Intel) bit order, as DBC's `@1` says it.
#ifndef SEMTRACK_PUBLISH_BITS_HPP
#define SEMTRACK_PUBLISH_BITS_HPP

#include <array>
#include <cstdint>

namespace semtrack {

using FrameBytes = std::array<std::uint8_t, 64>;

/// Highest raw value of a signal of 1..48 bits; on the bus it means "not available" where a signal can be missing.
[[nodiscard]] constexpr std::uint64_t all_ones(int length) {
    return (std::uint64_t{1} << static_cast<unsigned>(length)) - 1U;
}

/// start + length <= 512.
inline void put_bits(FrameBytes& data, int start, int length, std::uint64_t raw) {
    for (int i = 0; i < length; ++i) {
        const auto bit = static_cast<unsigned>(start + i);
        const auto mask = static_cast<std::uint8_t>(1U << (bit % 8U));
        const bool set = ((raw >> static_cast<unsigned>(i)) & 1U) != 0U;
        std::uint8_t& byte = data[bit / 8U];
        byte = static_cast<std::uint8_t>(set ? byte | mask : byte & ~mask);
    }
}

[[nodiscard]] inline std::uint64_t get_bits(const FrameBytes& data, int start, int length) {
    std::uint64_t raw = 0;
    for (int i = 0; i < length; ++i) {
        const auto bit = static_cast<unsigned>(start + i);
        const std::uint64_t set = (static_cast<unsigned>(data[bit / 8U]) >> (bit % 8U)) & 1U;
        raw |= set << static_cast<unsigned>(i);
    }
    return raw;
}

}  // namespace semtrack

#endif
