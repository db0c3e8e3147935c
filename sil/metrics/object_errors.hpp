// Errors of tracked objects against labels, on labelled frames only.
#ifndef SEMTRACK_SIL_METRICS_OBJECT_ERRORS_HPP
#define SEMTRACK_SIL_METRICS_OBJECT_ERRORS_HPP

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

struct ObjectErrors {
    int frames_compared{0};
    int labelled_cars{0};  ///< cars 25 px high or more, occluded 2 or less, truncated 0.5 or less
    int matched_cars{0};
    int unmatched_rows{0};  ///< results that meet no label and no DontCare area
    int id_switches{0};
    std::optional<double> recall{};
    std::optional<double> position_mean_percent{};  ///< 3D distance of the bottom centres / the label's distance
    std::optional<double> position_median_m{};
    std::optional<double> heading_median_deg{};
    std::optional<double> heading_mean_deg{};
    std::optional<double> heading_flip_share{};  ///< off by more than 90 degrees
    std::optional<double> speed_mean_mps{};      ///< |speed - truth's|, cars that move
    std::optional<double> speed_median_mps{};
    int yaw_rates{0};  ///< moving cars with a published yaw rate
    std::optional<double> yaw_rate_mean_radps{};  ///< |published yaw rate - truth's|
    std::optional<double> yaw_rate_median_radps{};
    std::optional<double> parked_speed_median_mps{};  ///< |speed| of cars whose labels stay within 1 m
    std::optional<double> parked_speed_p95_mps{};
    int far_cars{0};  ///< cars 50 m or farther, occluded 1 or less, truncated 0.5 or less, 10 px high or more
    std::optional<double> far_recall{};
    std::optional<double> far_position_mean_percent{};
    int labelled_pedestrians{0};  ///< 25 px high or more, occluded 1 or less, truncated 0.5 or less
    std::optional<double> pedestrian_recall{};
    std::optional<double> pedestrian_position_mean_percent{};
    std::optional<double> pedestrian_speed_median_mps{};  ///< |speed - truth's|, walking
    int motion_steps{0};  ///< neighbouring labels of a moving car, both matched with one result id
    /// Object motion error: what is left of the truth's body-fixed motion T_o1^-1 T_o2 between two labelled frames
    /// after the result's own, through the result's ego poses: |translation|, |rotation|.
    std::optional<double> motion_trans_mean_m{};
    std::optional<double> motion_rot_mean_deg{};
    /// Path of a car, by its labels in the world, over which it kept one id without a gap of more than 0.5 s: the
    /// longest of all.
    std::optional<double> longest_track_m{};
};

/// Pairs by track_matching.hpp. `result_frames`: frames that were processed. T_f_c0: the result's own ego poses, by
/// frame; empty: no object motion error.
[[nodiscard]] ObjectErrors compare_objects(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                                           const ObjectTruthSet& truth, const std::map<int, Pose>& T_f_c0 = {});

}  // namespace semtrack::sil

#endif
