// The files of a results folder, read back (docs/formats.md).
#ifndef SEMTRACK_SIL_RESULT_ROWS_HPP
#define SEMTRACK_SIL_RESULT_ROWS_HPP

#include <filesystem>
#include <vector>

#include "sil/metrics/consistency.hpp"
#include "sil/metrics/trajectory.hpp"

namespace semtrack::sil {

/// objects.txt, or KITTI's own results (without speed). InputError by line: a box without area, sizes that are not
/// positive, the same frame and id twice.
[[nodiscard]] std::vector<ObjectRow> read_object_rows(const std::filesystem::path& path);
/// DIR/ego.txt with the frame numbers of its rows.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& dir, const std::vector<int>& frames);
/// Pose rows of any program, of exactly these frames.
[[nodiscard]] Trajectory read_trajectory_file(const std::filesystem::path& path, const std::vector<int>& frames);
/// list.csv: the published yaw rate by frame and ObjectId.
[[nodiscard]] std::map<std::pair<int, int>, double> read_yaw_rates(const std::filesystem::path& path);
[[nodiscard]] std::vector<StateRow> read_state_rows(const std::filesystem::path& path);
/// ego.csv; rows without speed are left out.
[[nodiscard]] std::vector<EgoMotionRow> read_ego_motion_rows(const std::filesystem::path& path);

}  // namespace semtrack::sil

#endif
