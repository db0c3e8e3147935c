// Rigid motion of stereo points before and after: decides where the epipolar geometry is degenerate (standing ego,
// few points), and sees errors along the epipolar line, which a fundamental matrix cannot.
#ifndef SEMTRACK_FRONT_RANSAC_RIGID_CHECK_HPP
#define SEMTRACK_FRONT_RANSAC_RIGID_CHECK_HPP

#include <array>
#include <cstdint>

#include "front/ransac/point_pairs.hpp"
#include "math/pose.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

class RigidCheck {
public:
    static constexpr int kMinPairs = 5;

    /// Bounded number of trials of three points each; the best motion is refined on the pairs that agree. A pair agrees
    /// when u, v and disparity are each met within threshold_px, widened by what 1.5 px of disparity in the frame
    /// before would change. Returns how many agree; 0: fewer than kMinPairs pairs, or no motion explains as many.
    int run(const StereoPairs& pairs, const Calibration& calibration, double threshold_px, std::uint32_t seed,
            PairFlags& agrees);
    /// Motion of the last run that did not return 0: before -> now, camera frame.
    [[nodiscard]] const Pose& motion() const { return motion_; }
    /// Does a pair without depth fit the motion at some depth from the nearest on? u, v relative to the principal
    /// point, px.
    [[nodiscard]] bool fits_some_depth(const Calibration& calibration, double u_before, double v_before, double u,
                                       double v, double threshold_px) const;

private:
    struct Intrinsics {
        double fx;
        double fy;
        double fb;  ///< fx x baseline
    };
    int test(const StereoPairs& pairs, const Intrinsics& k, const Pose& T, double threshold_px,
             PairFlags& agrees) const;
    [[nodiscard]] bool refine(const StereoPairs& pairs, const Intrinsics& k, const int* items, int count,
                              Pose& T) const;
    [[nodiscard]] Pose start(const StereoPairs& pairs, const Intrinsics& k, const int* items, int count) const;

    PairFlags trial_{};
    std::array<int, kMaxPairs> items_{};
    Pose motion_{};
};

}  // namespace semtrack

#endif
