// Half-size image with its local mean taken off: coarse searches see structure, not brightness. The two cameras of a
// pair differ by 4-16 grey levels and exposure changes from frame to frame.
#ifndef SEMTRACK_FRONT_MATCH_PATCH_IMAGE_HPP
#define SEMTRACK_FRONT_MATCH_PATCH_IMAGE_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/lanes.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

class PatchImage {
public:
    static constexpr int kHalfWidth = kMaxImageWidth / 2;
    static constexpr int kHalfHeight = kMaxImageHeight / 2;

    static constexpr int kMinSide_px = 32;  ///< of an image that build() takes

    /// 2x2 averages minus their mean over 9x9 (borders repeated), about 128, clamped to 8 bits.
    void build(const ImageView& image);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const std::uint8_t* row(int y) const { return flat_.data() + y * kHalfWidth; }

private:
    void halve(const ImageView& image);
    void flatten_row(int y);
    int width_{0};
    int height_{0};
    std::array<std::uint8_t, static_cast<std::size_t>(kHalfWidth) * kHalfHeight> half_{};
    std::array<std::uint8_t, static_cast<std::size_t>(kHalfWidth) * kHalfHeight> flat_{};
    std::array<std::int16_t, static_cast<std::size_t>(kHalfWidth) + 16> column_{};  // sums over 9 rows, with borders
};

inline constexpr int kCoarse = 8;  ///< side of a coarse patch, half-size px
using CoarsePatch = std::array<std::uint8_t, static_cast<std::size_t>(kCoarse) * kCoarse>;

/// Top-left corner of the coarse patch about a full-resolution coordinate. A patch that was taken about u0 and is found
/// again at corner c lies at u0 + 2 (c - coarse_corner(u0)), to a pixel.
[[nodiscard]] inline int coarse_corner(float full) {
    return static_cast<int>(full * 0.5F) - kCoarse / 2 + 1;
}

[[nodiscard]] inline bool coarse_inside(const PatchImage& image, int x, int y) {
    return x >= 0 && y >= 0 && x + kCoarse <= image.width() && y + kCoarse <= image.height();
}
/// Where the minimum lies between three distances at -1, 0, 1: -0.5 .. 0.5 (parabola).
[[nodiscard]] inline float parabola_offset(int before, int here, int after) {
    const int curvature = before - 2 * here + after;
    if (curvature <= 0) {
        return 0.0F;
    }
    const float offset = 0.5F * static_cast<float>(before - after) / static_cast<float>(curvature);
    return offset < -0.5F ? -0.5F : offset > 0.5F ? 0.5F : offset;
}
/// Where the rows of a coarse patch are looked up: row r of a patch about (x, y) at offset[r] from its corner. A
/// slanted surface moves its rows sideways; upright ones do not.
class CoarseRows {
public:
    static constexpr int kLargestShift = 2;  ///< px to either side

    CoarseRows() : CoarseRows(0.0F) {}
    /// shift_per_row: columns that a row further down lies to the right.
    explicit CoarseRows(float shift_per_row);
    [[nodiscard]] bool inside(const PatchImage& image, int x, int y) const {
        return coarse_inside(image, x - margin_, y) && coarse_inside(image, x + margin_, y);
    }
    [[nodiscard]] std::ptrdiff_t offset(int r) const { return offset_[static_cast<std::size_t>(r)]; }
    [[nodiscard]] int margin() const { return margin_; }

private:
    std::array<std::ptrdiff_t, static_cast<std::size_t>(kCoarse)> offset_{};
    int margin_{0};
};

void copy_coarse(const PatchImage& image, int x, int y, const CoarseRows& rows, CoarsePatch& out);

/// A coarse patch ready to be compared with many places.
class CoarseTemplate {
public:
    explicit CoarseTemplate(const CoarsePatch& patch) {
        for (std::size_t k = 0; k < kPairs; ++k) {
            rows_[k] = lanes::load(patch.data() + 2 * kCoarse * k);
        }
    }
    /// Sum of absolute differences at a corner that is inside.
    [[nodiscard]] int distance(const PatchImage& image, int x, int y, const CoarseRows& rows) const {
        const std::uint8_t* p = image.row(y) + x;
        lanes::SadSum sum;
        for (int k = 0; k < static_cast<int>(kPairs); ++k) {
            sum.add(rows_[k], lanes::load_halves(p + rows.offset(2 * k), p + rows.offset(2 * k + 1)));
        }
        return sum.total();
    }

private:
    static constexpr std::size_t kPairs = kCoarse / 2;
    lanes::U8x16 rows_[kPairs];  // two rows each
};

}  // namespace semtrack

#endif
