#include "front/match/orb_refine.hpp"

#include <array>

namespace semtrack {

namespace {
constexpr int kHalf = 5;
constexpr int kSide = 2 * kHalf + 1;
constexpr int kArea = kSide * kSide;
constexpr int kMaxReach = 8;

bool inside(const ImageView& image, int x, int y, int reach) {
    return x - kHalf - reach >= 0 && x + kHalf + reach < image.width && y - kHalf >= 0 && y + kHalf < image.height;
}

// Times kArea, so that the means stay integers: at most 121 x 121 x 255 x 2.
std::int32_t difference(const ImageView& left, int x_left, int y_left, const ImageView& right, int x_right,
                        int y_right) {
    std::int32_t sum = 0;
    for (int dy = -kHalf; dy <= kHalf; ++dy) {
        const std::uint8_t* l = left.row(y_left + dy) + x_left;
        const std::uint8_t* r = right.row(y_right + dy) + x_right;
        for (int dx = -kHalf; dx <= kHalf; ++dx) {
            sum += l[dx] - r[dx];
        }
    }
    const std::int32_t mean = (sum + (sum >= 0 ? kArea / 2 : -kArea / 2)) / kArea;
    std::int32_t total = 0;
    for (int dy = -kHalf; dy <= kHalf; ++dy) {
        const std::uint8_t* l = left.row(y_left + dy) + x_left;
        const std::uint8_t* r = right.row(y_right + dy) + x_right;
        for (int dx = -kHalf; dx <= kHalf; ++dx) {
            const std::int32_t d = l[dx] - r[dx] - mean;
            total += d < 0 ? -d : d;
        }
    }
    return total;
}
}  // namespace

bool refine_along_row(const ImageView& left, int x_left, int y_left, const ImageView& right, int x_right, int y_right,
                      int reach, RowMatch& out) {
    const int most = reach < kMaxReach ? reach : kMaxReach;
    if (most < 1 || !inside(left, x_left, y_left, 0) || !inside(right, x_right, y_right, most)) {
        return false;
    }
    std::array<std::int32_t, static_cast<std::size_t>(2 * kMaxReach) + 1> cost{};
    int best = 0;
    for (int k = 0; k <= 2 * most; ++k) {
        cost[static_cast<std::size_t>(k)] = difference(left, x_left, y_left, right, x_right + k - most, y_right);
        best = cost[static_cast<std::size_t>(k)] < cost[static_cast<std::size_t>(best)] ? k : best;
    }
    if (best == 0 || best == 2 * most) {
        return false;
    }
    const std::int32_t before = cost[static_cast<std::size_t>(best - 1)];
    const std::int32_t here = cost[static_cast<std::size_t>(best)];
    const std::int32_t after = cost[static_cast<std::size_t>(best + 1)];
    const std::int32_t bend = before - 2 * here + after;
    const float offset = bend > 0 ? 0.5F * static_cast<float>(before - after) / static_cast<float>(bend) : 0.0F;
    out.x = static_cast<float>(x_right + best - most) + offset;
    out.residual = static_cast<float>(here) / static_cast<float>(kArea);
    return true;
}

}  // namespace semtrack
