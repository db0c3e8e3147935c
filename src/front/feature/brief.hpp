// Binary descriptors of 256 bits, upright or turned with the patch, and their distance. Integers only.
#ifndef SEMTRACK_FRONT_FEATURE_BRIEF_HPP
#define SEMTRACK_FRONT_FEATURE_BRIEF_HPP

#include <cstdint>

#include "front/feature/brief_pattern.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

/// Direction (0..kDirections - 1) from the centre of the disc of kBriefRadius_px to its centroid of intensity; 0 when
/// they coincide. The disc must lie inside the image.
[[nodiscard]] int patch_direction(const ImageView& image, int x, int y);

/// Comparisons around (x, y) in the smoothed image, the pattern turned to a direction (0: upright). The disc of
/// kBriefRadius_px must lie inside the image.
void describe(const ImageView& smoothed, int x, int y, int turned_to, Descriptor& out);

/// Bits that differ, 0..256.
[[nodiscard]] inline int hamming(const Descriptor& a, const Descriptor& b) {
    std::uint64_t bytes = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint64_t low = a[2 * k] ^ b[2 * k];
        const std::uint64_t high = a[2 * k + 1] ^ b[2 * k + 1];
        std::uint64_t x = low | (high << 32U);
        x -= (x >> 1U) & 0x5555555555555555ULL;
        x = (x & 0x3333333333333333ULL) + ((x >> 2U) & 0x3333333333333333ULL);
        bytes += (x + (x >> 4U)) & 0x0F0F0F0F0F0F0F0FULL;  // a byte holds at most 32 after four words
    }
    bytes = (bytes & 0x00FF00FF00FF00FFULL) + ((bytes >> 8U) & 0x00FF00FF00FF00FFULL);  // 256 needs nine bits
    return static_cast<int>((bytes * 0x0001000100010001ULL) >> 48U);
}

}  // namespace semtrack

#endif
