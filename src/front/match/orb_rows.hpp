// Keypoints of one owner by image row: candidates of a band without looking at the others.
#ifndef SEMTRACK_FRONT_MATCH_ORB_ROWS_HPP
#define SEMTRACK_FRONT_MATCH_ORB_ROWS_HPP

#include <array>
#include <cstdint>

#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

/// [begin, end) of a list.
struct KeypointRange {
    int begin{0};
    int end{0};
};

/// Owners' blocks in a list that is sorted by owner.
class OwnerBlocks {
public:
    void build(const Keypoints& points) {
        int i = 0;
        for (int owner = 0; owner < kMaxOwners; ++owner) {
            KeypointRange& block = blocks_[static_cast<std::size_t>(owner)];
            block.begin = i;
            while (i < points.size() && points[i].owner == owner) {
                ++i;
            }
            block.end = i;
        }
    }
    [[nodiscard]] KeypointRange of(int owner) const { return blocks_[static_cast<std::size_t>(owner)]; }

private:
    std::array<KeypointRange, static_cast<std::size_t>(kMaxOwners)> blocks_{};
};

class KeypointRows {
public:
    /// The block must be sorted by v, rows within the image's height. Cost O(height + block).
    void build(const Keypoints& points, KeypointRange block, int height) {
        height_ = height < kMaxImageHeight ? height : kMaxImageHeight;
        int i = block.begin;
        for (int row = 0; row < height_; ++row) {
            first_[static_cast<std::size_t>(row)] = static_cast<std::uint16_t>(i);
            while (i < block.end && points[i].v < static_cast<float>(row + 1)) {
                ++i;
            }
        }
        first_[static_cast<std::size_t>(height_)] = static_cast<std::uint16_t>(block.end);
    }
    /// Keypoints whose row lies in [from, to] rounded outwards; empty for a band outside the image or not finite.
    [[nodiscard]] KeypointRange band(double from, double to) const {
        if (!(from < static_cast<double>(height_)) || !(to > -1.0) || !(from <= to)) {
            return {};
        }
        const int top = from > 0.0 ? static_cast<int>(from) : 0;
        const int bottom = to < static_cast<double>(height_ - 1) ? (to > 0.0 ? static_cast<int>(to) : 0) : height_ - 1;
        return {first_[static_cast<std::size_t>(top)], first_[static_cast<std::size_t>(bottom + 1)]};
    }

private:
    int height_{0};
    std::array<std::uint16_t, static_cast<std::size_t>(kMaxImageHeight) + 1> first_{};
};

}  // namespace semtrack

#endif
