// Writes the rendered street to disk as KITTI stores its drives, so that the readers are tested without KITTI.
#ifndef SEMTRACK_SIL_WORLD_EXPORT_HPP
#define SEMTRACK_SIL_WORLD_EXPORT_HPP

#include <filesystem>
#include <string>

#include "sil/world/world_sequence.hpp"

namespace semtrack::sil {

enum class ExportLayout { kRaw, kOdometry, kTracking };

/// What `replay --layout LAYOUT --root OUT --sequence ID` wants to know.
struct ExportedDrive {
    std::string id;                    ///< raw: 2026_01_01_drive_0001; odometry: 00; tracking: 0000
    std::filesystem::path detections;  ///< in the replay's format, processed left camera's pixels
};

/// Creates OUT and what is below it; files of an earlier export with the same names are replaced.
/// The ego vehicle's simulated sensors are beside the poses (vehicle_motion.txt; vehicle_motion/ID.txt).
///   raw       OUT/2026_01_01/{calib_cam_to_cam.txt, calib_velo_to_cam.txt, calib_imu_to_velo.txt, ID_sync/...}
///   odometry  OUT/sequences/00/{image_0, image_1, calib.txt, times.txt}, OUT/poses/00.txt
///   tracking  OUT/training/{image_02, image_03, calib, label_02, ego_pose, labels_viewpoints, detections}
/// Cameras 0 and 2 coincide, and so do 1 and 3. A frame whose images were dropped has no image files, but its times,
/// poses and labels are there. Throws std::runtime_error if something cannot be written.
/// The tracking layout has no times: readers take its frames as 0.1036 s apart, the street's are 0.1 s apart.
ExportedDrive export_world(const WorldSequence& world, ExportLayout layout, const std::filesystem::path& out);

/// "raw", "odometry", "tracking"; throws InputError for anything else.
[[nodiscard]] ExportLayout export_layout(const std::string& name);

}  // namespace semtrack::sil

#endif
