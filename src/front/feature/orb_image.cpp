#include "front/feature/orb_image.hpp"

#include <cstddef>
#include <cstring>

namespace semtrack {

ImageResizer::Tap ImageResizer::tap(int x, int in_size, int size) {
    // Centre of x in the finer image: ((2 x + 1) in_size / size - 1) / 2 px, here in 1/128 px.
    const int position = ((2 * x + 1) * in_size * 64) / size - 64;
    const int clamped = position < 0 ? 0 : position;
    const int at = clamped >> 7;
    return {at < in_size - 1 ? at : in_size - 1, clamped & 127};
}

// Rows first; then the columns have to be picked one by one, each with its neighbour, and are weighted together.
void ImageResizer::resize(const ImageView& in, int width, int height, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) {
        const Tap h = tap(x, in.width, width);
        at_[static_cast<std::size_t>(x)] = h.at;
        weights_[static_cast<std::size_t>(2 * x)] = static_cast<std::int16_t>(128 - h.weight);
        weights_[static_cast<std::size_t>(2 * x + 1)] = static_cast<std::int16_t>(h.weight);
    }
    for (int y = 0; y < height; ++y) {
        const Tap v = tap(y, in.height, height);
        blend_rows(in.row(v.at), in.row(v.at + 1 < in.height ? v.at + 1 : v.at), in.width, v.weight);
        const std::int16_t* const blended = blended_.data();
        const std::int32_t* const at = at_.data();
        std::int16_t* const pairs = pairs_.data();
        for (int x = 0; x < width; ++x) {
            std::memcpy(pairs + 2 * x, blended + at[x], kPairBytes);
        }
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * width;
        int x = 0;
        for (; x + kBlock <= width; x += kBlock) {
            lanes::store(to + x, weighted(x));
        }
        std::uint8_t rest[kBlock];
        lanes::store(rest, weighted(x));
        std::memcpy(to + x, rest, static_cast<std::size_t>(width - x));
    }
}

// Two rows in one, times 128; the last column twice.
void ImageResizer::blend_rows(const std::uint8_t* upper, const std::uint8_t* lower, int width, int weight) {
    std::int16_t* const blended = blended_.data();
    const auto low = static_cast<std::uint16_t>(weight);
    const auto up = static_cast<std::uint16_t>(128 - weight);
    for (int x = 0; x < width; ++x) {
        blended[x] = static_cast<std::int16_t>(static_cast<std::uint16_t>(upper[x] * up + lower[x] * low));
    }
    blended[width] = blended[width - 1];
}

/// Sixteen pixels of the level from x on.
lanes::U8x16 ImageResizer::weighted(int x) const {
    const auto four = [&](int from) {
        lanes::I32x4 sum = lanes::splat32(8192);  // a half
        lanes::add_products(sum, lanes::load16(pairs_.data() + 2 * from), lanes::load16(weights_.data() + 2 * from));
        return lanes::shift_right<14>(sum);
    };
    return lanes::narrow(four(x), four(x + 4), four(x + 8), four(x + 12));
}

}  // namespace semtrack
