// What both matchers get, keep and give: the paper's (ORB in both images) and the patch search.
#ifndef SEMTRACK_FRONT_MATCH_MATCHER_HPP
#define SEMTRACK_FRONT_MATCH_MATCHER_HPP

#include <array>
#include <cstdint>

#include "model/feature.hpp"
#include "model/owner_mask.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/hal/stage_observer.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

struct MatcherInput {
    ImageView left{};
    ImageView right{};  ///< may be empty: then nothing is stereo
    const OwnerMask* mask_left{nullptr};
    const OwnerMask* mask_right{nullptr};
    const OwnerPriors* priors{nullptr};
    const Calibration* calibration{nullptr};
    double camera_height_m{0};  ///< above the road; 0: the patch matcher knows no road
    std::uint32_t frame{0};
    StageObserver* observer{nullptr};  ///< told of kExtract and kMatch; may be null
};

/// A feature that is alive, as last seen.
struct FeatureSlot {
    bool live{false};
    bool stereo{false};
    std::uint8_t missed{0};  ///< frames since it was seen; then u, v, u_right are predictions
    std::uint16_t age{0};
    std::uint32_t id{0};
    float u{0};
    float v{0};
    float u_right{0};
    float v_right{0};
};

/// Slots of every owner, one block after the other (first_feature_slot).
struct FeatureTable {
    std::array<FeatureSlot, kMaxFeatures> slots{};
    std::uint32_t next_id{1};

    [[nodiscard]] FeatureSlot& at(int owner, int slot) {
        return slots[static_cast<std::size_t>(first_feature_slot(owner) + slot)];
    }
    /// First free slot of the owner at or after `from`; -1: none.
    [[nodiscard]] int free_slot(int owner, int from = 0) const {
        for (int s = from; s < feature_slots(owner); ++s) {
            if (!slots[static_cast<std::size_t>(first_feature_slot(owner) + s)].live) {
                return s;
            }
        }
        return -1;
    }
    void clear_owner(int owner) {
        for (int s = 0; s < feature_slots(owner); ++s) {
            at(owner, s).live = false;
        }
    }
};

/// What a slot says of its feature before this frame's sight of it is stored.
[[nodiscard]] inline FeatureMeasurement continued(const FeatureSlot& slot, int owner, int slot_number) {
    FeatureMeasurement m;
    m.id = slot.id;
    m.slot = static_cast<std::int16_t>(slot_number);
    m.owner = static_cast<std::uint8_t>(owner);
    m.tracked = slot.age > 0;
    m.previous_stereo = m.tracked && slot.stereo;
    m.age = slot.age;
    m.previous_u = slot.u;
    m.previous_v = slot.v;
    m.previous_u_right = slot.u_right;
    return m;
}
/// Stores this frame's sight.
inline void store(const FeatureMeasurement& m, FeatureSlot& slot) {
    slot.stereo = m.stereo;
    slot.u = m.u;
    slot.v = m.v;
    slot.u_right = m.u_right;
    slot.v_right = m.v_right;
    slot.age = static_cast<std::uint16_t>(slot.age < 65535 ? slot.age + 1 : slot.age);
}

// Both matchers have:
//   void reset();
//   Status process(const MatcherInput& input, FrameFeatures& out);   out sorted by owner, then slot
//   void reject(int owner, int slot);                                an outlier: its slot is freed
// An empty left image is not given to a matcher; after a gap, features are searched from where they were last seen
// (T_cur_prev then spans the gap).

}  // namespace semtrack

#endif
