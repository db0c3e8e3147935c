// Binary descriptors of 256 bits, upright or turned with the patch, and their distance. Integers only.
#ifndef SEMTRACK_FRONT_FEATURE_BRIEF_HPP
#define SEMTRACK_FRONT_FEATURE_BRIEF_HPP

#include <array>
#include <cstdint>

#include "front/feature/brief_pattern.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

/// Direction (0..kDirections - 1) from the centre of the disc of kBriefRadius_px to its centroid of intensity; 0 when
/// they coincide. The columns x - 16 .. x + 15 and rows y - 15 .. y + 15 must lie inside the image.
[[nodiscard]] int patch_direction(const ImageView& image, int x, int y);

/// The smoothed image around one corner. Corners are few: smoothing their surroundings costs a third of smoothing every
/// level, and the patch stays in the nearest cache. Its fixed stride makes each sample's place a constant.
class BriefPatch {
public:
    static constexpr int kColumns = 32;  ///< x - 16 .. x + 15: whole vectors of bytes
    static constexpr int kRows = 2 * kBriefReach_px + 1;
    static constexpr int kCentreColumn = kColumns / 2;

    /// Binomial filter of 7 x 7 (sigma 1.2 px), the image's border replicated. (x, y) must lie inside the image.
    void smooth(const ImageView& image, int x, int y);
    /// Smoothed pixel at (x + dx, y + dy), -16 <= dx < 16, |dy| <= kBriefReach_px.
    [[nodiscard]] std::uint8_t at(int dx, int dy) const { return pixels_[index(dx, dy)]; }
    [[nodiscard]] static constexpr std::size_t index(int dx, int dy) {
        return static_cast<std::size_t>((dy + kBriefReach_px) * kColumns + dx + kCentreColumn);
    }
    /// Comparisons around the centre, the pattern turned to a direction (0: upright).
    void describe(int turned_to, Descriptor& out) const;

private:
    std::array<std::uint8_t, static_cast<std::size_t>(kColumns) * kRows> pixels_{};
};

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
