#include "front/feature/fast.hpp"

#include <cstddef>
#include <cstring>

#include "math/lanes.hpp"

namespace semtrack {

namespace {

using lanes::U8x16;

constexpr int kBlock = 16;
constexpr int kRadius = 3;

bool any(const U8x16& a) {
    return lanes::sign_bits(lanes::equal(a, lanes::splat(0))) != 0xFFFFU;
}

/// Sixteen centres, and the circles around them: pixel k clockwise from the top.
struct Circles {
    const std::uint8_t* row[2 * kRadius + 1];  // y - 3 .. y + 3
    Circles(const ImageView& image, int y) {
        for (int dy = -kRadius; dy <= kRadius; ++dy) {
            row[dy + kRadius] = image.row(y + dy);
        }
    }
    template <int dx, int dy>
    [[nodiscard]] U8x16 at(int x) const {
        return lanes::load(row[dy + kRadius] + x + dx);
    }
};

/// Differences to the centre, at least 0: brighter or darker, whichever is more.
U8x16 contrast(const U8x16& bright, const U8x16& dark, const U8x16& centre) {
    return lanes::max(lanes::sub_saturated(bright, centre), lanes::sub_saturated(centre, dark));
}

/// An arc of nine holds a pixel of each opposite pair: the darkest of the pairs' brighter pixels bounds what the arc is
/// brighter by, and the other way round. Four pairs of eight leave few blocks without a corner.
bool may_hold_corner(const Circles& c, int x, const U8x16& threshold) {
    const U8x16 n = c.at<0, -3>(x), s = c.at<0, 3>(x), e = c.at<3, 0>(x), w = c.at<-3, 0>(x);
    const U8x16 ne = c.at<2, -2>(x), sw = c.at<-2, 2>(x), se = c.at<2, 2>(x), nw = c.at<-2, -2>(x);
    const U8x16 bright =
        lanes::min(lanes::min(lanes::max(n, s), lanes::max(e, w)), lanes::min(lanes::max(ne, sw), lanes::max(se, nw)));
    const U8x16 dark =
        lanes::max(lanes::max(lanes::min(n, s), lanes::min(e, w)), lanes::max(lanes::min(ne, sw), lanes::min(se, nw)));
    return any(lanes::sub_saturated(contrast(bright, dark, c.at<0, 0>(x)), threshold));
}

/// With kBright the largest, over all arcs of nine pixels of the circle, of the arc's smallest pixel; else the smallest
/// of the largest. Runs of two, then of four; two arcs that share eight pixels are looked at together.
template <bool kBright>
U8x16 best_arc(const U8x16* p) {
    const auto in = [](const U8x16& a, const U8x16& b) { return kBright ? lanes::min(a, b) : lanes::max(a, b); };
    const auto out = [](const U8x16& a, const U8x16& b) { return kBright ? lanes::max(a, b) : lanes::min(a, b); };
    U8x16 two[8];  // from pixel 2 k + 1 on
    for (int k = 0; k < 8; ++k) {
        two[k] = in(p[2 * k + 1], p[(2 * k + 2) % 16]);
    }
    U8x16 four[8];
    for (int k = 0; k < 8; ++k) {
        four[k] = in(two[k], two[(k + 1) % 8]);
    }
    U8x16 best = lanes::splat(kBright ? 0 : 255);
    for (int k = 0; k < 8; ++k) {  // the eight pixels from 2 k + 1 on, and the one before or the one after
        const U8x16 eight = in(four[k], four[(k + 2) % 8]);
        best = out(best, in(eight, out(p[2 * k], p[(2 * k + 9) % 16])));
    }
    return best;
}

/// Scores of sixteen pixels: the largest t such that some arc is brighter than the centre by more than t, or darker;
/// 0 below the threshold.
U8x16 scores_of(const Circles& c, int x, const U8x16& threshold) {
    const U8x16 p[16] = {c.at<0, -3>(x), c.at<1, -3>(x),  c.at<2, -2>(x),  c.at<3, -1>(x),
                         c.at<3, 0>(x),  c.at<3, 1>(x),   c.at<2, 2>(x),   c.at<1, 3>(x),
                         c.at<0, 3>(x),  c.at<-1, 3>(x),  c.at<-2, 2>(x),  c.at<-3, 1>(x),
                         c.at<-3, 0>(x), c.at<-3, -1>(x), c.at<-2, -2>(x), c.at<-1, -3>(x)};
    const U8x16 over = contrast(best_arc<true>(p), best_arc<false>(p), c.at<0, 0>(x));
    const U8x16 score = lanes::sub_saturated(over, lanes::splat(1));
    return lanes::bit_and(score, lanes::equal(lanes::max(score, threshold), score));
}

/// Of sixteen scores, those that no neighbour beats; of equal neighbours the earlier one in raster order stays.
std::uint32_t maxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below) {
    const U8x16 s = lanes::load(here);
    const U8x16 earlier = lanes::max(lanes::max(lanes::load(above - 1), lanes::load(above)),
                                     lanes::max(lanes::load(above + 1), lanes::load(here - 1)));
    const U8x16 later = lanes::max(lanes::max(lanes::load(below - 1), lanes::load(below)),
                                   lanes::max(lanes::load(below + 1), lanes::load(here + 1)));
    const U8x16 beaten = lanes::equal(lanes::sub_saturated(s, earlier), lanes::splat(0));  // s <= earlier: also s = 0
    const U8x16 stays = lanes::equal(lanes::max(s, later), s);
    return lanes::sign_bits(stays) & ~lanes::sign_bits(beaten);
}

}  // namespace

