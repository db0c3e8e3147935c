// What is exactly true of a frame: ego pose, labels in KITTI's conventions, motion of the road users.
#ifndef SEMTRACK_SIL_WORLD_TRUTH_HPP
#define SEMTRACK_SIL_WORLD_TRUTH_HPP

#include <vector>

#include "sil/sequence.hpp"
#include "sil/world/renderer.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

/// Nobody labels less than this: the whole silhouette's height in px.
inline constexpr double kMinLabelHeight_px = 12.0;

/// Motion of one road user over ground.
struct ObjectTruth {
    int frame{0};
    int id{0};
    double speed{0};            ///< of the rear axle along the heading; negative: reversing; m/s
    double yaw_rate{0};         ///< about the road's upward normal, positive to the left; rad/s
    Pose T_c_o{};               ///< box centre in the processed left camera; O: x forward, y left, z up
    Vec3 size_m{Vec3::Zero()};  ///< length, width, height
};

/// Pose of the left camera in the first frame's.
[[nodiscard]] RigidTransform ego_truth(const Scene& scene, int frame);
[[nodiscard]] ObjectTruth object_truth(const Scene& scene, std::size_t user, int frame);

/// Occlusion level from the visible share: 0 from 0.85 on, 1 from 0.5, 2 from 0.1, else 3.
[[nodiscard]] int occlusion_level(double visible_share);
[[nodiscard]] const char* type_name(ObjectClass object_class);
[[nodiscard]] inline bool is_labelled(const Silhouette& s) {
    return s.samples > 0 && s.whole.bottom - s.whole.top >= kMinLabelHeight_px;
}
/// The 2D box is amodal: bounds of the whole silhouette, cut at the image border. truncated: share of the projected
/// 3D box outside the image.
[[nodiscard]] Label make_label(const Scene& scene, const Calibration& calibration, std::size_t user, int frame,
                               const Silhouette& silhouette);

}  // namespace semtrack::sil::world

#endif
