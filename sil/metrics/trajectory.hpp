// Errors of a trajectory against its truth. Poses are paired by frame number, never by position in a list. Only
// + - * / sqrt and math/trig: the same bits on every target.
#ifndef SEMTRACK_SIL_METRICS_TRAJECTORY_HPP
#define SEMTRACK_SIL_METRICS_TRAJECTORY_HPP

#include <map>
#include <optional>
#include <vector>

#include "math/pose.hpp"

namespace semtrack::sil {

/// Pose of the camera by frame number, in any fixed frame.
using Trajectory = std::map<int, Pose>;

struct TrajectoryErrors {
    int frames_compared{0};                 ///< frame numbers that both have
    std::optional<double> path_length_m{};  ///< of the result, over those
    std::optional<double> truth_path_length_m{};
    std::optional<double> ate_rmse_m{};        ///< positions, after SE3 alignment
    std::optional<double> rpe_trans_mean_m{};  ///< between consecutive frame numbers
    std::optional<double> rpe_trans_rms_m{};
    std::optional<double> rpe_rot_mean_deg{};
    std::optional<double> segment_trans_percent{};  ///< KITTI: 100..800 m, a start every tenth frame
    std::optional<double> segment_rot_deg_per_100m{};
    int segments{0};
};

/// What cannot be measured stays empty: RPE without consecutive frames, segments on paths below 100 m.
[[nodiscard]] TrajectoryErrors compare_trajectories(const Trajectory& result, const Trajectory& truth);

/// Rotation and shift (no scale) that bring `from` closest to `to`: sum |to_i - (R from_i + t)|^2 least. Horn 1987, by
/// the largest eigenvector of his 4x4 matrix; where points leave a rotation open (a line, one place), one of the best.
/// Both of one size, at least 1.
[[nodiscard]] Pose align_se3(const std::vector<Vec3>& from, const std::vector<Vec3>& to);

/// Sum of the distances between neighbours.
[[nodiscard]] double path_length(const std::vector<Vec3>& points);

}  // namespace semtrack::sil

#endif
