#include "front/feature/brief.hpp"

namespace semtrack {

namespace {

constexpr int kColumns = BriefPatch::kColumns;
constexpr int kHalfTaps = 3;  // of the filter of 7

constexpr std::size_t sized(int i) {
    return static_cast<std::size_t>(i);
}

/// 255 inside the disc of kBriefRadius_px, 0 outside, by row (0: the centre's) and column (from x - 16): rows of a
/// fixed length, so that 16 columns are one step.
using DiscRow = std::array<std::uint8_t, sized(kColumns)>;
constexpr std::array<DiscRow, sized(kBriefRadius_px) + 1> make_disc() {
    std::array<DiscRow, sized(kBriefRadius_px) + 1> disc{};
    for (int dy = 0; dy <= kBriefRadius_px; ++dy) {
        for (int i = 0; i < kColumns; ++i) {
            const int dx = i - kColumns / 2;
            disc[sized(dy)][sized(i)] = dx * dx + dy * dy <= kBriefRadius_px * kBriefRadius_px ? 255 : 0;
        }
    }
    return disc;
}
constexpr auto kDisc = make_disc();

constexpr int rounded(int x) {
    return (x + (1 << (kDirectionBits - 1))) >> kDirectionBits;
}

/// Where a comparison looks in a BriefPatch.
struct Place {
    std::uint16_t a{0};
    std::uint16_t b{0};
};
using Places = std::array<Place, sized(kBriefBits)>;

constexpr std::uint16_t turned_index(int x, int y, const Direction& d) {
    return static_cast<std::uint16_t>(
        BriefPatch::index(rounded(x * d.cos - y * d.sin), rounded(x * d.sin + y * d.cos)));
}

constexpr std::array<Places, sized(kDirections)> make_places() {
    std::array<Places, sized(kDirections)> places{};
    for (int k = 0; k < kDirections; ++k) {
        const Direction d = direction(k);
        for (std::size_t bit = 0; bit < kBriefPattern.size(); ++bit) {
            const BriefPair& p = kBriefPattern[bit];
            places[sized(k)][bit].a = turned_index(p.ax, p.ay, d);
            places[sized(k)][bit].b = turned_index(p.bx, p.by, d);
        }
    }
    return places;
}
constexpr auto kPlaces = make_places();

using Word = std::uint16_t;

/// 64 times the filtered value, of values up to 1020. In 16 bits after every step: compilers that see wider sums use
/// half the lanes.
constexpr Word binomial(Word outer, Word near_outer, Word near_middle, Word middle) {
    const auto a = static_cast<Word>(outer + static_cast<Word>(near_outer * 6));
    const auto b = static_cast<Word>(static_cast<Word>(near_middle * 15) + static_cast<Word>(middle * 20));
    return static_cast<Word>(a + b);
}

using Row = Word[kColumns];

/// Along the row, to four times the value (10 bits). In several loops: of one in which neighbours share all their
/// pixels clang makes a chain instead of vectors.
void filter_row(const std::uint8_t* p, Word* out) {
    Word outer[kColumns];
    Word near_outer[kColumns];
    Word near_middle[kColumns];
    for (int i = 0; i < kColumns; ++i) {
        outer[i] = static_cast<Word>(p[i] + p[i + 6]);
    }
    for (int i = 0; i < kColumns; ++i) {
        near_outer[i] = static_cast<Word>(p[i + 1] + p[i + 5]);
    }
    for (int i = 0; i < kColumns; ++i) {
        near_middle[i] = static_cast<Word>(p[i + 2] + p[i + 4]);
    }
    for (int i = 0; i < kColumns; ++i) {
        const Word sum = binomial(outer[i], near_outer[i], near_middle[i], p[i + 3]);
        out[i] = static_cast<Word>(static_cast<Word>(sum + 8) >> 4U);
    }
}

/// Across seven rows, to the pixel.
void filter_column(const Row* rows, std::uint8_t* out) {
    for (int i = 0; i < kColumns; ++i) {
        const Word sum =
            binomial(static_cast<Word>(rows[0][i] + rows[6][i]), static_cast<Word>(rows[1][i] + rows[5][i]),
                     static_cast<Word>(rows[2][i] + rows[4][i]), rows[3][i]);
        out[i] = static_cast<std::uint8_t>(static_cast<Word>(sum + 128) >> 8U);
    }
}

/// Of the quadrant's nine directions the one that the moment points along most; of equal ones the first in the circle.
int nearest_direction(std::int32_t m10, std::int32_t m01) {
    const int quadrant = m01 >= 0 ? (m10 >= 0 ? 0 : 1) : (m10 < 0 ? 2 : 3);
    int best = 0;
    std::int64_t largest = 0;
    if (quadrant == 3) {  // its last direction is the circle's first
        largest = static_cast<std::int64_t>(m10) * direction(0).cos;
    }
    const int end = quadrant == 3 ? kDirections - 1 : 8 * quadrant + 8;
    for (int k = 8 * quadrant; k <= end; ++k) {
        const Direction d = direction(k);
        const std::int64_t along = static_cast<std::int64_t>(m10) * d.cos + static_cast<std::int64_t>(m01) * d.sin;
        if (along > largest) {
            largest = along;
            best = k;
        }
    }
    return best;
}

}  // namespace

// Both moments stay in 16 bits a column: at most 31 x 255, and 255 x (1 + 2 + .. + 15) = 30600.
int patch_direction(const ImageView& image, int x, int y) {
    std::int16_t sums[kColumns];
    std::int16_t downs[kColumns];
    const std::uint8_t* middle = image.row(y) + x - kColumns / 2;
    for (int i = 0; i < kColumns; ++i) {
        sums[i] = static_cast<std::int16_t>(middle[i] & kDisc[0][sized(i)]);
        downs[i] = 0;
    }
    for (int dy = 1; dy <= kBriefRadius_px; ++dy) {
        const std::uint8_t* above = image.row(y - dy) + x - kColumns / 2;
        const std::uint8_t* below = image.row(y + dy) + x - kColumns / 2;
        const std::uint8_t* inside = kDisc[sized(dy)].data();
        const auto weight = static_cast<std::int16_t>(dy);
        for (int i = 0; i < kColumns; ++i) {
            const auto a = static_cast<std::int16_t>(above[i] & inside[i]);
            const auto b = static_cast<std::int16_t>(below[i] & inside[i]);
            sums[i] = static_cast<std::int16_t>(sums[i] + a + b);
            downs[i] = static_cast<std::int16_t>(downs[i] + static_cast<std::int16_t>(b - a) * weight);
        }
    }
    std::int32_t m10 = 0;
    std::int32_t m01 = 0;
    for (int i = 0; i < kColumns; ++i) {
        m10 += (i - kColumns / 2) * sums[i];
        m01 += downs[i];
    }
    return nearest_direction(m10, m01);
}

// Sums stay in 16 bits (255 x 64, then 1020 x 64): twice the lanes.
void BriefPatch::smooth(const ImageView& image, int x, int y) {
    constexpr int kWide = kColumns + 2 * kHalfTaps;
    constexpr int kHigh = kRows + 2 * kHalfTaps;
    Word rows[kHigh][kColumns];
    std::uint8_t padded[kWide];
    const int left = x - kCentreColumn - kHalfTaps;
    const bool whole = left >= 0 && left + kWide <= image.width;
    for (int r = 0; r < kHigh; ++r) {
        const int row = y + r - kBriefReach_px - kHalfTaps;
        const std::uint8_t* from = image.row(row < 0 ? 0 : row < image.height ? row : image.height - 1);
        const std::uint8_t* p = from + left;
        if (!whole) {
            for (int i = 0; i < kWide; ++i) {
                const int column = left + i;
                padded[i] = from[column < 0 ? 0 : column < image.width ? column : image.width - 1];
            }
            p = padded;
        }
        filter_row(p, rows[r]);
    }
    for (int r = 0; r < kRows; ++r) {
        filter_column(rows + r, pixels_.data() + r * kColumns);
    }
}

void BriefPatch::describe(int turned_to, Descriptor& out) const {
    const Places& places = kPlaces[sized(turned_to)];
    for (std::size_t word = 0; word < out.size(); ++word) {
        std::uint32_t bits = 0;
        for (std::size_t bit = 32; bit > 0; --bit) {  // from the top: a comparison's carry is the next lowest bit
            const Place& place = places[32 * word + bit - 1];
            bits = 2 * bits + (pixels_[place.a] < pixels_[place.b] ? 1U : 0U);
        }
        out[word] = bits;
    }
}

}  // namespace semtrack
