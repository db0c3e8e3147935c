// The library's own ORB: FAST-9 corners on a pyramid of scale 1.2, spread over cells per owner, with 256-bit binary
// descriptors (paper Sect. 4: "We extract ORB features for both the left and right image in the visible area for each
// object and the background"). Integers only, so the same bytes everywhere; memory and work are bounded.
#ifndef SEMTRACK_FRONT_FEATURE_ORB_EXTRACTOR_HPP
#define SEMTRACK_FRONT_FEATURE_ORB_EXTRACTOR_HPP

#include <array>
#include <cstdint>

#include "front/feature/brief.hpp"
#include "front/feature/fast.hpp"
#include "front/feature/orb_image.hpp"
#include "front/feature/orb_strongest.hpp"
#include "front/feature/select.hpp"
#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

struct OrbOptions {
    int levels{4};       ///< 1..kMaxPyramidLevels; fewer than the usual 8: a car's images hardly change in scale
    bool upright{true};  ///< false: descriptors turn with the patch. A car does not roll, and turning costs matches
    int threshold{10};   ///< FAST, grey levels
    bool spread{true};   ///< over cells; false: the strongest wherever they are, as cv::ORB chooses
};

class OrbExtractor final : public FeatureExtractor {
public:
    OrbExtractor() = default;
    explicit OrbExtractor(const OrbOptions& options) : options_(options) {}

    /// See FeatureExtractor. Features keep kBriefRadius_px + 1 pixels of their level away from the border; levels
    /// smaller than that are left out. kInvalidArgument also for an image beyond the capacity or options out of range.
    /// Cost O(pixels + features), less than four times the finest level's pixels whatever the image holds.
    Status extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                   Keypoints& out) noexcept override;

private:
    static constexpr int kMargin_px = kBriefRadius_px + 1;
    static constexpr int kCoarseWidth = level_size(kMaxImageWidth, 1);
    static constexpr int kCoarseHeight = level_size(kMaxImageHeight, 1);

    [[nodiscard]] bool acceptable(const ImageView& image, const OwnerMaskView& mask) const;
    [[nodiscard]] FeatureBudget share_of_level(int level, int levels) const;
    [[nodiscard]] OwnerMaskView owners_of_level(const ImageView& image, const OwnerMaskView& mask, int level);
    void extract_level(const ImageView& image, const OwnerMaskView& mask, int level, int levels);
    void write_sorted(Keypoints& out);

    OrbOptions options_{};
    FastDetector fast_{};
    CornerGrid corners_{};
    CornerSelector selector_{};
    StrongestCorners strongest_{};
    SelectedCorners selected_{};
    ImageResizer resizer_{};
    BriefPatch patch_{};
    // Only a level and the one before it exist at once; the finest is the caller's.
    std::array<std::uint8_t, static_cast<std::size_t>(kCoarseWidth) * kCoarseHeight> odd_level_{};
    std::array<std::uint8_t, static_cast<std::size_t>(level_size(kMaxImageWidth, 2)) * level_size(kMaxImageHeight, 2)>
        even_level_{};
    std::array<std::uint8_t, static_cast<std::size_t>(kCoarseWidth) * kCoarseHeight> coarse_mask_{};
    FeatureBudget left_over_{};
    int full_width_{0};
    int full_height_{0};
    Keypoints found_{};
    std::array<std::uint64_t, static_cast<std::size_t>(kMaxFeatures)> order_{};  // owner, v, u, index in found_
};

}  // namespace semtrack

#endif
