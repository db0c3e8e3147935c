// KITTI's text files, each as one string.
#ifndef SEMTRACK_SIL_WORLD_EXPORT_TEXT_HPP
#define SEMTRACK_SIL_WORLD_EXPORT_TEXT_HPP

#include <filesystem>
#include <string>

#include "sil/world/world_sequence.hpp"

namespace semtrack::sil::world {

/// Creates the folder too. Throws std::runtime_error if the file cannot be written.
void write_text(const std::filesystem::path& path, const std::string& text);
/// The number with leading zeros; digits 0: none.
[[nodiscard]] std::string padded(int number, int digits);

[[nodiscard]] std::string raw_calibration(const WorldSequence& w);  ///< calib_cam_to_cam.txt
[[nodiscard]] std::string velo_to_cam();
[[nodiscard]] std::string imu_to_velo();
[[nodiscard]] std::string projections(const WorldSequence& w, int count);  ///< P0: .. P3:
[[nodiscard]] std::string tracking_calibration(const WorldSequence& w);  ///< P0..P3, R0_rect, Tr_velo_cam, Tr_imu_velo
[[nodiscard]] std::string time_stamps(const WorldSequence& w);           ///< from 2026-01-01 12:00:00
[[nodiscard]] std::string times(const WorldSequence& w);                 ///< seconds
/// `time_us speed yaw_rate` of every frame; the first frame is at start_us, the next ones period_us apart.
[[nodiscard]] std::string vehicle_motion_rows(const WorldSequence& w, std::int64_t start_us, std::int64_t period_us);
[[nodiscard]] std::string frame_numbers(const WorldSequence& w, int digits);
[[nodiscard]] std::string poses(const WorldSequence& w);
/// KITTI tracking labels, 17 columns; truncated as a fraction.
[[nodiscard]] std::string label_rows(const WorldSequence& w);
[[nodiscard]] std::string viewpoint_rows(const WorldSequence& w);  ///< frame track_id h_view v_view
/// `frame class score left top right bottom h_view v_view`; an empty list is a row `FRAME none 0 0 0 0 0 -1 -1`.
[[nodiscard]] std::string detection_rows(const WorldSequence& w);

}  // namespace semtrack::sil::world

#endif
