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

/// With kBright the largest, over all arcs of 9 of the circle p0 .. p15, of the arc's smallest pixel; else the smallest
/// of the largest. Two arcs that share 8 pixels are looked at together. Written out: compilers make vectors of a loop's
/// straight body more readily than of loops within.
template <bool kBright>
struct Arcs {
    static constexpr Byte in(Byte a, Byte b) { return kBright ? less(a, b) : more(a, b); }
    static constexpr Byte out(Byte a, Byte b) { return kBright ? more(a, b) : less(a, b); }

    static Byte best(const Byte* const* r, int x) {
        const Byte p0 = r[0][x], p1 = r[0][x + 1], p2 = r[1][x + 2], p3 = r[2][x + 3];
        const Byte p4 = r[3][x + 3], p5 = r[4][x + 3], p6 = r[5][x + 2], p7 = r[6][x + 1];
        const Byte p8 = r[6][x], p9 = r[6][x - 1], p10 = r[5][x - 2], p11 = r[4][x - 3];
        const Byte p12 = r[3][x - 3], p13 = r[2][x - 3], p14 = r[1][x - 2], p15 = r[0][x - 1];
        const Byte two1 = in(p1, p2), two3 = in(p3, p4), two5 = in(p5, p6), two7 = in(p7, p8);
        const Byte two9 = in(p9, p10), two11 = in(p11, p12), two13 = in(p13, p14), two15 = in(p15, p0);
        const Byte four1 = in(two1, two3), four3 = in(two3, two5), four5 = in(two5, two7), four7 = in(two7, two9);
        const Byte four9 = in(two9, two11), four11 = in(two11, two13), four13 = in(two13, two15);
        const Byte four15 = in(two15, two1);
        const Byte a = out(in(in(four1, four5), out(p0, p9)), in(in(four3, four7), out(p2, p11)));
        const Byte b = out(in(in(four5, four9), out(p4, p13)), in(in(four7, four11), out(p6, p15)));
        const Byte c = out(in(in(four9, four13), out(p8, p1)), in(in(four11, four15), out(p10, p3)));
        const Byte d = out(in(in(four13, four1), out(p12, p5)), in(in(four15, four3), out(p14, p7)));
        return out(out(a, b), out(c, d));
    }
};

void score_block(const Rows& rows, int x, int threshold, Byte* scores) {
    const Byte* const* r = rows.at;
    const auto t = static_cast<Byte>(threshold);
    Byte block[kBlock];
    for (int i = 0; i < kBlock; ++i) {
        const Byte c = r[3][x + i];
        const auto brighter = static_cast<Byte>(more(Arcs<true>::best(r, x + i), c) - c);
        const auto darker = static_cast<Byte>(c - less(Arcs<false>::best(r, x + i), c));
        const Byte over = more(brighter, darker);
        block[i] = static_cast<Byte>(over > t ? over - 1 : 0);
    }
    std::memcpy(scores, block, sizeof(block));
}

/// A block of three rows' scores: 0 where the middle one is not the largest of its 3 x 3.
void suppress(const Byte* above, const Byte* here, const Byte* below, Byte* kept) {
    Byte block[kBlock];
    for (int i = 0; i < kBlock; ++i) {
        const Byte s = here[i];
        const Byte before = more(more(above[i - 1], above[i]), more(above[i + 1], here[i - 1]));
        const Byte after = more(more(below[i - 1], below[i]), more(below[i + 1], here[i + 1]));
        const auto over_before = static_cast<Byte>(more(s, before) - before);
        const auto under_after = static_cast<Byte>(more(s, after) - s);
        block[i] = under_after == 0 ? over_before : Byte{0};
    }
    std::memcpy(kept, block, sizeof(block));
}

}  // namespace

// Blocks are listed first and scored then: whether one may hold a corner is hard to guess, and a branch on it would
// cost more than the test. The last block may reach beyond the range, into the margin and the row's end; that part is
// cut.
void OrbCorners::score_row(const ImageView& image, int y, int threshold, ScoredRow& out) {
    const int end = image.width - kMargin_px;
    const Rows rows(image, y);
    Blocks possible;
    for (int x = kMargin_px; x < end; x += kBlock) {
        possible.add_if(may_hold_corner(rows, x, threshold), x);
    }
    Byte* const score = out.score.data();
    std::memset(score, 0, static_cast<std::size_t>(image.width));
    out.blocks.count = 0;
    for (int k = 0; k < possible.count; ++k) {
        const int x = possible.x[k];
        score_block(rows, x, threshold, score + x);
        out.blocks.add_if(any(score + x), x);
    }
    std::memset(score + end, 0, kMargin_px);
}

// 3 x 3 suppression; of equal neighbours the earlier one in raster order stays. Again lists in place of branches: of
// the blocks that keep something, then of the pixels that are kept.
void OrbCorners::keep_largest(const ScoredRow& above, const ScoredRow& here, const ScoredRow& below, int y,
                              CornerGrid& out) {
    Byte kept[kMaxImageWidth];  // not 0: stays; only the listed blocks are written and read
    Blocks keeping;
    for (int k = 0; k < here.blocks.count; ++k) {
        const int x = here.blocks.x[k];
        suppress(above.score.data() + x, here.score.data() + x, below.score.data() + x, kept + x);
        keeping.add_if(any(kept + x), x);
    }
    std::uint16_t columns[kMaxImageWidth];
    int count = 0;
    for (int k = 0; k < keeping.count; ++k) {
        const int begin = keeping.x[k];
        for (int x = begin; x < begin + kBlock; ++x) {
            columns[count] = static_cast<std::uint16_t>(x);
            count += kept[x] != 0 ? 1 : 0;
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