void CornerGrid::clear() {
    keys_.fill(0);
    count_.fill(0);
}

// The list stays sorted by passing the key down it: no branch, whatever the image holds.
void CornerGrid::add(const Corner& corner) {
    const int cell = (corner.y / kCornerCell_px) * kColumns + corner.x / kCornerCell_px;
    const int place = (corner.y % kCornerCell_px) * kCornerCell_px + corner.x % kCornerCell_px;
    auto key = static_cast<std::uint16_t>(corner.score * 256 + 255 - place);
    std::uint16_t* list = keys_.data() + static_cast<std::ptrdiff_t>(cell) * kPerCell;
    for (int k = 0; k < kPerCell; ++k) {
        const std::uint16_t better = list[k] > key ? list[k] : key;
        key = list[k] > key ? key : list[k];
        list[k] = better;
    }
    std::uint8_t& n = count_[static_cast<std::size_t>(cell)];
    n = static_cast<std::uint8_t>(n + (n < kPerCell ? 1 : 0));
}

Corner CornerGrid::corner(int cell, int i) const {
    const int key = keys_[static_cast<std::size_t>(cell * kPerCell + i)];
    const int place = 255 - key % 256;
    return {static_cast<std::int16_t>(cell % kColumns * kCornerCell_px + place % kCornerCell_px),
            static_cast<std::int16_t>(cell / kColumns * kCornerCell_px + place / kCornerCell_px),
            static_cast<std::uint8_t>(key / 256)};
}

void FastDetector::ScoredRow::clear(int width) {
    std::memset(score.data(), 0, static_cast<std::size_t>(width));
    blocks.count = 0;
}

void FastDetector::score_row(const ImageView& image, int y, int threshold, int margin_px, ScoredRow& out) {
    const Circles circles(image, y);
    const U8x16 t = lanes::splat(static_cast<std::uint8_t>(threshold));
    const int last = image.width - margin_px - kBlock;
    possible_.count = 0;
    for (int x = margin_px; x < last + kBlock; x += kBlock) {
        const int from = x < last ? x : last;  // the last block overlaps the one before
        possible_.add_if(may_hold_corner(circles, from, t), from);
    }
    out.clear(image.width);
    for (int k = 0; k < possible_.count; ++k) {
        const int x = possible_.x[static_cast<std::size_t>(k)];
        const U8x16 scores = scores_of(circles, x, t);
        lanes::store(out.score.data() + x, scores);
        out.blocks.add_if(any(scores), x);
    }
}

// 3x3 suppression, again with lists in place of branches. first, last: of the blocks' columns.
void FastDetector::keep_largest(const ScoredRow& above, const ScoredRow& here, const ScoredRow& below, int y, int first,
                                int last, CornerGrid& out) {
    const std::uint32_t beyond_overlap = 0xFFFFU << static_cast<unsigned>((kBlock - (last - first) % kBlock) % kBlock);
    Blocks keeping;
    std::array<std::uint32_t, static_cast<std::size_t>(kMaxImageWidth) / kBlock + 1>
        kept;  // of the blocks in `keeping`
    for (int k = 0; k < here.blocks.count; ++k) {
        const int x = here.blocks.x[static_cast<std::size_t>(k)];
        const std::uint32_t bits = maxima(above.score.data() + x, here.score.data() + x, below.score.data() + x) &
                                   (x == last ? beyond_overlap : 0xFFFFU);
        kept[static_cast<std::size_t>(keeping.count)] = bits;
        keeping.add_if(bits != 0U, x);
    }
    std::array<std::uint16_t, static_cast<std::size_t>(kMaxImageWidth) + kBlock> columns;
    int count = 0;
    for (int k = 0; k < keeping.count; ++k) {
        const std::uint32_t bits = kept[static_cast<std::size_t>(k)];
        for (unsigned i = 0; i < kBlock; ++i) {
            columns[static_cast<std::size_t>(count)] =
                static_cast<std::uint16_t>(keeping.x[static_cast<std::size_t>(k)] + i);
            count += static_cast<int>((bits >> i) & 1U);
        }
    }
    for (int k = 0; k < count; ++k) {
        const std::uint16_t x = columns[static_cast<std::size_t>(k)];
        out.add({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), here.score[x]});
    }
}

Status FastDetector::detect(const ImageView& image, int threshold, int margin_px, CornerGrid& out) {
    out.clear();
    const int margin = margin_px < kRadius + 1 ? kRadius + 1 : margin_px;
    if (image.empty() || image.width > kMaxImageWidth || image.height > kMaxImageHeight ||
        image.width < 2 * margin + kBlock || image.height <= 2 * margin || threshold < 1 || threshold > 254) {
        return Status::kInvalidArgument;
    }
    ScoredRow* above = &rows_[0];
    ScoredRow* here = &rows_[1];
    ScoredRow* below = &rows_[2];
    above->clear(image.width);
    score_row(image, margin, threshold, margin, *here);
    for (int y = margin; y < image.height - margin; ++y) {
        if (y + 1 < image.height - margin) {
            score_row(image, y + 1, threshold, margin, *below);
        } else {
            below->clear(image.width);
        }
        keep_largest(*above, *here, *below, y, margin, image.width - margin - kBlock, out);
        ScoredRow* old = above;
        above = here;
        here = below;
        below = old;
    }
    return Status::kOk;
}

}  // namespace semtrack
