#include "front/feature/orb_strongest.hpp"

namespace semtrack {

// Stable counting sort, best score first.
void StrongestCorners::select(const CornerGrid& grid, const OwnerMaskView& mask, const FeatureBudget& budget,
                              SelectedCorners& out) {
    out.clear();
    std::array<int, 257> start{};  // where each score begins
    for (int cell = 0; cell < grid.cells(); ++cell) {
        for (int i = 0; i < grid.count(cell); ++i) {
            ++start[static_cast<std::size_t>(256 - grid.score(cell, i))];
        }
    }
    int total = 0;
    for (int& s : start) {
        const int n = s;
        s = total;
        total += n;
    }
    for (int cell = 0; cell < grid.cells(); ++cell) {
        for (int i = 0; i < grid.count(cell); ++i) {
            int& place = start[static_cast<std::size_t>(256 - grid.score(cell, i))];
            sorted_[static_cast<std::size_t>(place++)] = static_cast<std::uint16_t>(cell * CornerGrid::kPerCell + i);
        }
    }
    FeatureBudget left = budget;
    for (int k = 0; k < total; ++k) {
        const int number = sorted_[static_cast<std::size_t>(k)];
        const Corner corner = grid.corner(number / CornerGrid::kPerCell, number % CornerGrid::kPerCell);
        const std::uint8_t owner = mask.at(corner.x, corner.y);
        if (owner >= kMaxOwners || left[owner] <= 0) {
            continue;
        }
        if (!out.try_push_back({corner, owner})) {
            return;
        }
        --left[owner];
    }
}

}  // namespace semtrack
