#include "front/feature/orb_image.hpp"

#include <cstring>

namespace semtrack {

ImageResizer::Tap ImageResizer::tap(int x, int in_size, int size) {
    // Centre of x in the finer image: ((2 x + 1) in_size / size - 1) / 2 px, here in 1/128 px.
    const int position = ((2 * x + 1) * in_size * 64) / size - 64;
    const int clamped = position < 0 ? 0 : position;
    int at = clamped >> 7;
    at = at < in_size - 1 ? at : in_size - 1;
    Tap t;
    t.at = static_cast<std::int16_t>(at);
    t.next = static_cast<std::int16_t>(at + 1 < in_size ? 1 : 0);
    t.weight = static_cast<std::int16_t>(clamped & 127);
    return t;
}

void ImageResizer::resize(const ImageView& in, int width, int height, std::uint8_t* out) {
    for (int x = 0; x < width; ++x) {
        columns_[static_cast<std::size_t>(x)] = tap(x, in.width, width);
    }
    for (int y = 0; y < height; ++y) {
        const Tap v = tap(y, in.height, height);
        const std::uint8_t* upper = in.row(v.at);
        const std::uint8_t* lower = in.row(v.at + v.next);
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 0; x < width; ++x) {
            const Tap& h = columns_[static_cast<std::size_t>(x)];
            const int i = h.at;
            const int j = h.at + h.next;
            const int left = upper[i] * (128 - v.weight) + lower[i] * v.weight;
            const int right = upper[j] * (128 - v.weight) + lower[j] * v.weight;
            to[x] = static_cast<std::uint8_t>((left * (128 - h.weight) + right * h.weight + 8192) >> 14);
        }
    }
}

void resize_mask(const OwnerMaskView& in, int width, int height, std::uint8_t* out) {
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* from =
            in.data + static_cast<std::ptrdiff_t>(full_position_64(y, in.height, height) >> 6) * in.width;
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * width;
        for (int x = 0; x < width; ++x) {
            to[x] = from[full_position_64(x, in.width, width) >> 6];
        }
    }
}

// Sums stay in 16 bits (255 x 64, then 1020 x 64): twice the lanes.
void ImageSmoother::filter_row(const ImageView& in, int y) {
    const int clamped = y < 0 ? 0 : y < in.height ? y : in.height - 1;
    const std::uint8_t* row = in.row(clamped);
    std::memset(padded_.data(), row[0], 3);
    std::memcpy(padded_.data() + 3, row, static_cast<std::size_t>(in.width));
    std::memset(padded_.data() + 3 + in.width, row[in.width - 1], 3);
    const std::uint8_t* p = padded_.data();
    std::uint16_t* out = rows_[static_cast<std::size_t>((y + kTaps) % kTaps)].data();
    for (int x = 0; x < in.width; ++x) {
        const auto sum = static_cast<std::uint16_t>(p[x] + p[x + 6] + 6 * (p[x + 1] + p[x + 5]) +
                                                    15 * (p[x + 2] + p[x + 4]) + 20 * p[x + 3] + 8);
        out[x] = static_cast<std::uint16_t>(sum >> 4U);
    }
}

void ImageSmoother::smooth(const ImageView& in, std::uint8_t* out) {
    for (int y = -3; y < 3; ++y) {
        filter_row(in, y);
    }
    for (int y = 0; y < in.height; ++y) {
        filter_row(in, y + 3);
        const std::uint16_t* r[kTaps] = {};
        for (int k = 0; k < kTaps; ++k) {
            r[k] = rows_[static_cast<std::size_t>((y - 3 + k + kTaps) % kTaps)].data();
        }
        std::uint8_t* to = out + static_cast<std::ptrdiff_t>(y) * in.width;
        for (int x = 0; x < in.width; ++x) {
            const auto sum = static_cast<std::uint16_t>(r[0][x] + r[6][x] + 6 * (r[1][x] + r[5][x]) +
                                                        15 * (r[2][x] + r[4][x]) + 20 * r[3][x] + 128);
            to[x] = static_cast<std::uint8_t>(sum >> 8U);
        }
    }
}

}  // namespace semtrack
