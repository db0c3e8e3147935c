// Times, poses, frame lists and labels of KITTI drives.
#ifndef SEMTRACK_SIL_KITTI_DRIVE_FILES_HPP
#define SEMTRACK_SIL_KITTI_DRIVE_FILES_HPP

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "sil/kitti/text_file.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Raw drives: `YYYY-MM-DD hh:mm:ss.fraction`, 0 to 9 digits (cut to microseconds), read as UTC; line n is frame n.
/// Second 60 is the next minute's 0. A stamp that is not later than the last: refused by line.
[[nodiscard]] std::vector<std::int64_t> read_timestamps(const std::filesystem::path& path);
/// Odometry: seconds, one a row; line n is frame n.
[[nodiscard]] std::vector<std::int64_t> read_times(const std::filesystem::path& path);
/// Frame numbers, growing; doubled or falling ones are refused.
[[nodiscard]] std::vector<int> read_frame_list(const std::filesystem::path& path);
/// Rows of 12 values (3x4, row by row); no rotation, or more rows than numbers: refused by line. numbers: the frame of
/// each row; empty: row n is frame n.
[[nodiscard]] std::map<int, RigidTransform> read_poses(const std::filesystem::path& path,
                                                       const std::vector<int>& numbers);
/// KITTI tracking labels, 17 columns (18 with a score). viewpoints: companion rows `frame track_id h_view v_view`; an
/// empty path or a missing file: labels have none. Refused by line: sizes that are not positive (DontCare aside), the
/// same frame and id twice.
[[nodiscard]] std::vector<Label> read_labels(const std::filesystem::path& path,
                                             const std::filesystem::path& viewpoints);

/// Two words h_view v_view; out of range: refused by line.
[[nodiscard]] Viewpoint parse_viewpoint(const TextFile& file, const TextRow& row, std::size_t word);

}  // namespace semtrack::sil

#endif
