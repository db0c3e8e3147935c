// The scenario's things in space: what stands still, built once, and the road users of one frame.
#ifndef SEMTRACK_SIL_WORLD_SCENE_HPP
#define SEMTRACK_SIL_WORLD_SCENE_HPP

#include <vector>

#include "sil/world/model_piece.hpp"
#include "sil/world/motion.hpp"
#include "sil/world/scenario.hpp"

namespace semtrack::sil::world {

/// Towards the sun, in N: from the left, above, behind. Shared by shading and shadows.
[[nodiscard]] inline Vec3 sun_direction() {
    return {-0.44, -0.78, -0.445};
}

/// A house that throws its shadow across the street; `to_z` > `from_z`.
struct ShadowHouse {
    float from_z{0};
    float to_z{0};
    float front_x{0};
    float eaves{0};
};

/// An upright block (road user) or a crown (tree) whose shadow lies on the ground.
struct ShadowBlock {
    float x{0};
    float z{0};
    float along_x{0};  ///< heading as a unit vector
    float along_z{1};
    float half_length{0};
    float half_width{0};
    float height{0};
    bool crown{false};
};

struct FrameScene {
    Pose T_n_c{};
    std::vector<Pose> T_n_m{};           ///< of every road user
    std::vector<Pieces> users{};         ///< in N
    std::vector<ShadowBlock> shadows{};  ///< of road users and trees
};

class Scene {
public:
    Scene(const Scenario& scenario, int frames);

    [[nodiscard]] const Scenario& scenario() const { return scenario_; }
    [[nodiscard]] int frames() const { return static_cast<int>(ego_.size()); }
    [[nodiscard]] const Pieces& still() const { return still_; }
    [[nodiscard]] const std::vector<ShadowHouse>& shadow_houses() const { return houses_; }
    [[nodiscard]] const PathState& ego(int frame) const { return ego_[static_cast<std::size_t>(frame)]; }
    [[nodiscard]] const PathState& user(std::size_t index, int frame) const {
        return users_[index][static_cast<std::size_t>(frame)];
    }
    [[nodiscard]] Pose T_n_c(int frame) const { return camera_pose(scenario_, ego(frame), frame); }
    [[nodiscard]] Pose T_n_m(std::size_t user, int frame) const;
    [[nodiscard]] FrameScene at(int frame) const;

private:
    Scenario scenario_;
    std::vector<PathState> ego_{};
    std::vector<std::vector<PathState>> users_{};
    Pieces still_{};
    std::vector<ShadowHouse> houses_{};
    std::vector<ShadowBlock> crowns_{};
};

}  // namespace semtrack::sil::world

#endif
