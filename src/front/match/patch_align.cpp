#include "front/match/patch_align.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "math/lanes.hpp"

namespace semtrack {

namespace {

using lanes::I16x8;
using lanes::I32x4;

constexpr int kIterations = 12;
constexpr float kSettled_px = 0.01F;
constexpr double kMinTexture = 300.0 * 1024.0;  // sum of squared gradients, 300 grey^2: below, noise decides
constexpr double kMinSquare = 256.0;            // one grey level^2
constexpr double kMinContrast = 0.2;            // of the image over the template's: below, it is something else
constexpr std::int16_t kMiddle = 128 * 16;
constexpr double kPixels = static_cast<double>(kPatchRows) * kPatchRows;
constexpr int kGrid = 128;  // steps of the interpolation per px
constexpr std::int16_t kColumnMask[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0};

int floor_int(float x) {
    const int i = static_cast<int>(x);
    return x < static_cast<float>(i) ? i - 1 : i;
}

int clamped(int x, int high) {
    return x < 0 ? 0 : x > high ? high : x;
}

/// Sixteen pixels.
struct Row {
    I16x8 low;
    I16x8 high;
};

/// Lagrange's interpolation through kTaps pixels, the middle two around the place: weights in 1/128 for every step of
/// the grid. A straight line between two pixels moves structures of 4 px by up to 0.045 px, and with them the
/// disparity; four taps by 0.018, six by 0.008 (of 8 px: 0.010, 0.001, 0.000).
template <int kTaps>
using TapWeights = std::array<std::int16_t, static_cast<std::size_t>(kTaps)>;
template <int kTaps>
constexpr std::array<TapWeights<kTaps>, static_cast<std::size_t>(kGrid)> tap_table() {
    std::array<TapWeights<kTaps>, static_cast<std::size_t>(kGrid)> out{};
    constexpr int kLeft = kTaps / 2 - 1;  // pixels before the left one of the middle
    for (int part = 0; part < kGrid; ++part) {
        TapWeights<kTaps>& w = out[static_cast<std::size_t>(part)];
        const double at = kLeft + static_cast<double>(part) / kGrid;
        int rest = kGrid;
        for (int k = 0; k < kTaps; ++k) {
            double weight = kGrid;
            for (int j = 0; j < kTaps; ++j) {
                weight *= j == k ? 1.0 : (at - j) / (k - j);
            }
            const int rounded = static_cast<int>(weight < 0.0 ? weight - 0.5 : weight + 0.5);
            w[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(rounded);
            rest -= rounded;
        }
        const auto nearest = static_cast<std::size_t>(2 * part < kGrid ? kLeft : kLeft + 1);
        w[nearest] = static_cast<std::int16_t>(w[nearest] + rest);  // the sum is 1
    }
    return out;
}
template <int kTaps>
struct Taps {
    std::array<I16x8, static_cast<std::size_t>(kTaps)> weight;
    explicit Taps(int part) {
        static constexpr auto kTable = tap_table<kTaps>();
        for (std::size_t k = 0; k < weight.size(); ++k) {
            weight[k] = lanes::splat16(kTable[static_cast<std::size_t>(part)][k]);
        }
    }
};

/// Sixteen pixels from p on, moved by the taps, about the middle grey, in 1/128 grey level.
template <int kTaps>
Row along(const std::uint8_t* p, const Taps<kTaps>& taps) {
    Row out{lanes::splat16(0), lanes::splat16(0)};
    const I16x8 middle = lanes::splat16(kMiddle / 16);
    p -= kTaps / 2 - 1;
    for (std::size_t k = 0; k < taps.weight.size(); ++k) {
        const lanes::U8x16 a = lanes::load(p + k);
        const I16x8& w = taps.weight[k];
        out.low = lanes::add(out.low, lanes::mul(lanes::sub(lanes::widen_low(a), middle), w));
        out.high = lanes::add(out.high, lanes::mul(lanes::sub(lanes::widen_high(a), middle), w));
    }
    return out;
}

/// Weights of two rows for values in 1/16 grey level.
struct RowWeights {
    I16x8 upper;
    I16x8 lower;
    explicit RowWeights(int ay)
        : upper(lanes::splat16(static_cast<std::int16_t>((kGrid - ay) * 64))),
          lower(lanes::splat16(static_cast<std::int16_t>(ay * 64))) {}
};

Row between(const Row& upper, const Row& lower, const RowWeights& w) {
    return {lanes::add(lanes::mul_high(upper.low, w.upper), lanes::mul_high(lower.low, w.lower)),
            lanes::add(lanes::mul_high(upper.high, w.upper), lanes::mul_high(lower.high, w.lower))};
}

/// A coordinate on the grid of the interpolation.
struct OnGrid {
    int whole;
    int part;
    explicit OnGrid(float x) {
        const int steps = floor_int(x * static_cast<float>(kGrid) + 0.5F);
        whole = steps >= 0 ? steps / kGrid : -((kGrid - 1 - steps) / kGrid);
        part = steps - whole * kGrid;
    }
    [[nodiscard]] float value() const {
        return static_cast<float>(whole) + static_cast<float>(part) * (1.0F / static_cast<float>(kGrid));
    }
};

/// Sums of products over the patch.
struct Product {
    I32x4 sum{};
    void add(const Row& a, const Row& b) {
        lanes::add_products(sum, a.low, b.low);
        lanes::add_products(sum, a.high, b.high);
    }
    [[nodiscard]] std::int32_t total() const { return lanes::total(sum); }
};

Row load_row(const std::int16_t* p) {
    return {lanes::load16(p), lanes::load16(p + 8)};
}
void store_row(std::int16_t* p, const Row& row) {
    lanes::store16(p, row.low);
    lanes::store16(p + 8, row.high);
}
Row difference(const std::int16_t* a, const std::int16_t* b, const Row& mask) {
    return {lanes::bit_and(lanes::sub(lanes::load16(a), lanes::load16(b)), mask.low),
            lanes::bit_and(lanes::sub(lanes::load16(a + 8), lanes::load16(b + 8)), mask.high)};
}
Row about_zero(const Row& row) {
    const I16x8 middle = lanes::splat16(kMiddle);
    return {lanes::add(row.low, middle), lanes::add(row.high, middle)};
}
Row masked(const Row& row, const Row& mask) {
    return {lanes::bit_and(row.low, mask.low), lanes::bit_and(row.high, mask.high)};
}
Row about_middle(const Row& row, const Row& mask) {
    const I16x8 middle = lanes::splat16(kMiddle);
    return {lanes::bit_and(lanes::sub(row.low, middle), mask.low),
            lanes::bit_and(lanes::sub(row.high, middle), mask.high)};
}

/// Sum of (a - mean a) (b - mean b) from the raw sums.
double centred(std::int32_t ab, std::int32_t a, std::int32_t b) {
    return static_cast<double>(ab) - static_cast<double>(a) * static_cast<double>(b) / kPixels;
}

}  // namespace

bool take_reference(const ImageView& image, float u, float v, ReferencePatch& out) {
    constexpr int kHalf = kReference / 2;
    const int x0 = floor_int(u) - kHalf;
    const int y0 = floor_int(v) - kHalf;
    if (x0 < 0 || y0 < 0 || x0 + kReference + 1 > image.width || y0 + kReference + 1 > image.height) {
        return false;
    }
    // Weights in 1/64 px: integers, so that the stored patch is the same everywhere.
    const int ax = static_cast<int>((u - static_cast<float>(floor_int(u))) * 64.0F + 0.5F);
    const int ay = static_cast<int>((v - static_cast<float>(floor_int(v))) * 64.0F + 0.5F);
    for (int r = 0; r < kReference; ++r) {
        const std::uint8_t* a = image.row(y0 + r) + x0;
        const std::uint8_t* b = image.row(y0 + r + 1) + x0;
        for (int c = 0; c < kReference; ++c) {
            const int top = a[c] * (64 - ax) + a[c + 1] * ax;
            const int bottom = b[c] * (64 - ax) + b[c + 1] * ax;
            out[static_cast<std::size_t>(r * kReference + c)] =
                static_cast<std::uint8_t>((top * (64 - ay) + bottom * ay + 2048) >> 12);
        }
    }
    return true;
}

bool PatchTemplate::build(const ReferencePatch& reference, const PatchWarp& warp) {
    constexpr int kUnit = 4096;  // steps per px
    constexpr int kLast = (kReference - 1) * kUnit - 1;
    const auto steps = [](float x) { return floor_int(x * static_cast<float>(kUnit) + 0.5F); };
    const int a = steps(warp.a);
    const int b = steps(warp.b);
    const int d = steps(warp.d);
    constexpr int kMid = kReference / 2 * kUnit;
    constexpr int kHalf = kSource / 2;
    Source source{};
    std::int16_t row[kReference];
    for (int r = 0; r < kSource; ++r) {
        const int y = clamped(kMid + d * (r - kHalf), kLast);
        const int ay = (y / 64) % 64;
        const std::uint8_t* upper = reference.data() + y / kUnit * kReference;
        for (int c = 0; c < kReference; ++c) {
            row[c] = static_cast<std::int16_t>(upper[c] * (64 - ay) + upper[c + kReference] * ay);
        }
        std::int16_t* out = source.data() + static_cast<std::ptrdiff_t>(r) * kSourceStride;
        int x = kMid + b * (r - kHalf) - a * kHalf;
        for (int c = 0; c < kSource; ++c, x += a) {
            const int at = clamped(x, kLast);
            const int ax = (at / 64) % 64;
            const std::int16_t* p = row + at / kUnit;
            out[c] = static_cast<std::int16_t>((p[0] * (64 - ax) + p[1] * ax) / 256);
        }
    }
    return finish(source);
}

bool PatchTemplate::build_at(const ImageView& image, float u, float v, float shear) {
    constexpr int kHalf = kSource / 2;
    const OnGrid row(v);
    const int y0 = row.whole - kHalf;
    const float reach = static_cast<float>(kHalf) * std::fabs(shear) + static_cast<float>(kHalf) + 1.0F;
    if (!(u - reach > 1.0F) ||
        !(u + reach + static_cast<float>(kLanes - kSource) + 2.0F < static_cast<float>(image.width)) || y0 < 0 ||
        y0 + kSource + 1 > image.height) {
        return false;
    }
    const RowWeights weights(row.part);
    Source source{};
    for (int r = 0; r < kSource; ++r) {
        const OnGrid x(u + shear * static_cast<float>(r - kHalf));
        const Taps<4> ax(x.part);
        const int x0 = x.whole - kHalf;
        store_row(
            source.data() + static_cast<std::ptrdiff_t>(r) * kSourceStride,
            about_zero(between(along(image.row(y0 + r) + x0, ax), along(image.row(y0 + r + 1) + x0, ax), weights)));
    }
    return finish(source);
}

bool PatchTemplate::finish(const Source& source) {
    const Row mask = load_row(kColumnMask);
    const Row one{lanes::splat16(1), lanes::splat16(1)};
    Product v1;
    Product u1;
    Product w1;
    Product vv;
    Product uu;
    Product uw;
    Product ww;
    Product vu;
    Product vw;
    for (int r = 0; r < kPatchRows; ++r) {
        const std::int16_t* p = source.data() + static_cast<std::ptrdiff_t>(r + 1) * kSourceStride + 1;
        const Row value = about_middle(load_row(p), mask);
        const Row gu = difference(p + 1, p - 1, mask);
        const Row gv = difference(p + kSourceStride, p - kSourceStride, mask);
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(r) * kLanes;
        store_row(value_.data() + at, value);
        store_row(gu_.data() + at, gu);
        store_row(gv_.data() + at, gv);
        v1.add(value, one);
        u1.add(gu, one);
        w1.add(gv, one);
        vv.add(value, value);
        uu.add(gu, gu);
        uw.add(gu, gv);
        ww.add(gv, gv);
        vu.add(value, gu);
        vw.add(value, gv);
    }
    sum_ = v1.total();
    sum_u_ = u1.total();
    sum_v_ = w1.total();
    square_ = centred(vv.total(), sum_, sum_);
    if (!(square_ > kMinSquare)) {
        return false;
    }
    const double value_u = centred(vu.total(), sum_, sum_u_);
    const double value_v = centred(vw.total(), sum_, sum_v_);
    gain_u_ = value_u / square_;
    gain_v_ = value_v / square_;
    huu_ = centred(uu.total(), sum_u_, sum_u_) - gain_u_ * value_u;
    huv_ = centred(uw.total(), sum_u_, sum_v_) - gain_u_ * value_v;
    hvv_ = centred(ww.total(), sum_v_, sum_v_) - gain_v_ * value_v;
    return huu_ + hvv_ > kMinTexture;
}

bool PatchTemplate::compare(const ImageView& image, float u, float v, Match& out) const {
    const OnGrid column(u);
    const OnGrid row(v);
    const int x0 = column.whole - kPatchHalf;
    const int y0 = row.whole - kPatchHalf;
    if (x0 < 1 || y0 < 0 || x0 + kLanes + 2 > image.width || y0 + kPatchRows + 1 > image.height) {
        return false;
    }
    const Taps<4> ax(column.part);
    const RowWeights weights(row.part);
    const Row mask = load_row(kColumnMask);
    const Row one{lanes::splat16(1), lanes::splat16(1)};
    Product s1;
    Product ss;
    Product sv;
    Product su;
    Product sw;
    Row upper = along(image.row(y0) + x0, ax);
    for (int r = 0; r < kPatchRows; ++r) {
        const Row lower = along(image.row(y0 + r + 1) + x0, ax);
        const Row s = masked(between(upper, lower, weights), mask);
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(r) * kLanes;
        s1.add(s, one);
        ss.add(s, s);
        sv.add(s, load_row(value_.data() + at));
        su.add(s, load_row(gu_.data() + at));
        sw.add(s, load_row(gv_.data() + at));
        upper = lower;
    }
    const std::int32_t sum = s1.total();
    out.u = column.value();
    out.v = row.value();
    const double square = centred(ss.total(), sum, sum);
    const double dot = centred(sv.total(), sum, sum_);
    const double contrast = dot / square_;
    if (!(square > kMinSquare) || !(contrast > kMinContrast)) {
        return false;
    }
    out.bu = (centred(su.total(), sum, sum_u_) - gain_u_ * dot) / contrast;
    out.bv = (centred(sw.total(), sum, sum_v_) - gain_v_ * dot) / contrast;
    out.ncc = static_cast<float>(dot / std::sqrt(square * square_));
    return true;
}

bool PatchTemplate::align(const ImageView& image, float max_shift_px, float& u, float& v, float& ncc) const {
    const double determinant = huu_ * hvv_ - huv_ * huv_;
    if (!(determinant > 1e-3 * huu_ * hvv_) || !(determinant > kMinTexture)) {
        return false;
    }
    const double inverse = 2.0 / determinant;  // values are in 1/16, gradients in 1/32
    const float u0 = u;
    const float v0 = v;
    for (int k = 0; k < kIterations; ++k) {
        Match match;
        if (!compare(image, u, v, match)) {
            return false;
        }
        ncc = match.ncc;
        const auto du = static_cast<float>(inverse * (hvv_ * match.bu - huv_ * match.bv));
        const auto dv = static_cast<float>(inverse * (huu_ * match.bv - huv_ * match.bu));
        u = match.u - du;
        v = match.v - dv;
        const float su = u - u0;
        const float sv = v - v0;
        if (!(su * su + sv * sv < max_shift_px * max_shift_px)) {
            return false;
        }
        if (du * du + dv * dv < kSettled_px * kSettled_px) {
            return true;
        }
    }
    return false;
}

bool PatchTemplate::align_row(const ImageView& image, float max_shift_px, float& u, float v, float& ncc) const {
    if (!(huu_ > 0.5 * kMinTexture)) {
        return false;
    }
    const float u0 = u;
    for (int k = 0; k < kIterations; ++k) {
        Match match;
        if (!compare(image, u, v, match)) {
            return false;
        }
        ncc = match.ncc;
        const auto du = static_cast<float>(2.0 * match.bu / huu_);
        u = match.u - du;
        const float su = u - u0;
        if (!(su * su < max_shift_px * max_shift_px)) {
            return false;
        }
        if (du * du < kSettled_px * kSettled_px) {
            return true;
        }
    }
    return false;
}

}  // namespace semtrack
