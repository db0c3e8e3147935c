// The whole cycle over a scene in memory: what a board runs, and the host beside it.
#ifndef SEMTRACK_TESTS_BOARD_RUN_SCENE_HPP
#define SEMTRACK_TESTS_BOARD_RUN_SCENE_HPP

#include <cstddef>
#include <cstdint>

namespace semtrack::board {

struct SceneResult {
    bool complete{false};  ///< every frame of the scene was processed
    int frames{0};
    int can_frames{0};
    int objects{0};         ///< of the last list
    int points{0};          ///< of the last frame, all owners
    std::uint64_t hash{0};  ///< FNV-1a over id, length and data of every CAN frame
};

/// Uses static storage: one call at a time.
[[nodiscard]] SceneResult run_scene(const std::uint8_t* scene, std::size_t size);

/// One line: hash, frames, CAN frames, objects, points. `text` holds at least kLineBytes.
inline constexpr std::size_t kLineBytes = 128;
void format_result(const SceneResult& result, char* text);

}  // namespace semtrack::board

#endif
