// Ego truth of raw drives as KITTI publishes them: GPS and IMU, one file a frame.
#ifndef SEMTRACK_SIL_KITTI_OXTS_FILES_HPP
#define SEMTRACK_SIL_KITTI_OXTS_FILES_HPP

#include <filesystem>
#include <map>

#include "math/pose.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Rectified camera 0 relative to its pose at the first file's frame; names are %010d.txt, missing frames stay out.
/// A file has one row: latitude, longitude (degrees), altitude (m), roll, pitch, yaw (rad), then what is not used here.
/// Places by the Mercator projection that KITTI uses, scaled for the first latitude phi0, R_earth = 6378137 m:
///   x = R_earth cos(phi0) lambda, y = R_earth cos(phi0) ln tan(pi/4 + phi/2), z = altitude;
/// attitude Rz(yaw) Ry(pitch) Rx(roll). InputError by file and line: too few values, a number that is none, a place
/// beyond the projection (85 degrees). No folder or no files: empty.
[[nodiscard]] std::map<int, RigidTransform> read_oxts(const std::filesystem::path& folder, const Pose& T_c0_imu);

}  // namespace semtrack::sil

#endif
