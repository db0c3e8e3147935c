#include "front/feature/brief.hpp"

namespace semtrack {

namespace {

/// Largest |dx| of the disc in each row.
constexpr std::array<int, static_cast<std::size_t>(kBriefRadius_px) + 1> disc_widths() {
    std::array<int, static_cast<std::size_t>(kBriefRadius_px) + 1> width{};
    for (int dy = 0; dy <= kBriefRadius_px; ++dy) {
        int dx = 0;
        while ((dx + 1) * (dx + 1) + dy * dy <= kBriefRadius_px * kBriefRadius_px) {
            ++dx;
        }
        width[static_cast<std::size_t>(dy)] = dx;
    }
    return width;
}
constexpr auto kDiscWidth = disc_widths();

constexpr int rounded(int x) {
    return (x + (1 << (kDirectionBits - 1))) >> kDirectionBits;
}

}  // namespace

int patch_direction(const ImageView& image, int x, int y) {
    std::int32_t m10 = 0;  // moments: at most 255 x 709 pixels x 15
    std::int32_t m01 = 0;
    for (int dy = -kBriefRadius_px; dy <= kBriefRadius_px; ++dy) {
        const int width = kDiscWidth[static_cast<std::size_t>(dy < 0 ? -dy : dy)];
        const std::uint8_t* row = image.row(y + dy) + x;
        std::int32_t sum = 0;
        for (int dx = -width; dx <= width; ++dx) {
            const std::int32_t value = row[dx];
            m10 += dx * value;
            sum += value;
        }
        m01 += dy * sum;
    }
    int best = 0;
    std::int64_t largest = 0;
    for (int k = 0; k < kDirections; ++k) {
        const Direction d = direction(k);
        const std::int64_t along = static_cast<std::int64_t>(m10) * d.cos + static_cast<std::int64_t>(m01) * d.sin;
        if (along > largest) {
            largest = along;
            best = k;
        }
    }
    return best;
}

void describe(const ImageView& smoothed, int x, int y, int turned_to, Descriptor& out) {
    const Direction d = direction(turned_to);
    const std::uint8_t* centre = smoothed.row(y) + x;
    const std::ptrdiff_t stride = smoothed.stride;
    for (std::size_t word = 0; word < out.size(); ++word) {
        std::uint32_t bits = 0;
        for (std::size_t bit = 0; bit < 32; ++bit) {
            const BriefPair& p = kBriefPattern[32 * word + bit];
            std::ptrdiff_t a = p.ay * stride + p.ax;
            std::ptrdiff_t b = p.by * stride + p.bx;
            if (turned_to != 0) {
                a = rounded(p.ax * d.sin + p.ay * d.cos) * stride + rounded(p.ax * d.cos - p.ay * d.sin);
                b = rounded(p.bx * d.sin + p.by * d.cos) * stride + rounded(p.bx * d.cos - p.by * d.sin);
            }
            bits |= (centre[a] < centre[b] ? 1U : 0U) << bit;
        }
        out[word] = bits;
    }
}

}  // namespace semtrack
