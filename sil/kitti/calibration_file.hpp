// KITTI calibration files -> DriveCameras. Rectified cameras share their orientation: x_a = x_0 + K_a^-1 P_a[:,3].
#ifndef SEMTRACK_SIL_KITTI_CALIBRATION_FILE_HPP
#define SEMTRACK_SIL_KITTI_CALIBRATION_FILE_HPP

#include <filesystem>

#include "sil/sequence.hpp"

namespace semtrack::sil {

/// left, right: numbers of the processed cameras; detection: of the detector's. Reads rows `P0:` or `P_rect_00:`.
/// InputError by line: a row that is missing, doubled, not 12 finite numbers or no projection of a rectified camera; a
/// focal length that is not positive or unequal left and right; a baseline that is zero or of the wrong sign.
/// Different principal points are legal. A right camera above or below the left one shows as
/// row_offset.per_disparity. Labels are in camera 2's pixels where the file has one, else in the left camera's.
/// Width and height stay 0: they are the images'.
[[nodiscard]] DriveCameras read_calibration(const std::filesystem::path& path, int left, int right, int detection);

}  // namespace semtrack::sil

#endif
