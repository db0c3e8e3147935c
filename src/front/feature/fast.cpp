#include "front/feature/fast.hpp"

#include <cstddef>
#include <cstring>

#include "math/lanes.hpp"

namespace semtrack {

namespace {

using lanes::U8x16;

constexpr int kLanes = 16;
constexpr int kCircle = 16;
constexpr int kRadius = 3;
constexpr int kDx[kCircle] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
constexpr int kDy[kCircle] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};

bool any(const U8x16& a) {
    return lanes::sign_bits(lanes::equal(a, lanes::splat(0))) != 0xFFFFU;
}
/// Where a > b, something other than 0.
U8x16 above(const U8x16& a, const U8x16& b) {
    return lanes::sub_saturated(a, b);
}

/// Sixteen centres and the circles around them.
struct Circle {
    const std::uint8_t* at[kCircle];
    std::ptrdiff_t x{0};
    U8x16 centre{};

    [[nodiscard]] U8x16 pixel(int k) const { return lanes::load(at[k] + x); }
    /// How much at least one of two opposite pixels is brighter (or darker) than the centre: any arc of nine holds one
    /// of them, so no score is larger.
    void bound(int k, U8x16& brighter, U8x16& darker) const {
        const U8x16 a = pixel(k);
        const U8x16 b = pixel(k + kCircle / 2);
        brighter = lanes::min(brighter, above(lanes::max(a, b), centre));
        darker = lanes::min(darker, above(centre, lanes::min(a, b)));
    }
};

/// The best over all arcs of nine of the smallest difference: runs of 2, 4 and 8, then the ninth.
U8x16 best_arc(const U8x16* d) {
    U8x16 two[kCircle];
    U8x16 four[kCircle];
    for (int k = 0; k < kCircle; ++k) {
        two[k] = lanes::min(d[k], d[(k + 1) % kCircle]);
    }
    for (int k = 0; k < kCircle; ++k) {
        four[k] = lanes::min(two[k], two[(k + 2) % kCircle]);
    }
    U8x16 best = lanes::splat(0);
    for (int k = 0; k < kCircle; ++k) {
        const U8x16 eight = lanes::min(four[k], four[(k + 4) % kCircle]);
        best = lanes::max(best, lanes::min(eight, d[(k + 8) % kCircle]));
    }
    return best;
}

/// Scores of sixteen pixels: the largest t such that some arc is brighter than the centre by more than t, or darker;
/// 0 below the threshold.
U8x16 scores_of(const Circle& circle, const U8x16& threshold) {
    U8x16 brighter = lanes::splat(255);
    U8x16 darker = lanes::splat(255);
    for (int k = 0; k < kCircle / 2; k += 4) {
        circle.bound(k, brighter, darker);
    }
    if (!any(above(lanes::max(brighter, darker), threshold))) {
        return lanes::splat(0);
    }
    for (int k = 2; k < kCircle / 2; k += 4) {
        circle.bound(k, brighter, darker);
    }
    if (!any(above(lanes::max(brighter, darker), threshold))) {
        return lanes::splat(0);
    }
    U8x16 up[kCircle];
    U8x16 down[kCircle];
    for (int k = 0; k < kCircle; ++k) {
        const U8x16 p = circle.pixel(k);
        up[k] = above(p, circle.centre);
        down[k] = above(circle.centre, p);
    }
    const U8x16 score = lanes::sub_saturated(lanes::max(best_arc(up), best_arc(down)), lanes::splat(1));
    return lanes::bit_and(score, lanes::equal(lanes::max(score, threshold), score));
}

/// Of sixteen scores, those that no neighbour beats; of equal neighbours the earlier one in raster order stays.
std::uint32_t maxima(const std::uint8_t* above_row, const std::uint8_t* here, const std::uint8_t* below) {
    const U8x16 s = lanes::load(here);
    if (!any(s)) {
        return 0;
    }
    const U8x16 earlier = lanes::max(lanes::max(lanes::load(above_row - 1), lanes::load(above_row)),
                                     lanes::max(lanes::load(above_row + 1), lanes::load(here - 1)));
    const U8x16 later = lanes::max(lanes::max(lanes::load(below - 1), lanes::load(below)),
                                   lanes::max(lanes::load(below + 1), lanes::load(here + 1)));
    const U8x16 beaten = lanes::equal(lanes::sub_saturated(s, earlier), lanes::splat(0));  // s <= earlier: also s = 0
    const U8x16 stays = lanes::equal(lanes::max(s, later), s);
    return lanes::sign_bits(stays) & ~lanes::sign_bits(beaten);
}

}  // namespace

