#include "front/feature/orb_image.hpp"

namespace semtrack {

ImageResizer::Tap ImageResizer::tap(int x, int in_size, int size) {
    // Centre of x in the finer image: ((2 x + 1) in_size / size - 1) / 2 px, here in 1/128 px.
    const int position = ((2 * x + 1) * in_size * 64) / size - 64;
    const int clamped = position < 0 ? 0 : position;
    const int at = clamped >> 7;
    Tap t;
    t.at = static_cast<std::int16_t>(at < in_size - 1 ? at : in_size - 1);
    t.weight = static_cast<std::int16_t>(clamped & 127);
    return t;
}

// Rows first: that loop runs over neighbours and is vectorised; only the columns have to be picked one by one.
void ImageResizer::resize(const ImageView& in, int width, int height, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) {
        columns_[static_cast<std::size_t>(x)] = tap(x, in.width, width);
    }
    std::uint16_t* const blended = blended_.data();
    const Tap* const columns = columns_.data();
    for (int y = 0; y < height; ++y) {
        const Tap v = tap(y, in.height, height);
        const std::uint8_t* upper = in.row(v.at);
        const std::uint8_t* lower = in.row(v.at + 1 < in.height ? v.at + 1 : v.at);
        const auto weight = static_cast<std::uint16_t>(v.weight);
        const auto rest = static_cast<std::uint16_t>(128 - v.weight);
        for (int x = 0; x < in.width; ++x) {
            blended[x] = static_cast<std::uint16_t>(upper[x] * rest + lower[x] * weight);
        }
        blended[in.width] = blended[in.width - 1];
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 0; x < width; ++x) {
            const Tap& h = columns[x];
            const std::int32_t left = blended[h.at];
            const std::int32_t right = blended[h.at + 1];
            to[x] = static_cast<std::uint8_t>((128 * left + (right - left) * h.weight + 8192) >> 14);
        }
    }
}

}  // namespace semtrack
