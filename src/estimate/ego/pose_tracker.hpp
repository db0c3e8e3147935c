// Pose of one frame against known landmarks: a robust start for the window.
#ifndef SEMTRACK_ESTIMATE_EGO_POSE_TRACKER_HPP
#define SEMTRACK_ESTIMATE_EGO_POSE_TRACKER_HPP

#include "estimate/ego/ego_window.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

struct PoseFit {
    int matches{0};                     ///< landmarks seen in the frame
    int inliers{0};                     ///< within kPoseGate sigmas at the end
    Mat6 covariance{Mat6::Identity()};  ///< of the left perturbation (translation, rotation), landmarks taken as known
};

inline constexpr double kPoseGate = 5.0;

/// Gauss-Newton on 6 parameters with kernels that narrow: Cauchy, Huber, Tukey (Tukey from the start jumped). When few
/// of the landmarks agree, it is tried again from kernels that are wide enough for a first frame without prediction,
/// and the pose with more inliers stays. Fixed iterations: 14 or 34 over the landmarks seen in `frame`. False: fewer
/// than 6 matches or a singular matrix; T_c_w is then untouched.
[[nodiscard]] bool fit_pose(const EgoWindow& window, const EgoFrame& frame, const Calibration& calibration, Pose& T_c_w,
                            PoseFit& fit);

}  // namespace semtrack

#endif