void CornerGrid::add(const Corner& corner) {
    const int cell = (corner.y / kCornerCell_px) * kColumns + corner.x / kCornerCell_px;
    std::uint8_t& n = count_[static_cast<std::size_t>(cell)];
    Corner* list = corners_.data() + static_cast<std::ptrdiff_t>(cell) * kPerCell;
    int k = n;
    if (n == kPerCell) {
        if (corner.score <= list[kPerCell - 1].score) {
            return;
        }
        k = kPerCell - 1;
    } else {
        ++n;
    }
    for (; k > 0 && list[k - 1].score < corner.score; --k) {
        list[k] = list[k - 1];
    }
    list[k] = corner;
}

void FastDetector::score_row(const ImageView& image, int y, int threshold, int margin_px, std::uint8_t* scores) {
    std::memset(scores, 0, static_cast<std::size_t>(image.width));
    Circle circle;
    for (int k = 0; k < kCircle; ++k) {
        circle.at[k] = image.row(y + kDy[k]) + kDx[k];
    }
    const std::uint8_t* centre = image.row(y);
    const U8x16 t = lanes::splat(static_cast<std::uint8_t>(threshold));
    const int last = image.width - margin_px - kLanes;
    for (int x = margin_px; x < last + kLanes; x += kLanes) {
        circle.x = x < last ? x : last;  // the last sixteen overlap those before
        circle.centre = lanes::load(centre + circle.x);
        lanes::store(scores + circle.x, scores_of(circle, t));
    }
}

Status FastDetector::detect(const ImageView& image, int threshold, int margin_px, CornerGrid& out) {
    out.clear();
    const int margin = margin_px < kRadius + 1 ? kRadius + 1 : margin_px;
    if (image.empty() || image.width > kMaxImageWidth || image.height > kMaxImageHeight ||
        image.width < 2 * margin + kLanes || image.height <= 2 * margin || threshold < 1 || threshold > 254) {
        return Status::kInvalidArgument;
    }
    std::uint8_t* above_row = rows_.data();
    std::uint8_t* here = above_row + kMaxImageWidth;
    std::uint8_t* below = here + kMaxImageWidth;
    std::memset(above_row, 0, static_cast<std::size_t>(image.width));
    score_row(image, margin, threshold, margin, here);
    const int end = image.width - margin;
    for (int y = margin; y < image.height - margin; ++y) {
        if (y + 1 < image.height - margin) {
            score_row(image, y + 1, threshold, margin, below);
        } else {
            std::memset(below, 0, static_cast<std::size_t>(image.width));
        }
        for (int x = margin; x < end; x += kLanes) {
            const int from = x < end - kLanes ? x : end - kLanes;
            std::uint32_t bits = maxima(above_row + from, here + from, below + from) >> static_cast<unsigned>(x - from);
            for (int i = x; bits != 0U; ++i, bits >>= 1U) {
                if ((bits & 1U) != 0U) {
                    out.add({static_cast<std::int16_t>(i), static_cast<std::int16_t>(y), here[i]});
                }
            }
        }
        std::uint8_t* old = above_row;
        above_row = here;
        here = below;
        below = old;
    }
    return Status::kOk;
}

}  // namespace semtrack
