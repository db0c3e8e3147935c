// FAST-9 corners with score and non-maximum suppression, kept best-first per cell so that memory and cost stay bounded
// whatever the image holds. Integers only.
#ifndef SEMTRACK_FRONT_FEATURE_FAST_HPP
#define SEMTRACK_FRONT_FEATURE_FAST_HPP

#include <array>
#include <cstdint>

#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

struct Corner {
    std::int16_t x{0};
    std::int16_t y{0};
    std::uint8_t score{0};  ///< largest threshold at which it is still a corner
};

/// Cells of kCornerCell_px, each with its best corners. Ties go to the earlier raster position: the order is total.
class CornerGrid {
public:
    static constexpr int kCornerCell_px = 16;
    static constexpr int kPerCell = 6;
    static constexpr int kColumns = (kMaxImageWidth + kCornerCell_px - 1) / kCornerCell_px;
    static constexpr int kRows = (kMaxImageHeight + kCornerCell_px - 1) / kCornerCell_px;
    static constexpr int kMaxCorners = kColumns * kRows * kPerCell;

    void clear();
    void add(const Corner& corner);
    [[nodiscard]] int cells() const { return kColumns * kRows; }
    [[nodiscard]] int count(int cell) const { return count_[static_cast<std::size_t>(cell)]; }
    [[nodiscard]] Corner corner(int cell, int i) const;
    [[nodiscard]] int score(int cell, int i) const {
        return keys_[static_cast<std::size_t>(cell * kPerCell + i)] / 256;
    }

private:
    // Score, then 255 minus the place in the cell's raster, best first; 0: none.
    std::array<std::uint16_t, static_cast<std::size_t>(kMaxCorners)> keys_{};
    std::array<std::uint8_t, static_cast<std::size_t>(kColumns) * kRows> count_{};
};

class FastDetector {
public:
    /// Corners at least margin_px (3 or more) from the border: 9 contiguous of the 16 pixels on the circle of radius 3
    /// are all brighter than the centre + threshold or all darker than the centre - threshold. 3x3 suppression.
    /// kInvalidArgument: no image, one beyond the capacity, or
    /// fewer than 16 columns inside the margins. Cost O(pixels).
    Status detect(const ImageView& image, int threshold, int margin_px, CornerGrid& out);

private:
    /// Where blocks of 16 pixels begin. Adding has no branch: whether a block holds a corner is hard to guess, and a
    /// wrong guess costs more than the test.
    struct Blocks {
        std::array<std::uint16_t, static_cast<std::size_t>(kMaxImageWidth) / 16 + 1> x{};
        int count{0};
        void add_if(bool wanted, int column) {
            x[static_cast<std::size_t>(count)] = static_cast<std::uint16_t>(column);
            count += wanted ? 1 : 0;
        }
    };
    struct ScoredRow {
        std::array<std::uint8_t, static_cast<std::size_t>(kMaxImageWidth)> score{};  // 0: no corner
        Blocks blocks{};                                                             // that hold scores
        void clear(int width);
    };
    void score_row(const ImageView& image, int y, int threshold, int margin_px, ScoredRow& out);
    void keep_largest(const ScoredRow& above, const ScoredRow& here, const ScoredRow& below, int y, int first, int last,
                      CornerGrid& out);

    std::array<ScoredRow, 3> rows_{};
    Blocks possible_{};
};

}  // namespace semtrack

#endif
