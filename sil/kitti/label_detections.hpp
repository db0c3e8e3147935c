// Ideal detections made from labels: `--detections labels`.
#ifndef SEMTRACK_SIL_KITTI_LABEL_DETECTIONS_HPP
#define SEMTRACK_SIL_KITTI_LABEL_DETECTIONS_HPP

#include <map>
#include <vector>

#include "math/pose.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// A label's box in rectified camera 0: centre of the box, axes of O.
[[nodiscard]] Pose label_pose(const Label& label);

/// One list for each of `frames`, empty when nothing is labelled there; DontCare and unknown types are left out.
/// Box: the labelled one moved from the label's camera to the detection camera, each edge by the difference of the 3D
/// box's projections into both (near and far faces have different disparity), both cut at the image border; a top or
/// bottom edge more than 10 px off its projection stays. Score 1. Viewpoint: the label's own, else the faces that the
/// detection camera sees of the 3D box; pedestrians have none.
[[nodiscard]] std::map<int, std::vector<Detection>> detections_from_labels(const std::vector<Label>& labels,
                                                                           const std::vector<int>& frames,
                                                                           const DriveCameras& cameras);

}  // namespace semtrack::sil

#endif
