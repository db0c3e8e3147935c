// The 256 comparisons of the descriptor, drawn at compile time by a seeded procedure, and the directions they can be
// turned to.
#ifndef SEMTRACK_FRONT_FEATURE_BRIEF_PATTERN_HPP
#define SEMTRACK_FRONT_FEATURE_BRIEF_PATTERN_HPP

#include <array>
#include <cstdint>

namespace semtrack {

inline constexpr int kBriefRadius_px = 15;                  ///< of the disc that holds every sample in every direction
inline constexpr int kBriefReach_px = kBriefRadius_px - 1;  ///< of the samples, along each axis, in every direction
inline constexpr int kBriefBits = 256;

/// Bit k is set when the smoothed image is darker at (ax, ay) than at (bx, by).
struct BriefPair {
    std::int8_t ax{0};
    std::int8_t ay{0};
    std::int8_t bx{0};
    std::int8_t by{0};
};
using BriefPattern = std::array<BriefPair, static_cast<std::size_t>(kBriefBits)>;

namespace detail {

class PatternRandom {  // xorshift32
public:
    constexpr std::uint32_t next() {
        s_ ^= s_ << 13U;
        s_ ^= s_ >> 17U;
        s_ ^= s_ << 5U;
        return s_;
    }
    /// Sum of three uniform numbers: close to normal, sigma 6.2 px (31 px / 5), within +-18.
    constexpr int coordinate() {
        int sum = -18;
        for (int k = 0; k < 3; ++k) {
            sum += static_cast<int>((next() >> 8U) % 13U);
        }
        return sum;
    }

private:
    std::uint32_t s_{0x5EA7A11U};
};

/// Pairs of normally distributed points, at most 14 px from the centre (one less than the radius: turning rounds) and
/// at least 4 px from each other, so that the smoothing leaves them different.
constexpr BriefPattern make_brief_pattern() {
    constexpr int kReach2 = (kBriefRadius_px - 1) * (kBriefRadius_px - 1);
    constexpr int kApart2 = 4 * 4;
    constexpr int kDraws = 4096;  // three times what is needed
    BriefPattern pattern{};
    PatternRandom random;
    std::size_t n = 0;
    for (int draw = 0; draw < kDraws && n < pattern.size(); ++draw) {
        const int ax = random.coordinate();
        const int ay = random.coordinate();
        const int bx = random.coordinate();
        const int by = random.coordinate();
        const int apart2 = (ax - bx) * (ax - bx) + (ay - by) * (ay - by);
        if (ax * ax + ay * ay <= kReach2 && bx * bx + by * by <= kReach2 && apart2 >= kApart2) {
            pattern[n] = {static_cast<std::int8_t>(ax), static_cast<std::int8_t>(ay), static_cast<std::int8_t>(bx),
                          static_cast<std::int8_t>(by)};
            ++n;
        }
    }
    return pattern;
}

}  // namespace detail

inline constexpr BriefPattern kBriefPattern = detail::make_brief_pattern();

/// 32 directions, clockwise from +u (v points down): cosine and sine x 2^14, rounded.
inline constexpr int kDirections = 32;
inline constexpr int kDirectionBits = 14;
struct Direction {
    std::int16_t cos{0};
    std::int16_t sin{0};
};

[[nodiscard]] constexpr Direction direction(int k) {
    constexpr std::int16_t kQuarter[9] = {16384, 16069, 15137, 13623, 11585, 9102, 6270, 3196, 0};  // cos(k 11.25 deg)
    const int quadrant = (k & (kDirections - 1)) / 8;
    const std::int16_t c = kQuarter[k & 7];
    const std::int16_t s = kQuarter[8 - (k & 7)];
    const auto minus_c = static_cast<std::int16_t>(-c);
    const auto minus_s = static_cast<std::int16_t>(-s);
    return quadrant == 0   ? Direction{c, s}
           : quadrant == 1 ? Direction{minus_s, c}
           : quadrant == 2 ? Direction{minus_c, minus_s}
                           : Direction{s, minus_c};
}

}  // namespace semtrack

#endif
