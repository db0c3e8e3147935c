#include "front/match/patch_image.hpp"

#include <cstring>

namespace semtrack {

namespace {
constexpr int kReach = 4;  // 9x9 mean
constexpr int kArea = (2 * kReach + 1) * (2 * kReach + 1);
constexpr int kReciprocal = (1 << 16) / kArea;  // division by a multiplication, exact to one level

int clamped(int x, int high) {
    return x < 0 ? 0 : x > high ? high : x;
}
}  // namespace

void PatchImage::build(const ImageView& image) {
    width_ = image.width / 2;
    height_ = image.height / 2;
    for (int y = 0; y < height_; ++y) {
        const std::uint8_t* a = image.row(2 * y);
        const std::uint8_t* b = image.row(2 * y + 1);
        std::uint8_t* out = half_.data() + y * kHalfWidth;
        for (int x = 0; x < width_; ++x) {
            out[x] = static_cast<std::uint8_t>((a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) >> 2);
        }
    }
    // Running sums: columns over 9 rows (borders repeated), then along the row.
    for (int x = 0; x < width_; ++x) {
        int sum = 0;
        for (int r = -kReach - 1; r < kReach; ++r) {
            sum += half_[static_cast<std::size_t>(clamped(r, height_ - 1) * kHalfWidth + x)];
        }
        column_[static_cast<std::size_t>(x)] = static_cast<std::uint16_t>(sum);
    }
    for (int y = 0; y < height_; ++y) {
        const std::uint8_t* enter = half_.data() + clamped(y + kReach, height_ - 1) * kHalfWidth;
        const std::uint8_t* leave = half_.data() + clamped(y - kReach - 1, height_ - 1) * kHalfWidth;
        for (int x = 0; x < width_; ++x) {
            column_[static_cast<std::size_t>(x)] =
                static_cast<std::uint16_t>(column_[static_cast<std::size_t>(x)] + enter[x] - leave[x]);
        }
        int sum = 0;
        for (int c = -kReach - 1; c < kReach; ++c) {
            sum += column_[static_cast<std::size_t>(clamped(c, width_ - 1))];
        }
        const std::uint8_t* in = half_.data() + y * kHalfWidth;
        std::uint8_t* out = flat_.data() + y * kHalfWidth;
        for (int x = 0; x < width_; ++x) {
            sum += column_[static_cast<std::size_t>(clamped(x + kReach, width_ - 1))];
            sum -= column_[static_cast<std::size_t>(clamped(x - kReach - 1, width_ - 1))];
            const int mean = (sum * kReciprocal) >> 16;
            out[x] = static_cast<std::uint8_t>(clamped(in[x] - mean + 128, 255));
        }
    }
}

void copy_coarse(const PatchImage& image, int x, int y, CoarsePatch& out) {
    for (int r = 0; r < kCoarse; ++r) {
        std::memcpy(out.data() + static_cast<std::ptrdiff_t>(r) * kCoarse, image.row(y + r) + x, kCoarse);
    }
}

int coarse_distance(const CoarsePatch& patch, const PatchImage& image, int x, int y) {
    int sum = 0;
    for (int r = 0; r < kCoarse; ++r) {
        const std::uint8_t* a = patch.data() + static_cast<std::ptrdiff_t>(r) * kCoarse;
        const std::uint8_t* b = image.row(y + r) + x;
        for (int c = 0; c < kCoarse; ++c) {
            const int d = a[c] - b[c];
            sum += d < 0 ? -d : d;
        }
    }
    return sum;
}

}  // namespace semtrack
