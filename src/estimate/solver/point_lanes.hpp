// What one frame says of many points, structure of arrays: one lane per point, so that plain loops over the lanes
// vectorise without changing a bit (each lane is computed on its own; sums over lanes have a fixed order).
#ifndef SEMTRACK_ESTIMATE_SOLVER_POINT_LANES_HPP
#define SEMTRACK_ESTIMATE_SOLVER_POINT_LANES_HPP

#include <array>

#include "semtrack/capacity.hpp"

namespace semtrack {

inline constexpr int kPointLanes = kMaxObjectFeatures;
/// Loops over lanes run to the next multiple: the lanes behind the last point hold zeros.
inline constexpr int kLaneGroup = 8;
static_assert(kPointLanes % kLaneGroup == 0, "a group of lanes is never cut");

using Lane = std::array<double, static_cast<std::size_t>(kPointLanes)>;

[[nodiscard]] constexpr std::size_t padded_lanes(int count) {
    return static_cast<std::size_t>((count + kLaneGroup - 1) / kLaneGroup * kLaneGroup);
}

/// J_f, J_x: Jacobians of the residuals by the point and by the frame's coupled columns; W: their weights.
struct PointLanes {
    std::array<bool, static_cast<std::size_t>(kPointLanes)> seen{};
    std::array<Lane, 6> C{};    ///< J_f^T W J_f: 00 01 02 11 12 22
    std::array<Lane, 3> w{};    ///< J_f^T W r
    std::array<Lane, 18> Et{};  ///< J_f^T W J_x, row by row of the coupled columns
};

/// Eight sums side by side, then pairwise: the same order everywhere. count: a multiple of kLaneGroup.
[[nodiscard]] inline double sum_lanes(const Lane& a, std::size_t count) {
    std::array<double, kLaneGroup> s{};
    for (std::size_t p = 0; p < count; p += kLaneGroup) {
        for (std::size_t l = 0; l < kLaneGroup; ++l) {
            s[l] += a[p + l];
        }
    }
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

}  // namespace semtrack

#endif
