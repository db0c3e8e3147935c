// The project's detection format: rows `frame class score left top right bottom h_view v_view`.
#ifndef SEMTRACK_SIL_KITTI_DETECTION_FILE_HPP
#define SEMTRACK_SIL_KITTI_DETECTION_FILE_HPP

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Rows that did not reach a list, and rows that were cut. Only grow.
struct DetectionCounters {
    int inverted{0};  ///< right <= left or bottom <= top
    int outside{0};   ///< no overlap with the image
    int doubled{0};   ///< same frame, class and box as an earlier row
    int clipped{0};   ///< kept, cut at the image border
    [[nodiscard]] int dropped() const { return inverted + outside + doubled; }
};

/// A frame without entry has no list; an empty vector says that nothing was seen.
struct Detections {
    std::map<int, std::vector<Detection>> by_frame;
    int dropped{0};     ///< counters.dropped()
    int bad_frames{0};  ///< rows of frames that no drive has (negative, or beyond 10^7), `none` rows too
    DetectionCounters counters;
};

/// Text where a number belongs, a number that is not finite, an unknown class, viewpoints out of range: InputError by
/// line. A list whose rows were all dropped is empty: the detector did answer. `none` beside other rows says nothing.
[[nodiscard]] Detections read_detections(const std::filesystem::path& path, int width, int height);

/// Drops and clips to [0, width-1] x [0, height-1] (the detections' camera has the processed pair's image size). The
/// list is then sorted by falling score; equal ones keep the file's order. Of more than kMaxDetections the tracker gets
/// the first and the number of the others (sil/sources.hpp).
void tidy(std::vector<Detection>& list, int width, int height, DetectionCounters& counters);
void tidy(std::vector<Detection>& list, int width, int height, int& dropped);

[[nodiscard]] const char* class_name(ObjectClass object_class);
/// Also the labels' Person_sitting and Person, which are pedestrians. false: unknown; out untouched.
[[nodiscard]] bool class_from_name(const std::string& name, ObjectClass& out);

}  // namespace semtrack::sil

#endif
