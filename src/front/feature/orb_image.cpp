#include "front/feature/orb_image.hpp"

namespace semtrack {

ImageResizer::Tap ImageResizer::tap(int x, int in_size, int size) {
    // Centre of x in the finer image: ((2 x + 1) in_size / size - 1) / 2 px, here in 1/128 px.
    const int position = ((2 * x + 1) * in_size * 64) / size - 64;
    const int clamped = position < 0 ? 0 : position;
    const int at = clamped >> 7;
    return {at < in_size - 1 ? at : in_size - 1, clamped & 127};
}

// Rows first: that loop runs over neighbours and is vectorised; only the columns have to be picked one by one, with one
// multiplication for both: (l + r 2^32) (b + a 2^32) has l a + r b above its low 32 bits, for l b is below 2^32.
void ImageResizer::resize(const ImageView& in, int width, int height, std::uint8_t* out) {
    constexpr std::uint64_t kHalf = std::uint64_t{8192} << 32U;
    for (int x = 0; x < width; ++x) {
        const Tap h = tap(x, in.width, width);
        const auto weight = static_cast<std::uint64_t>(h.weight);
        columns_[static_cast<std::size_t>(x)] = {weight | ((128U - weight) << 32U), h.at};
    }
    const int in_width = in.width;
    std::uint32_t* const blended = blended_.data();
    const Column* const columns = columns_.data();
    for (int y = 0; y < height; ++y) {
        const Tap v = tap(y, in.height, height);
        const std::uint8_t* upper = in.row(v.at);
        const std::uint8_t* lower = in.row(v.at + 1 < in.height ? v.at + 1 : v.at);
        const auto weight = static_cast<std::uint16_t>(v.weight);
        const auto rest = static_cast<std::uint16_t>(128 - v.weight);
        for (int x = 0; x < in_width; ++x) {
            blended[x] = static_cast<std::uint16_t>(upper[x] * rest + lower[x] * weight);
        }
        blended[in_width] = blended[in_width - 1];
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 0; x < width; ++x) {
            const std::uint32_t* pair = blended + columns[x].at;
            const std::uint64_t both = pair[0] | (static_cast<std::uint64_t>(pair[1]) << 32U);
            to[x] = static_cast<std::uint8_t>((both * columns[x].weights + kHalf) >> 46U);
        }
    }
}

}  // namespace semtrack
