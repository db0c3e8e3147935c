// The paper's matcher (Sect. 4): ORB in both images, stereo along the epipolar line within the depth range that the
// owner's pose allows, and in time between the features of each owner and its own in the last frame.
#ifndef SEMTRACK_FRONT_MATCH_ORB_MATCHER_HPP
#define SEMTRACK_FRONT_MATCH_ORB_MATCHER_HPP

#include <array>
#include <cstdint>

#include "front/match/matcher.hpp"
#include "front/match/orb_rows.hpp"
#include "front/match/row_offset.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

class OrbMatcher {
public:
    /// Forgets all features; the extractor stays.
    void reset();
    /// Not owned; must outlive the matcher or be replaced.
    void set_extractor(FeatureExtractor* extractor) { extractor_ = extractor; }
    /// Extracts, matches, and gives every feature of the left image a slot: that of the feature of the last frame it
    /// continues, else a free one. out is sorted by owner, then slot. kInvalidArgument: no extractor, a part of the
    /// input is missing or sizes do not fit; what the extractor answers if it fails; kInvalidArgument
    /// too if its keypoints break its contract. Nothing changes then. Cost: the
    /// extractions, and for each feature the others of its owner in a band of rows.
    Status process(const MatcherInput& input, FrameFeatures& out);
    /// An outlier: its slot is freed.
    void reject(int owner, int slot) { table_.at(owner, slot).live = false; }
    /// Row offset beyond the calibration's, as measured so far (px at the middle row).
    [[nodiscard]] double row_offset_px() const { return row_.constant(); }

private:
    /// What a slot's feature looked like.
    struct Look {
        Descriptor descriptor{};
        std::uint8_t level{0};
    };
    /// The best partner of a keypoint so far; a partner that somebody else fits better is lost.
    struct Claim {
        std::int16_t by{-1};
        std::int16_t distance{257};
    };
    struct Candidate {
        int index{-1};
        int distance{257};
        int second{257};
    };
    struct Window {
        double u;
        double v;
        double half_width;
        double half_height;
    };

    [[nodiscard]] Status extract(const MatcherInput& in);
    void match_stereo(const MatcherInput& in, int owner);
    [[nodiscard]] Candidate find_right(const MatcherInput& in, const Keypoint& k, double d_min, double d_max) const;
    void refine_stereo(const MatcherInput& in, int left, int right);
    void match_in_time(const MatcherInput& in, int owner);
    int follow(const MatcherInput& in, int owner, double reach_px);
    [[nodiscard]] bool predict(const MatcherInput& in, int owner, const FeatureSlot& slot, double fallback_depth_m,
                               Window& window) const;
    [[nodiscard]] double owner_depth(const MatcherInput& in, int owner);
    [[nodiscard]] Candidate find_left(const Window& window, const Look& look) const;
    void assign_slots(int owner);
    void emit(int owner, FrameFeatures& out);

    FeatureExtractor* extractor_{nullptr};
    FeatureTable table_{};
    RowOffsetFilter row_{};
    Keypoints left_{};
    Keypoints right_{};
    OwnerBlocks left_blocks_{};
    OwnerBlocks right_blocks_{};
    KeypointRows rows_{};
    std::array<Look, static_cast<std::size_t>(kMaxFeatures)> looks_{};            // by slot
    std::array<std::int16_t, static_cast<std::size_t>(kMaxFeatures)> match_{};    // by slot: its left keypoint, or -1
    std::array<Claim, static_cast<std::size_t>(kMaxFeatures)> claims_{};          // by keypoint
    std::array<std::int16_t, static_cast<std::size_t>(kMaxFeatures)> partner_{};  // by left keypoint: its right one
    std::array<std::int16_t, static_cast<std::size_t>(kMaxFeatures)> slot_of_{};  // by left keypoint
    std::array<float, static_cast<std::size_t>(kMaxFeatures)> u_right_{};         // by left keypoint; negative: mono
    std::array<float, static_cast<std::size_t>(kMaxFeatures)> v_right_{};
};

}  // namespace semtrack

#endif
