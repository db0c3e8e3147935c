// A CAN or CAN FD data frame.
#ifndef SEMTRACK_CAN_FRAME_HPP
#define SEMTRACK_CAN_FRAME_HPP

#include <array>
#include <cstdint>

namespace semtrack {

struct CanFrame {
    std::uint32_t id{0};               ///< 11 bits, or 29 when `extended`
    bool extended{false};
    bool fd{false};                    ///< CAN FD with bit-rate switch
    std::uint8_t length{0};            ///< bytes: 0..8 classic; 0..8, 12, 16, 20, 24, 32, 48, 64 FD
    std::array<std::uint8_t, 64> data{};
};

/// A length that the format has, and an id within 11 bits (29 when extended).
[[nodiscard]] constexpr bool is_legal(const CanFrame& frame) {
    const int n = frame.length;
    const bool length =
        n <= 8 || (frame.fd && (n == 12 || n == 16 || n == 20 || n == 24 || n == 32 || n == 48 || n == 64));
    return length && frame.id <= (frame.extended ? 0x1FFFFFFFU : 0x7FFU);
}

}  // namespace semtrack

#endif
