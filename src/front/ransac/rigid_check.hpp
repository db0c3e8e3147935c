// Rigid motion of stereo points before and after: decides where the epipolar geometry is degenerate (standing ego, far
// objects, pure forward motion with few points).
#ifndef SEMTRACK_FRONT_RANSAC_RIGID_CHECK_HPP
#define SEMTRACK_FRONT_RANSAC_RIGID_CHECK_HPP

#include <cstdint>

#include "front/ransac/point_pairs.hpp"
#include "math/pose.hpp"

namespace semtrack {

class RigidCheck {
public:
    /// Fixed number of trials of three points each; a motion is refined on those that agree. Flags pairs whose left
    /// position and disparity are met within threshold_px; returns how many. fb: focal length x baseline, focal in px.
    /// 0: fewer than four pairs, or no motion explains three of them.
    int run(const StereoPairs& pairs, double focal_px, double fb, double threshold_px, std::uint32_t seed,
            PairFlags& agrees);

private:
    int test(const StereoPairs& pairs, const Pose& T, double focal_px, double fb, double threshold_px,
             PairFlags& agrees) const;
    [[nodiscard]] bool refine(const StereoPairs& pairs, const PairFlags* use, const int* sample, int count,
                              double focal_px, double fb, Pose& T) const;
    PairFlags trial_{};
};

}  // namespace semtrack

#endif
