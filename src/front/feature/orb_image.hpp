// Levels of the pyramid, rendered one from the other. Integers only.
#ifndef SEMTRACK_FRONT_FEATURE_ORB_IMAGE_HPP
#define SEMTRACK_FRONT_FEATURE_ORB_IMAGE_HPP

#include <array>
#include <cstdint>

#include "math/lanes.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

inline constexpr int kMaxPyramidLevels = 8;

/// Size of a level: rounded size / 1.2^level.
[[nodiscard]] constexpr int level_size(int full_size, int level) {
    std::int64_t numerator = full_size;
    std::int64_t denominator = 1;
    for (int k = 0; k < level; ++k) {
        numerator *= 5;
        denominator *= 6;
    }
    return static_cast<int>((2 * numerator + denominator) / (2 * denominator));
}

/// Centre of pixel x of a level, in full resolution and 1/64 px, counted from the image's border (so >> 6 is the pixel
/// it falls into; minus 32 it counts from the first pixel's centre).
[[nodiscard]] constexpr int full_position_64(int x, int full_size, int size) {
    return (64 * (2 * x + 1) * full_size) / (2 * size);
}

/// Bilinear, weights of 1/128, for steps between 1 and 2.
class ImageResizer {
public:
    /// out has room for width x height and is written row by row with stride `width`. Cost O(width x height).
    void resize(const ImageView& in, int width, int height, std::uint8_t* out);

private:
    struct Tap {
        std::int32_t at{0};      ///< left or upper of the two
        std::int32_t weight{0};  ///< of the other, 1/128
    };
    static constexpr int kBlock = 16;
    static constexpr std::size_t kPairBytes = 2 * sizeof(std::int16_t);
    static constexpr std::size_t kPairs = 2 * (static_cast<std::size_t>(kMaxImageWidth) + kBlock);
    [[nodiscard]] static Tap tap(int x, int in_size, int size);
    void blend_rows(const std::uint8_t* upper, const std::uint8_t* lower, int width, int weight);
    [[nodiscard]] lanes::U8x16 weighted(int x) const;

    std::array<std::int32_t, static_cast<std::size_t>(kMaxImageWidth)> at_{};           // left of the two columns
    std::array<std::int16_t, kPairs> weights_{};                                        // left, right, 1/128
    std::array<std::int16_t, kPairs> pairs_{};                                          // left, right, of blended_
    std::array<std::int16_t, static_cast<std::size_t>(kMaxImageWidth) + 1> blended_{};  // two rows in one, x 128
};

}  // namespace semtrack

#endif
