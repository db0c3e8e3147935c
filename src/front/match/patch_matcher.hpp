// Features by patch search: corners in the left image only; stereo along the row; in time around the position that
// the owner's motion predicts. In prototypes this gave 81 % stereo matches instead of 47, 97 % inliers instead of 83
// and tracks of 11 frames instead of 3, at a third of the time of descriptors in both images.
#ifndef SEMTRACK_FRONT_MATCH_PATCH_MATCHER_HPP
#define SEMTRACK_FRONT_MATCH_PATCH_MATCHER_HPP

#include <array>

#include "front/feature/fast.hpp"
#include "front/feature/select.hpp"
#include "front/match/matcher.hpp"
#include "front/match/patch_align.hpp"
#include "front/match/patch_image.hpp"
#include "front/match/row_offset.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

class PatchMatcher {
public:
    void reset();
    /// Follows the live features, finds their right image, fills empty cells with new corners. out is sorted by owner,
    /// then slot. kInvalidArgument: image sizes do not fit; nothing changes.
    Status process(const MatcherInput& input, FrameFeatures& out);
    /// An outlier: its slot is freed.
    void reject(int owner, int slot) { table_.at(owner, slot).live = false; }
    /// Row offset beyond the calibration's, as measured so far (px at the middle row).
    [[nodiscard]] double row_offset_px() const { return row_.constant(); }

private:
    /// What a slot looks like.
    struct Appearance {
        ReferencePatch reference{};
        CoarsePatch coarse{};
        float coarse_du{0};  // position minus twice the coarse corner, when the patch was taken
        float coarse_dv{0};
        float reference_depth_m{0};  // 0: unknown, no change of scale is assumed
        std::uint16_t age{0};        // frames since the reference was taken
    };
    struct Found {
        float u{0};
        float v{0};
        float ncc{0};
    };

    void follow(const MatcherInput& in, int owner);
    [[nodiscard]] bool follow_one(const MatcherInput& in, int owner, int slot, double fallback_depth_m);
    [[nodiscard]] bool search(const Appearance& a, float u, float v, int radius, Found& found) const;
    void add_new(const MatcherInput& in);
    [[nodiscard]] bool match_stereo(const MatcherInput& in, int owner, FeatureSlot& slot, const Appearance& a,
                                    float predicted_disparity, float& sigma_px);
    [[nodiscard]] bool search_row(const CoarsePatch& patch, int y, int from, int to, bool unique, int& best_x,
                                  float& offset) const;
    [[nodiscard]] bool search_back(int x_right, int y, int from, int to, int x_left) const;
    void remember(const MatcherInput& in, FeatureSlot& slot, Appearance& a, float depth_m) const;
    void remember_coarse(const FeatureSlot& slot, Appearance& a) const;
    [[nodiscard]] double owner_depth(const MatcherInput& in, int owner);
    [[nodiscard]] bool allowed(const MatcherInput& in, int owner, float u, float v) const;
    [[nodiscard]] float depth_of(const MatcherInput& in, const FeatureSlot& slot) const;
    void emit(int owner, int slot, FrameFeatures& out);

    FeatureTable table_{};
    std::array<Appearance, kMaxFeatures> looks_{};
    std::array<FeatureMeasurement, kMaxFeatures> now_{};  // by slot: what this frame measured
    PatchImage left_half_{};
    PatchImage right_half_{};
    FastDetector fast_{};
    CornerGrid corners_{};
    CornerSelector selector_{};
    SelectedCorners selected_{};
    std::array<float, static_cast<std::size_t>(kMaxBackgroundFeatures)> depths_{};
    RowOffsetFilter row_{};
    PatchTemplate template_{};
    bool first_{true};
};

}  // namespace semtrack

#endif
