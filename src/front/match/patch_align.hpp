// Sub-pixel alignment of a small patch: inverse compositional Lucas-Kanade on 11x11 pixels with their means taken off
// (a difference of brightness between cameras or frames does not pull), in two dimensions or along the row only
// (two-dimensional stereo alignment makes the path 0.2 % longer). Single precision, + - * / sqrt in fixed order.
#ifndef SEMTRACK_FRONT_MATCH_PATCH_ALIGN_HPP
#define SEMTRACK_FRONT_MATCH_PATCH_ALIGN_HPP

#include <array>
#include <cstdint>

#include "semtrack/image_view.hpp"

namespace semtrack {

inline constexpr int kReference = 17;  ///< side of a stored reference patch: 11, its gradients, and room for scaling
inline constexpr int kPatch = 11;
inline constexpr int kPatchHalf = kPatch / 2;
using ReferencePatch = std::array<std::uint8_t, static_cast<std::size_t>(kReference) * kReference>;

/// Copies the surroundings of (u, v), bilinear; false: too near to the border.
[[nodiscard]] bool take_reference(const ImageView& image, float u, float v, ReferencePatch& out);

/// A reference patch made ready: intensities and gradients about the mean.
class PatchTemplate {
public:
    /// scale: size of the patch in the new image over its size in the reference (0.75 .. 1.3). false: no texture.
    [[nodiscard]] bool build(const ReferencePatch& reference, float scale);
    /// Moves (u, v) to the best place in the image. false: left the image, moved farther than max_shift_px or did not
    /// settle. ncc: correlation at the end, -1..1.
    [[nodiscard]] bool align(const ImageView& image, float max_shift_px, float& u, float& v, float& ncc) const;
    /// Along the row only; v stays.
    [[nodiscard]] bool align_row(const ImageView& image, float max_shift_px, float& u, float v, float& ncc) const;
    /// Sum of squared gradients: 1 / sigma^2 of the position at one grey level of noise.
    [[nodiscard]] float texture_u() const { return huu_; }
    [[nodiscard]] float texture_v() const { return hvv_; }

private:
    [[nodiscard]] bool residual(const ImageView& image, float u, float v, float& bu, float& bv, float& ncc) const;
    static constexpr std::size_t kPixels = static_cast<std::size_t>(kPatch) * kPatch;
    std::array<float, kPixels> value_{};
    std::array<float, kPixels> gu_{};
    std::array<float, kPixels> gv_{};
    float norm_{0};
    float huu_{0};
    float huv_{0};
    float hvv_{0};
};

}  // namespace semtrack

#endif
