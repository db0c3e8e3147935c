// The project's detection format: rows `frame class score left top right bottom h_view v_view`.
#ifndef SEMTRACK_SIL_KITTI_DETECTION_FILE_HPP
#define SEMTRACK_SIL_KITTI_DETECTION_FILE_HPP

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sil/sequence.hpp"

namespace semtrack::sil {

/// A frame without entry has no list; an empty vector says that nothing was seen.
struct Detections {
    std::map<int, std::vector<Detection>> by_frame;
    int dropped{0};     ///< inverted, without overlap with the image, doubled, beyond the capacity
    int bad_frames{0};  ///< rows of frames that no drive has
};

/// Text where a number belongs, unknown classes, viewpoints out of range: InputError by line. Boxes are clipped to
/// width x height; those without overlap are dropped and counted.
[[nodiscard]] Detections read_detections(const std::filesystem::path& path, int width, int height);

/// Clips, drops, counts; keeps the highest scores when there are more than a list holds.
void tidy(std::vector<Detection>& list, int width, int height, int& dropped);

[[nodiscard]] const char* class_name(ObjectClass object_class);
/// Also KITTI's Person_sitting. false: unknown.
[[nodiscard]] bool class_from_name(const std::string& name, ObjectClass& out);

/// Ideal detections from labels: the labelled box moved from the label's camera to the detection camera, each edge by
/// the difference of the 3D box's projections; viewpoint from the companion file or from the 3D box.
[[nodiscard]] std::map<int, std::vector<Detection>> detections_from_labels(const std::vector<Label>& labels,
                                                                           const std::vector<int>& frames,
                                                                           const DriveCameras& cameras);

}  // namespace semtrack::sil

#endif
