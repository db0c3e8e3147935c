// Points side by side: one lane per point, one row per number. Two lanes are computed at once (math/double2.hpp).
#ifndef SEMTRACK_ESTIMATE_SOLVER_POINT_LANES_HPP
#define SEMTRACK_ESTIMATE_SOLVER_POINT_LANES_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "semtrack/capacity.hpp"

namespace semtrack {

inline constexpr int kFrameBlock = 6;
inline constexpr int kSharedBlock = 3;
inline constexpr int kPointBlock = 3;
inline constexpr int kSolverPoints = kMaxBackgroundFeatures;
inline constexpr int kPoseFrames = 4;  ///< camera poses that move: the ego window's newest

/// Columns of a frame that its points couple to.
enum class Coupling : std::uint8_t {
    kPose = 6,    ///< all; up to kPoseFrames frames and kSolverPoints points
    kPlanar = 4,  ///< the leading four: (p, theta) of an object; up to kMaxObjectFeatures points
};

inline constexpr std::size_t kLaneBytes = 16;  ///< alignment of rows
/// Loops over points run to the next multiple; the lanes behind the last point hold zeros.
inline constexpr int kLaneGroup = 2;
[[nodiscard]] constexpr std::size_t padded_lanes(int points) {
    return static_cast<std::size_t>((points + kLaneGroup - 1) / kLaneGroup * kLaneGroup);
}

/// Distance of rows. A power of two would put all rows into the same sets of a cache.
inline constexpr std::size_t kPointStride = static_cast<std::size_t>(kSolverPoints) + 8U;
template <Coupling kCoupling>
inline constexpr std::size_t kCouplingStride = kCoupling == Coupling::kPose
                                                   ? kPointStride
                                                   : static_cast<std::size_t>(kMaxObjectFeatures) + 8U;
template <Coupling kCoupling>
inline constexpr std::size_t kCoupled = static_cast<std::size_t>(kCoupling);

using PointRow = std::array<double, kPointStride>;

/// Where a frame writes what it says of the points. J_f, J_x: Jacobians by the point and by the frame's coupled
/// columns, W: weights. Every lane up to padded_lanes() is to be written; zeros where the frame did not see the point.
struct FramePoints {
    std::array<PointRow, 6>& C;  ///< J_f^T W J_f: 00 01 02 11 12 22; adds up over the frames
    std::array<PointRow, 3>& w;  ///< J_f^T W r; adds up
    double* Et;                  ///< J_f^T W J_x, row by row of the coupled columns, kCouplingStride apart
};

}  // namespace semtrack

#endif
