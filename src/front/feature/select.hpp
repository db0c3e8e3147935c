// Which corners become features: spread over a grid, per owner, best first, before anything costly is computed.
#ifndef SEMTRACK_FRONT_FEATURE_SELECT_HPP
#define SEMTRACK_FRONT_FEATURE_SELECT_HPP

#include <array>
#include <cstdint>

#include "front/feature/fast.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

struct SelectedCorner {
    Corner corner{};
    std::uint8_t owner{0};
};
using SelectedCorners = StaticVector<SelectedCorner, kMaxFeatures>;

class CornerSelector {
public:
    /// Starts a selection: nothing is occupied.
    void begin(int width, int height);
    /// A feature that lives: no new one within kMinDistance_px, and its cell counts as filled.
    void occupy(int owner, float u, float v);
    /// Takes up to budget[owner] corners of each owner that the mask shows there, in rounds: the best of every cell,
    /// then the second best, ... Sorted by owner, then by the order of choice. Cost O(corners).
    void select(const CornerGrid& grid, const OwnerMaskView& mask, const FeatureBudget& budget, SelectedCorners& out);

    static constexpr int kMinDistance_px = 6;

private:
    static constexpr int kFine_px = 3;  // resolution of "occupied"
    static constexpr int kObjectCell_px = 8;
    static constexpr int kBackgroundCell_px = 32;
    static constexpr int kFineColumns = (kMaxImageWidth + kFine_px - 1) / kFine_px;
    static constexpr int kFineRows = (kMaxImageHeight + kFine_px - 1) / kFine_px;
    static constexpr int kCells = ((kMaxImageWidth + kObjectCell_px - 1) / kObjectCell_px) *
                                  ((kMaxImageHeight + kObjectCell_px - 1) / kObjectCell_px);

    void bucket(const CornerGrid& grid, const OwnerMaskView& mask);
    void sort_by_score(int begin, int end);
    void choose(int owner, int begin, int end, int budget, SelectedCorners& out);
    [[nodiscard]] bool is_free(int x, int y) const;
    void block(int x, int y);

    std::array<std::uint8_t, static_cast<std::size_t>(kFineColumns) * kFineRows> occupied_{};
    std::array<std::uint8_t, static_cast<std::size_t>(kCells)> filled_{};
    std::array<std::uint16_t, static_cast<std::size_t>(kCells)> background_filled_{};
    std::array<Corner, static_cast<std::size_t>(CornerGrid::kMaxCorners)> corners_{};  // by owner
    std::array<Corner, static_cast<std::size_t>(CornerGrid::kMaxCorners)> sorted_{};
    std::array<std::uint8_t, static_cast<std::size_t>(CornerGrid::kMaxCorners)> owner_{};
    std::array<int, static_cast<std::size_t>(kMaxOwners) + 1> first_{};
    int width_{0};
    int height_{0};
};

}  // namespace semtrack

#endif
