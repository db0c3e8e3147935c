// What the front end hands to the estimator: features with an identity that lasts while they are seen.
#ifndef SEMTRACK_MODEL_FEATURE_HPP
#define SEMTRACK_MODEL_FEATURE_HPP

#include <array>
#include <cstdint>

#include "math/pose.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

inline constexpr std::uint8_t kBackground = 0;  ///< owner number; object in slot s has owner s + 1

/// First entry of an owner's block in tables that hold every owner's feature slots one after the other.
[[nodiscard]] constexpr int first_feature_slot(int owner) {
    return owner == 0 ? 0 : kMaxBackgroundFeatures + (owner - 1) * kMaxObjectFeatures;
}
[[nodiscard]] constexpr int feature_slots(int owner) {
    return owner == 0 ? kMaxBackgroundFeatures : kMaxObjectFeatures;
}

/// One feature in one frame. `slot` is stable while the feature lives, 0..feature_slots(owner)-1; `id` is never used
/// twice, so a landmark knows when its slot was given to another feature.
struct FeatureMeasurement {
    std::uint32_t id{0};
    std::int16_t slot{0};
    std::uint8_t owner{kBackground};
    bool stereo{false};   ///< u_right, v_right are measured in this frame
    bool tracked{false};  ///< it was seen in the frame before: previous_* are valid
    bool previous_stereo{false};
    std::uint16_t age{0};  ///< frames seen before this one
    float u{0};            ///< left image, px
    float v{0};
    float u_right{0};
    float v_right{0};
    float previous_u{0};
    float previous_v{0};
    float previous_u_right{0};
    float sigma_px{1};        ///< of u and v
    float sigma_right_px{1};  ///< of u_right
    float correlation{0};     ///< of its patch with what it is followed by, 0..1; 0: new, or not known
};

using FrameFeatures = StaticVector<FeatureMeasurement, kMaxFeatures>;

/// What the front end has to know of an owner before it looks for its features.
struct OwnerPrior {
    bool active{false};       ///< false: no features, and its slots are emptied
    std::int16_t budget{0};   ///< features wanted, at most feature_slots(owner)
    Pose T_cur_prev{};        ///< a point of the owner in the last camera frame -> where it is now, camera frame
    double min_depth_m{1.0};  ///< range in which stereo matches may lie
    double max_depth_m{1000.0};
};
using OwnerPriors = std::array<OwnerPrior, static_cast<std::size_t>(kMaxOwners)>;

}  // namespace semtrack

#endif
