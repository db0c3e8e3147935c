// The vehicle's own speed and yaw rate of a drive, as a text file.
#ifndef SEMTRACK_SIL_KITTI_VEHICLE_MOTION_FILE_HPP
#define SEMTRACK_SIL_KITTI_VEHICLE_MOTION_FILE_HPP

#include <cstdint>
#include <filesystem>
#include <map>

#include "semtrack/types.hpp"

namespace semtrack::sil {

/// Rows `time_us speed_mps yaw_rate_radps [sigma_speed sigma_yaw_rate]`, separated by blanks, no header, by time; the
/// times are those of the layout (from the Unix epoch, or from 0). InputError by file and line: other columns, a
/// number that is none, a time that is not later than the last, a sigma that is not positive; no rows at all.
[[nodiscard]] std::map<std::int64_t, VehicleMotion> read_vehicle_motion(const std::filesystem::path& path);

}  // namespace semtrack::sil

#endif
