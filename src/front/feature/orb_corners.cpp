#include "front/feature/orb_corners.hpp"

#include <cstring>

namespace semtrack {

namespace {

constexpr int kBlock = 16;  // pixels: a vector register of bytes
constexpr int kRadius = 3;
using Byte = std::uint8_t;

constexpr Byte less(Byte a, Byte b) {
    return a < b ? a : b;
}
constexpr Byte more(Byte a, Byte b) {
    return a > b ? a : b;
}

/// Rows y - 3 .. y + 3.
struct Rows {
    const Byte* at[2 * kRadius + 1];
    Rows(const ImageView& image, int y) {
        for (int dy = -kRadius; dy <= kRadius; ++dy) {
            at[dy + kRadius] = image.row(y + dy);
        }
    }
};

bool any(const Byte* block) {
    std::uint64_t halves[2];
    std::memcpy(halves, block, sizeof(halves));
    return (halves[0] | halves[1]) != 0U;
}

/// An arc of 9 holds a pixel of each opposite pair: the darkest of the pairs' brighter pixels bounds what the arc is
/// brighter by, and the other way round. Four pairs of eight leave few blocks without a corner.
bool may_hold_corner(const Rows& rows, int x, int threshold) {
    const Byte* const* r = rows.at;
    const auto t = static_cast<Byte>(threshold);
    Byte flags[kBlock];
    for (int i = 0; i < kBlock; ++i) {
        const Byte c = r[3][x + i];
        const Byte n = r[0][x + i];
        const Byte s = r[6][x + i];
        const Byte e = r[3][x + i + 3];
        const Byte w = r[3][x + i - 3];
        const Byte ne = r[1][x + i + 2];
        const Byte sw = r[5][x + i - 2];
        const Byte se = r[5][x + i + 2];
        const Byte nw = r[1][x + i - 2];
        const Byte bright = less(less(more(n, s), more(e, w)), less(more(ne, sw), more(se, nw)));
        const Byte dark = more(more(less(n, s), less(e, w)), more(less(ne, sw), less(se, nw)));
        const auto brighter = static_cast<Byte>(more(bright, c) - c);
        const auto darker = static_cast<Byte>(c - less(dark, c));
        const Byte bound = more(brighter, darker);
        flags[i] = static_cast<Byte>(more(bound, t) - t);
    }
    return any(flags);
}

/// Of the circle's 16 pixels: the largest, over all arcs of 9, of an arc's smallest pixel. Two arcs that share 8 pixels,
/// p[2k + 1] .. p[2k + 8], are looked at together.
inline Byte brightest_arc(const Byte* p) {
    Byte two[8] = {};
    Byte four[8] = {};
    Byte best = 0;
    for (int k = 0; k < 8; ++k) {
        two[k] = less(p[2 * k + 1], p[(2 * k + 2) & 15]);
    }
    for (int k = 0; k < 8; ++k) {
        four[k] = less(two[k], two[(k + 1) & 7]);
    }
    for (int k = 0; k < 8; ++k) {
        const Byte eight = less(four[k], four[(k + 2) & 7]);
        best = more(best, less(eight, more(p[2 * k], p[(2 * k + 9) & 15])));
    }
    return best;
}

/// The same with dark and bright exchanged.
inline Byte darkest_arc(const Byte* p) {
    Byte two[8] = {};
    Byte four[8] = {};
    Byte best = 255;
    for (int k = 0; k < 8; ++k) {
        two[k] = more(p[2 * k + 1], p[(2 * k + 2) & 15]);
    }
    for (int k = 0; k < 8; ++k) {
        four[k] = more(two[k], two[(k + 1) & 7]);
    }
    for (int k = 0; k < 8; ++k) {
        const Byte eight = more(four[k], four[(k + 2) & 7]);
        best = less(best, more(eight, less(p[2 * k], p[(2 * k + 9) & 15])));
    }
    return best;
}

void score_block(const Rows& rows, int x, int threshold, Byte* scores) {
    const Byte* const* r = rows.at;
    const auto t = static_cast<Byte>(threshold);
    Byte out[kBlock];
    for (int i = 0; i < kBlock; ++i) {
        const Byte c = r[3][x + i];
        const Byte p[16] = {r[0][x + i],     r[0][x + i + 1], r[1][x + i + 2], r[2][x + i + 3], r[3][x + i + 3], r[4][x + i + 3],
                            r[5][x + i + 2], r[6][x + i + 1], r[6][x + i],     r[6][x + i - 1], r[5][x + i - 2], r[4][x + i - 3],
                            r[3][x + i - 3], r[2][x + i - 3], r[1][x + i - 2], r[0][x + i - 1]};
        const auto brighter = static_cast<Byte>(more(brightest_arc(p), c) - c);
        const auto darker = static_cast<Byte>(c - less(darkest_arc(p), c));
        const Byte best = more(brighter, darker);
        out[i] = static_cast<Byte>(best > t ? best - 1 : 0);
    }
    std::memcpy(scores, out, sizeof(out));
}

}  // namespace

// Blocks are listed first and scored then: whether one may hold a corner is hard to guess, and a branch on it would cost
// more than the test. The last block may reach beyond the range, into the margin and the row's end; that part is cut.
void OrbCorners::score_row(const ImageView& image, int y, int threshold, ScoredRow& out) {
    const int end = image.width - kMargin_px;
    const Rows rows(image, y);
    int blocks = 0;
    for (int x = kMargin_px; x < end; x += kBlock) {
        out.block[static_cast<std::size_t>(blocks)] = static_cast<std::uint16_t>(x);
        blocks += may_hold_corner(rows, x, threshold) ? 1 : 0;
    }
    std::memset(out.score.data(), 0, static_cast<std::size_t>(image.width));
    out.blocks = 0;
    for (int k = 0; k < blocks; ++k) {
        const std::uint16_t x = out.block[static_cast<std::size_t>(k)];
        score_block(rows, x, threshold, out.score.data() + x);
        out.block[static_cast<std::size_t>(out.blocks)] = x;
        out.blocks += any(out.score.data() + x) ? 1 : 0;
    }
    std::memset(out.score.data() + end, 0, kMargin_px);
}

// 3 x 3 suppression; of equal neighbours the earlier one in raster order stays. Again lists instead of branches.
void OrbCorners::keep_largest(const ScoredRow& above, const ScoredRow& here, const ScoredRow& below, int y,
                              CornerGrid& out) {
    std::uint16_t columns[kMaxImageWidth];
    int count = 0;
    for (int k = 0; k < here.blocks; ++k) {
        const int x = here.block[static_cast<std::size_t>(k)];
        const Byte* up = above.score.data() + x;
        const Byte* at = here.score.data() + x;
        const Byte* down = below.score.data() + x;
        Byte kept[kBlock];
        for (int i = 0; i < kBlock; ++i) {
            const Byte s = at[i];
            const Byte before = more(more(up[i - 1], up[i]), more(up[i + 1], at[i - 1]));
            const Byte after = more(more(down[i - 1], down[i]), more(down[i + 1], at[i + 1]));
            const auto over_before = static_cast<Byte>(more(s, before) - before);
            const auto under_after = static_cast<Byte>(more(s, after) - s);
            kept[i] = under_after == 0 ? over_before : Byte{0};
        }
        if (!any(kept)) {
            continue;
        }
        for (int i = 0; i < kBlock; ++i) {
            columns[count] = static_cast<std::uint16_t>(x + i);
            count += kept[i] != 0 ? 1 : 0;
        }
    }
    for (int k = 0; k < count; ++k) {
        const std::uint16_t x = columns[k];
        out.add({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), here.score[x]});
    }
}

void OrbCorners::detect(const ImageView& image, int threshold, CornerGrid& out) {
    out.clear();
    ScoredRow* above = &rows_[0];
    ScoredRow* here = &rows_[1];
    ScoredRow* below = &rows_[2];
    std::memset(above->score.data(), 0, static_cast<std::size_t>(image.width));
    score_row(image, kMargin_px, threshold, *here);
    for (int y = kMargin_px; y < image.height - kMargin_px; ++y) {
        if (y + 1 < image.height - kMargin_px) {
            score_row(image, y + 1, threshold, *below);
        } else {
            std::memset(below->score.data(), 0, static_cast<std::size_t>(image.width));
        }
        keep_largest(*above, *here, *below, y, out);
        ScoredRow* const old = above;
        above = here;
        here = below;
        below = old;
    }
}

}  // namespace semtrack
