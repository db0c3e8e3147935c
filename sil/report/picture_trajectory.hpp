// The ego path against its truth.
#ifndef SEMTRACK_SIL_REPORT_PICTURE_TRAJECTORY_HPP
#define SEMTRACK_SIL_REPORT_PICTURE_TRAJECTORY_HPP

#include <array>
#include <map>
#include <vector>

#include "math/pose.hpp"
#include "semtrack/types.hpp"
#include "sil/report/canvas.hpp"

namespace semtrack::sil {

/// Positions of the vehicle in W by frame from poses of rectified camera 0 (truth files): both paths are laid on each
/// other at the first frame that both have. Empty: no common frame.
/// poses_w: the tracker's T_w_v by frame; t_c0_c as in DriveCameras.
[[nodiscard]] std::map<int, std::array<double, 3>> truth_in_world(const std::map<int, RigidTransform>& truth,
                                                                  const std::map<int, RigidTransform>& poses_w,
                                                                  const RigidTransform& T_v_c,
                                                                  const std::array<double, 3>& t_c0_c);

/// Both paths from above; below them the distance between them over the frames. Numbers: path length, largest and
/// last distance. These are of paths laid on each other at their start, not the metrics' best fit.
[[nodiscard]] Canvas draw_trajectory(const std::map<int, RigidTransform>& poses_w,
                                     const std::map<int, std::array<double, 3>>& truth_w);

}  // namespace semtrack::sil

#endif
