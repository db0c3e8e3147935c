// Labels of raw drives as KITTI publishes them: tracklet_labels.xml, boxes in the laser scanner's frame.
#ifndef SEMTRACK_SIL_KITTI_TRACKLET_FILE_HPP
#define SEMTRACK_SIL_KITTI_TRACKLET_FILE_HPP

#include <filesystem>
#include <vector>

#include "math/pose.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// One label per tracklet and frame whose box overlaps the image of the label camera; `cameras` must have its image
/// size. The 2D box is the projection, clipped, `truncated` the share of it outside the image; ids count the tracklets
/// from 0. InputError by line for a number that is none, tags that do not match, or a tracklet without sizes.
[[nodiscard]] std::vector<Label> read_tracklets(const std::filesystem::path& path, const Pose& T_c0_velo,
                                                const DriveCameras& cameras);

}  // namespace semtrack::sil

#endif
