// How a raw drive's sensors stand to each other: calib_velo_to_cam.txt, calib_imu_to_velo.txt.
#ifndef SEMTRACK_SIL_KITTI_MOUNT_FILES_HPP
#define SEMTRACK_SIL_KITTI_MOUNT_FILES_HPP

#include <filesystem>

#include "math/pose.hpp"

namespace semtrack::sil {

/// Rows R and T of a file. InputError when one of them is missing or not finite.
[[nodiscard]] Pose read_sensor_mount(const std::filesystem::path& path);
/// T_c0_velo: R_rect_00 (calib_cam_to_cam.txt) times the rows R and T of calib_velo_to_cam.txt.
[[nodiscard]] Pose read_velodyne_mount(const std::filesystem::path& cam_to_cam,
                                       const std::filesystem::path& velo_to_cam);

}  // namespace semtrack::sil

#endif
