// One row of each result file (docs/formats.md): columns, conventions, 17 digits. Rows end with a newline.
#ifndef SEMTRACK_SIL_REPORT_TABLES_HPP
#define SEMTRACK_SIL_REPORT_TABLES_HPP

#include <array>
#include <cstdint>
#include <string>

#include "math/pose.hpp"
#include "semtrack/hal/stage_observer.hpp"
#include "semtrack/types.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Time of one frame by the host's clock. Only timing.csv has clock values.
struct FrameTiming {
    double total_us{0};  ///< all of Tracker::process and the encoding
    std::array<double, kStages> stage_us{};
};

/// An object as KITTI's labels say it.
struct KittiPlace {
    Vec3 bottom_c0{Vec3::Zero()};  ///< middle of the bottom face in rectified camera 0
    double rotation_y{0};          ///< atan2(-h_z, h_x) of the heading vector, [-pi, pi)
    double alpha{0};               ///< rotation_y - atan2(x, z), [-pi, pi)
};

/// The box stands upright in V. T_c_v: inverse of the mount; t_c0_c: x_c0 = x_c + t_c0_c.
[[nodiscard]] KittiPlace kitti_place(const TrackedObject& object, const Pose& T_c_v,
                                     const std::array<double, 3>& t_c0_c);

/// 3x4 row by row.
[[nodiscard]] std::string pose_row(const Pose& T);

[[nodiscard]] const char* ego_header();
[[nodiscard]] std::string ego_row(int frame, const EgoState& ego, const Health& health);

/// Confirmed tracks, measured or coasting, whose box overlaps the image.
[[nodiscard]] bool belongs_in_objects(const TrackedObject& object);
[[nodiscard]] std::string objects_row(int frame, const TrackedObject& object, const KittiPlace& place);

[[nodiscard]] const char* states_header();
[[nodiscard]] std::string states_row(int frame, std::int64_t time_us, const TrackedObject& object);

[[nodiscard]] const char* points_header();
/// owner 0: background, else the object's id.
[[nodiscard]] std::string points_row(int frame, std::uint32_t owner, const SparsePoint& point);

[[nodiscard]] std::string timing_header();
[[nodiscard]] std::string timing_row(int frame, const FrameTiming& timing, int objects, int features);

}  // namespace semtrack::sil

#endif
