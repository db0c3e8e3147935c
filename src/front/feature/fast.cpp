#include "front/feature/fast.hpp"

#include <cstring>

namespace semtrack {

namespace {

constexpr int kCircle = 16;
constexpr int kArc = 9;
constexpr int kRadius = 3;
constexpr int kDx[kCircle] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
constexpr int kDy[kCircle] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};

/// Largest t such that some arc of 9 is brighter than the centre by more than t, or darker: the best over all arcs of
/// the smallest difference, minus one.
int corner_score(const int* d) {
    int best = 0;
    for (int start = 0; start < kCircle; ++start) {
        int low = 255;    // smallest of the differences: brighter arc
        int high = -255;  // largest: darker arc
        for (int k = 0; k < kArc; ++k) {
            const int x = d[(start + k) & (kCircle - 1)];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        best = low > best ? low : best;
        best = -high > best ? -high : best;
    }
    return best > 0 ? best - 1 : 0;
}

/// bits: 16 flags on the circle; true when 9 contiguous ones are set.
bool has_arc(std::uint32_t bits) {
    std::uint32_t b = bits | (bits << 16U);
    b &= b >> 1U;  // runs of 2
    b &= b >> 2U;  // 4
    b &= b >> 4U;  // 8
    b &= (bits | (bits << 16U)) >> 8U;
    return (b & 0xFFFFU) != 0U;
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
    const std::uint8_t* centre = image.row(y);
    const std::uint8_t* circle[kCircle];
    for (int k = 0; k < kCircle; ++k) {
        circle[k] = image.row(y + kDy[k]) + kDx[k];
    }
    for (int x = margin_px; x < image.width - margin_px; ++x) {
        const int high = centre[x] + threshold;
        const int low = centre[x] - threshold;
        // Of two opposite pixels an arc of 9 holds at least one: four pairs reject most of the image.
        bool bright = true;
        bool dark = true;
        for (int k = 0; k < 8; k += 4) {
            const int a = circle[k][x];
            const int b = circle[k + 8][x];
            bright = bright && (a > high || b > high);
            dark = dark && (a < low || b < low);
        }
        if (!bright && !dark) {
            continue;
        }
        std::uint32_t brighter = 0;
        std::uint32_t darker = 0;
        int d[kCircle];
        for (int k = 0; k < kCircle; ++k) {
            const int p = circle[k][x];
            d[k] = p - centre[x];
            brighter |= static_cast<std::uint32_t>(p > high) << static_cast<unsigned>(k);
            darker |= static_cast<std::uint32_t>(p < low) << static_cast<unsigned>(k);
        }
        if (has_arc(brighter) || has_arc(darker)) {
            scores[x] = static_cast<std::uint8_t>(corner_score(d));
        }
    }
}

Status FastDetector::detect(const ImageView& image, int threshold, int margin_px, CornerGrid& out) {
    out.clear();
    const int margin = margin_px < kRadius + 1 ? kRadius + 1 : margin_px;
    if (image.empty() || image.width > kMaxImageWidth || image.height > kMaxImageHeight || image.width <= 2 * margin ||
        image.height <= 2 * margin || threshold < 1 || threshold > 254) {
        return Status::kInvalidArgument;
    }
    std::uint8_t* above = rows_.data();
    std::uint8_t* here = above + kMaxImageWidth;
    std::uint8_t* below = here + kMaxImageWidth;
    std::memset(above, 0, static_cast<std::size_t>(image.width));
    score_row(image, margin, threshold, margin, here);
    for (int y = margin; y < image.height - margin; ++y) {
        if (y + 1 < image.height - margin) {
            score_row(image, y + 1, threshold, margin, below);
        } else {
            std::memset(below, 0, static_cast<std::size_t>(image.width));
        }
        for (int x = margin; x < image.width - margin; ++x) {
            const int s = here[x];
            // Equal neighbours: the earlier one in raster order stays.
            if (s == 0 || above[x - 1] >= s || above[x] >= s || above[x + 1] >= s || here[x - 1] >= s ||
                here[x + 1] > s || below[x - 1] > s || below[x] > s || below[x + 1] > s) {
                continue;
            }
            out.add({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::uint8_t>(s)});
        }
        std::uint8_t* old = above;
        above = here;
        here = below;
        below = old;
    }
    return Status::kOk;
}

}  // namespace semtrack
