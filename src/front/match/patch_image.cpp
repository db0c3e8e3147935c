#include "front/match/patch_image.hpp"

#include <cstring>

namespace semtrack {

namespace {
constexpr int kReach = 4;  // 9x9 mean
constexpr int kArea = (2 * kReach + 1) * (2 * kReach + 1);
constexpr int kReciprocal = (1 << 16) / kArea;  // division by a multiplication, exact to one level
constexpr int kLanes = 8;

int clamped(int x, int high) {
    return x < 0 ? 0 : x > high ? high : x;
}
}  // namespace

void PatchImage::halve(const ImageView& image) {
    const lanes::I16x8 half = lanes::splat16(2);
    for (int y = 0; y < height_; ++y) {
        const std::uint8_t* a = image.row(2 * y);
        const std::uint8_t* b = image.row(2 * y + 1);
        std::uint8_t* out = half_.data() + y * kHalfWidth;
        for (int i = 0; i < width_; i += kLanes) {
            const int x = i + kLanes <= width_ ? i : width_ - kLanes;  // the last eight overlap those before
            const lanes::U8x16 upper = lanes::load(a + 2 * x);
            const lanes::U8x16 lower = lanes::load(b + 2 * x);
            const lanes::I16x8 sum = lanes::add(lanes::add(lanes::widen_even(upper), lanes::widen_odd(upper)),
                                                lanes::add(lanes::widen_even(lower), lanes::widen_odd(lower)));
            const lanes::I16x8 mean = lanes::shift_right<2>(lanes::add(sum, half));
            lanes::store_low(out + x, lanes::narrow(mean, mean));
        }
    }
}

void PatchImage::flatten_row(int y) {
    std::int16_t* column = column_.data() + kReach;
    for (int k = 1; k <= kReach; ++k) {
        column[-k] = column[0];
        column[width_ - 1 + k] = column[width_ - 1];
    }
    const lanes::I16x8 reciprocal = lanes::splat16(kReciprocal);
    const lanes::I16x8 middle = lanes::splat16(128);
    const std::uint8_t* in = half_.data() + y * kHalfWidth;
    std::uint8_t* out = flat_.data() + y * kHalfWidth;
    for (int i = 0; i < width_; i += kLanes) {
        const int x = i + kLanes <= width_ ? i : width_ - kLanes;
        lanes::I16x8 sum = lanes::load16(column + x - kReach);
        for (int k = 1 - kReach; k <= kReach; ++k) {
            sum = lanes::add(sum, lanes::load16(column + x + k));
        }
        const lanes::I16x8 here = lanes::widen_low(lanes::load_halves(in + x, in + x));
        const lanes::I16x8 flat = lanes::add(lanes::sub(here, lanes::mul_high(sum, reciprocal)), middle);
        lanes::store_low(out + x, lanes::narrow(flat, flat));
    }
}

void PatchImage::build(const ImageView& image) {
    width_ = image.width / 2;
    height_ = image.height / 2;
    halve(image);
    std::int16_t* column = column_.data() + kReach;
    for (int x = 0; x < width_; ++x) {
        int sum = 0;
        for (int r = -kReach - 1; r < kReach; ++r) {
            sum += half_[static_cast<std::size_t>(clamped(r, height_ - 1) * kHalfWidth + x)];
        }
        column[x] = static_cast<std::int16_t>(sum);
    }
    for (int y = 0; y < height_; ++y) {  // running sums: a row enters, a row leaves
        const std::uint8_t* enter = half_.data() + clamped(y + kReach, height_ - 1) * kHalfWidth;
        const std::uint8_t* leave = half_.data() + clamped(y - kReach - 1, height_ - 1) * kHalfWidth;
        for (int x = 0; x < width_; ++x) {
            column[x] = static_cast<std::int16_t>(column[x] + enter[x] - leave[x]);
        }
        flatten_row(y);
    }
}

CoarseRows::CoarseRows(float shift_per_row) {
    constexpr int kMiddle = kCoarse / 2 - 1;  // the row of the feature
    for (int r = 0; r < kCoarse; ++r) {
        const float exact = shift_per_row * static_cast<float>(r - kMiddle);
        int shift = static_cast<int>(exact < 0.0F ? exact - 0.5F : exact + 0.5F);
        shift = shift < -kLargestShift ? -kLargestShift : shift > kLargestShift ? kLargestShift : shift;
        offset_[static_cast<std::size_t>(r)] = static_cast<std::ptrdiff_t>(r) * PatchImage::kHalfWidth + shift;
        margin_ = shift > margin_ ? shift : -shift > margin_ ? -shift : margin_;
    }
}

void copy_coarse(const PatchImage& image, int x, int y, const CoarseRows& rows, CoarsePatch& out) {
    for (int r = 0; r < kCoarse; ++r) {
        std::memcpy(out.data() + static_cast<std::ptrdiff_t>(r) * kCoarse, image.row(y) + x + rows.offset(r), kCoarse);
    }
}

}  // namespace semtrack
