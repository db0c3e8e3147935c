// What the truth's own noise hides: the steps of a trajectory against those of other odometries on the same images.
#ifndef SEMTRACK_SIL_METRICS_AGREEMENT_HPP
#define SEMTRACK_SIL_METRICS_AGREEMENT_HPP

#include <optional>
#include <vector>

#include "sil/metrics/trajectory.hpp"

namespace semtrack::sil {

struct Agreement {
    std::vector<TrajectoryErrors> with;  ///< one of each other trajectory, that one as truth
    /// Root of the mean square of the result's own error between consecutive frames, by the "three-cornered hat": with
    /// independent errors the mean squares of the three differences are ab = a + b, ac = a + c and bc = b + c, so
    /// a = (ab + ac - bc) / 2. Empty without exactly two others, or where a comes out negative. An error that all three
    /// share (scale of one calibration) does not show.
    std::optional<double> own_error_rms_m{};
};

[[nodiscard]] Agreement compare_with_others(const Trajectory& result, const std::vector<Trajectory>& others);

}  // namespace semtrack::sil

#endif
