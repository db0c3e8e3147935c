// A load that fills every capacity: textured boxes driving to and fro before a textured wall, as dense as the image
// allows, seen by a camera that moves to and fro. Up to 32 objects with more than 128 corners each.
#ifndef SEMTRACK_TESTS_BUDGET_LOAD_SCENE_HPP
#define SEMTRACK_TESTS_BUDGET_LOAD_SCENE_HPP

#include "board/scene_writer.hpp"

namespace semtrack::budget {

/// objects: 0 to kMaxObjects.
[[nodiscard]] board::SceneWriter make_load_scene(int objects, int frames);

}  // namespace semtrack::budget

#endif
