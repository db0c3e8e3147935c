// AUTOSAR end-to-end protection (E2E protocol specification), the two profiles that fit our frames:
// Profile 5 for CAN FD (CRC-16, Hamming distance 4 up to 64 bytes) and Profile 11 for 8-byte frames (CRC-8 0x1D).
#ifndef SEMTRACK_PUBLISH_E2E_HPP
#define SEMTRACK_PUBLISH_E2E_HPP

#include <cstdint>

#include "publish/bits.hpp"
#include "semtrack/received.hpp"

namespace semtrack {

/// Data id of message k of a dialect's table is this plus k, whatever its CAN id.
inline constexpr std::uint16_t kE2eFirstDataId = 0x0600;

/// CRC-16 with polynomial 0x1021, start 0xFFFF, not reflected, no final XOR ("IBM-3740"), continued from `crc`.
[[nodiscard]] std::uint16_t crc16_1021(std::uint16_t crc, std::uint8_t byte);
/// CRC-8 with polynomial 0x1D, not reflected, continued from `crc`; Profile 11 starts at 0 and has no final XOR.
[[nodiscard]] std::uint8_t crc8_1d(std::uint8_t crc, std::uint8_t byte);

inline constexpr int kProfile5Bits = 24;  // CRC 16 (little-endian), counter 8
inline constexpr int kProfile5Counters = 256;
/// Writes counter and CRC into bytes 0..2. The CRC covers bytes 2..length-1, then the data id, low byte first.
void protect_profile5(FrameBytes& data, int length, std::uint16_t data_id, std::uint8_t counter);
[[nodiscard]] std::uint16_t profile5_crc(const FrameBytes& data, int length, std::uint16_t data_id);

/// Counter step that is still kOkSomeLost: four full lists of 16 object frames.
inline constexpr int kProfile5MaxDelta = 64;

inline constexpr int kProfile11Bits = 16;      // CRC 8, counter 4, data id nibble 4
inline constexpr int kProfile11Counters = 15;  // 0..14; 15 is not used
/// Writes CRC, counter (low nibble of byte 1) and bits 8..11 of the data id (high nibble). The CRC covers the data
/// id's low byte, a zero, then bytes 1..length-1: the profile's "nibble" mode.
void protect_profile11(FrameBytes& data, int length, std::uint16_t data_id, std::uint8_t counter);
[[nodiscard]] std::uint8_t profile11_crc(const FrameBytes& data, int length, std::uint16_t data_id);
/// Half of the counter: more would leave no room for kWrongSequence.
inline constexpr int kProfile11MaxDelta = 7;

/// Checks CRC, data id and counter of a frame that has the message's length. A wrong CRC leaves `check` untouched.
[[nodiscard]] E2eState check_profile5(const FrameBytes& data, int length, std::uint16_t data_id, E2eCheck& check);
[[nodiscard]] E2eState check_profile11(const FrameBytes& data, int length, std::uint16_t data_id, E2eCheck& check);

}  // namespace semtrack

#endif
