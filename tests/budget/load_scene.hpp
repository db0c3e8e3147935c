// A load that fills every capacity: textured boxes driving to and fro before a textured wall, as dense as the image
// allows, seen by a camera that moves to and fro. Up to 32 objects with more than 128 corners each.
#ifndef SEMTRACK_TESTS_BUDGET_LOAD_SCENE_HPP
#define SEMTRACK_TESTS_BUDGET_LOAD_SCENE_HPP

#include <vector>

#include "board/scene_writer.hpp"
#include "sil/simulate/timed_features.hpp"

namespace semtrack::budget {

/// objects: 0 to kMaxObjects.
[[nodiscard]] board::SceneWriter make_load_scene(int objects, int frames);

/// The same boxes' features from outside: 128 on each, 512 of the background, in every frame. Images cannot fill all
/// capacities at once: new corners keep 7 to 9 px apart, and 4608 of them do not find room beside what objects cover.
class LoadFeatures final : public sil::TimedFeatures {
public:
    LoadFeatures(int objects, int frames);
};

/// One box as the camera sees it: its middle ahead and to the left, its speed along its heading.
struct LoadBox {
    double ahead_m{0};
    double left_m{0};
    double speed_mps{0};
};
[[nodiscard]] std::vector<LoadBox> load_boxes(int objects, int frame);

}  // namespace semtrack::budget

#endif
