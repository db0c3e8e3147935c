// Corners with descriptors: the native ORB, OpenCV's (hal/opencv) or a hardware block behind one interface.
#ifndef SEMTRACK_HAL_FEATURE_EXTRACTOR_HPP
#define SEMTRACK_HAL_FEATURE_EXTRACTOR_HPP

#include <array>
#include <cstdint>

#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

using Descriptor = std::array<std::uint32_t, 8>;  ///< 256 bits, compared by Hamming distance

struct Keypoint {
    float u{0};                ///< px at full resolution
    float v{0};
    std::uint8_t owner{0};     ///< from the mask at (u, v)
    std::uint8_t level{0};     ///< pyramid level, scale 1.2^level
    std::int32_t score{0};     ///< corner strength; larger is better
    Descriptor descriptor{};
};

using Keypoints = StaticVector<Keypoint, kMaxFeatures>;

/// Owner of each pixel, row-major with the image's width as stride: 0 background, k the object in slot k - 1,
/// kNoOwner nobody's (no features are taken there).
inline constexpr std::uint8_t kNoOwner = 255;
struct OwnerMaskView {
    const std::uint8_t* data{nullptr};
    int width{0};
    int height{0};
    [[nodiscard]] std::uint8_t at(int x, int y) const {
        return data[static_cast<std::int64_t>(y) * width + x];
    }
};

/// Features wanted per owner; owners with 0 get none.
using FeatureBudget = std::array<std::int16_t, kMaxOwners>;

class FeatureExtractor {
public:
    /// At most budget[owner] keypoints per owner, sorted by owner, then v, then u; the same input gives the same
    /// output. kInvalidArgument: an empty image, or one whose size is not the mask's; out is then empty.
    virtual Status extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                           Keypoints& out) noexcept = 0;

protected:
    ~FeatureExtractor() = default;
};

}  // namespace semtrack

#endif
