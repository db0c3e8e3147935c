// From the tracker's states to the published ones.
#ifndef SEMTRACK_PIPELINE_OUTPUT_BUILDER_HPP
#define SEMTRACK_PIPELINE_OUTPUT_BUILDER_HPP

#include "estimate/ego/ego_estimator.hpp"
#include "math/pose.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/types.hpp"
#include "track/track_table.hpp"

namespace semtrack {

struct EgoView {
    Pose T_w_v{};
    Pose T_w_c{};
    double sigma_speed{0};  ///< what is published over ground carries the ego's own uncertainty
    double sigma_yaw_rate{0};
};

/// Speed, yaw rate, their sigmas and the pose's covariance from the estimate; T_v_c the camera's mount.
void describe_ego_motion(const EgoResult& result, const Pose& T_v_c, EgoState& out);

/// One track in its present state. Nothing that is not finite leaves here: false, and out is untouched.
[[nodiscard]] bool describe_track(const Track& track, int slot, const EgoView& ego, const Calibration& calibration,
                                  TrackedObject& out);

}  // namespace semtrack

#endif
