#include "front/feature/select.hpp"

#include <cstring>

namespace semtrack {

namespace {
constexpr int kMaxRounds = 8;
}

void CornerSelector::begin(int width, int height) {
    width_ = width;
    height_ = height;
    occupied_.fill(0);
    background_filled_.fill(0);
}

void CornerSelector::block(int x, int y) {
    occupied_[static_cast<std::size_t>((y / kFine_px) * kFineColumns + x / kFine_px)] = 1;
}

bool CornerSelector::is_free(int x, int y) const {
    constexpr int kReach = kMinDistance_px / kFine_px;
    const int cx = x / kFine_px;
    const int cy = y / kFine_px;
    for (int r = cy - kReach; r <= cy + kReach; ++r) {
        for (int c = cx - kReach; c <= cx + kReach; ++c) {
            if (r < 0 || c < 0 || r >= kFineRows || c >= kFineColumns) {
                continue;
            }
            if (occupied_[static_cast<std::size_t>(r * kFineColumns + c)] != 0) {
                return false;
            }
        }
    }
    return true;
}

void CornerSelector::occupy(int owner, float u, float v) {
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    if (x < 0 || y < 0 || x >= width_ || y >= height_) {
        return;
    }
    block(x, y);
    if (owner == 0) {
        const int columns = (width_ + kBackgroundCell_px - 1) / kBackgroundCell_px;
        ++background_filled_[static_cast<std::size_t>((y / kBackgroundCell_px) * columns + x / kBackgroundCell_px)];
    }
}

// Counting sort by owner; within an owner the order of the cells.
void CornerSelector::bucket(const CornerGrid& grid, const OwnerMaskView& mask) {
    first_.fill(0);
    int n = 0;  // corners that somebody owns
    for (int cell = 0; cell < grid.cells(); ++cell) {
        const int in_cell = grid.count(cell);
        for (int i = 0; i < in_cell; ++i) {
            const Corner c = grid.corner(cell, i);
            const std::uint8_t owner = mask.at(c.x, c.y);
            if (owner < kMaxOwners) {
                sorted_[static_cast<std::size_t>(n)] = c;
                owner_[static_cast<std::size_t>(n)] = owner;
                ++first_[static_cast<std::size_t>(owner) + 1U];
                ++n;
            }
        }
    }
    for (std::size_t o = 1; o < first_.size(); ++o) {
        first_[o] += first_[o - 1];
    }
    auto at = first_;
    for (int i = 0; i < n; ++i) {
        corners_[static_cast<std::size_t>(at[owner_[static_cast<std::size_t>(i)]]++)] =
            sorted_[static_cast<std::size_t>(i)];
    }
}

// Stable counting sort, best score first: ties keep the order of the cells.
void CornerSelector::sort_by_score(int begin, int end) {
    std::array<int, 257> start{};
    for (int i = begin; i < end; ++i) {
        ++start[static_cast<std::size_t>(256 - corners_[static_cast<std::size_t>(i)].score)];
    }
    int sum = begin;
    for (int& s : start) {
        const int n = s;
        s = sum;
        sum += n;
    }
    for (int i = begin; i < end; ++i) {
        const Corner& c = corners_[static_cast<std::size_t>(i)];
        sorted_[static_cast<std::size_t>(start[static_cast<std::size_t>(256 - c.score)]++)] = c;
    }
}

void CornerSelector::choose(int owner, int begin, int end, int budget, SelectedCorners& out) {
    const int cell_px = owner == 0 ? kBackgroundCell_px : kObjectCell_px;
    const int columns = (width_ + cell_px - 1) / cell_px;
    const int cells = columns * ((height_ + cell_px - 1) / cell_px);
    std::memset(filled_.data(), 0, static_cast<std::size_t>(cells));
    int taken = 0;
    for (int round = 1; round <= kMaxRounds && taken < budget; ++round) {
        for (int i = begin; i < end && taken < budget; ++i) {
            Corner& c = sorted_[static_cast<std::size_t>(i)];
            if (c.score == 0) {
                continue;
            }  // taken, or too near to another
            const auto cell = static_cast<std::size_t>((c.y / cell_px) * columns + c.x / cell_px);
            const int alive = owner == 0 ? background_filled_[cell] : 0;
            if (filled_[cell] + alive >= round) {
                continue;
            }
            const SelectedCorner chosen{c, static_cast<std::uint8_t>(owner)};
            c.score = 0;
            if (!is_free(chosen.corner.x, chosen.corner.y)) {
                continue;
            }
            if (!out.try_push_back(chosen)) {
                return;
            }
            block(chosen.corner.x, chosen.corner.y);
            ++filled_[cell];
            ++taken;
        }
    }
}

void CornerSelector::select(const CornerGrid& grid, const OwnerMaskView& mask, const FeatureBudget& budget,
                            SelectedCorners& out) {
    out.clear();
    bucket(grid, mask);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        const auto o = static_cast<std::size_t>(owner);
        const int begin = first_[o];
        const int end = first_[o + 1];
        if (budget[o] <= 0 || begin == end) {
            continue;
        }
        sort_by_score(begin, end);
        choose(owner, begin, end, budget[o], out);
    }
}

}  // namespace semtrack
