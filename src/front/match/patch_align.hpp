// Sub-pixel alignment of a small patch: inverse compositional Lucas-Kanade on 11x11 pixels, in two dimensions or along
// the row only (two-dimensional stereo alignment makes the path 0.2 % longer). Brightness and contrast of the other
// image are free: minimise over the shift (and a, c)   sum (I(x + shift) - a T(x) - c)^2,   with a and c eliminated, so
// that exposure and unequal cameras do not pull (a gain of 0.9 otherwise moves a match by up to 0.3 px). Sums over the
// patch are integers: they have one value in any order, on every target.
#ifndef SEMTRACK_FRONT_MATCH_PATCH_ALIGN_HPP
#define SEMTRACK_FRONT_MATCH_PATCH_ALIGN_HPP

#include <array>
#include <cstdint>

#include "semtrack/image_view.hpp"

namespace semtrack {

inline constexpr int kReference = 17;  ///< side of a stored reference patch: 11, its gradients, and room for scaling
inline constexpr int kPatchRows = 11;
inline constexpr int kPatchHalf = kPatchRows / 2;
using ReferencePatch = std::array<std::uint8_t, static_cast<std::size_t>(kReference) * kReference>;

/// Copies the surroundings of (u, v), bilinear; false: too near to the border.
[[nodiscard]] bool take_reference(const ImageView& image, float u, float v, ReferencePatch& out);

/// Where a pixel of the patch as it looks now lay in the reference, both from the middle, in px:
///   u_reference = a u + b v,  v_reference = d v.  Rows stay rows: what a plane that meets the image rows does.
struct PatchWarp {
    float a{1.0F};
    float b{0.0F};
    float d{1.0F};
};

/// A patch made ready: intensities and gradients.
class PatchTemplate {
public:
    /// From a reference. The warp's a and d: 0.5 .. 1.35 (what lies outside of the reference repeats its border).
    /// false: no texture.
    [[nodiscard]] bool build(const ReferencePatch& reference, const PatchWarp& warp);
    /// From the image itself about (u, v); a row further down is taken `shear` columns further to the right.
    /// false: too near to the border, or no texture.
    [[nodiscard]] bool build_at(const ImageView& image, float u, float v, float shear);
    /// Moves (u, v) to the best place in the image. false: left the image, moved farther than max_shift_px or did not
    /// settle. ncc: correlation at the end, -1..1.
    [[nodiscard]] bool align(const ImageView& image, float max_shift_px, float& u, float& v, float& ncc) const;
    /// Along the row only; v stays.
    [[nodiscard]] bool align_row(const ImageView& image, float max_shift_px, float& u, float v, float& ncc) const;
    /// Sum of squared gradients, (grey levels per px)^2: 1 / sigma^2 of the position at one grey level of noise.
    [[nodiscard]] float texture_u() const { return static_cast<float>(huu_) * kGradientUnit * kGradientUnit; }

private:
    // Values are in 1/16 grey level about 128, gradients (differences over two px) in 1/32 grey level per px. A row of
    // the patch is 16 lanes wide; lanes beyond the patch are 0.
    static constexpr int kLanes = 16;
    static constexpr int kSource = kPatchRows + 2;  // with one more pixel around, for gradients
    static constexpr int kSourceStride = 24;
    static constexpr float kGradientUnit = 1.0F / 32.0F;
    using Source = std::array<std::int16_t, static_cast<std::size_t>(kSource) * kSourceStride>;
    /// What the image shows at a place, against the template; brightness is already taken off.
    struct Match {
        float u{0};  // the place, on the grid of the interpolation
        float v{0};
        double bu{0};  // right side of the normal equations, over the contrast a
        double bv{0};
        float ncc{0};
    };

    [[nodiscard]] bool finish(const Source& source);
    [[nodiscard]] bool compare(const ImageView& image, float u, float v, Match& out) const;

    std::array<std::int16_t, static_cast<std::size_t>(kPatchRows) * kLanes> value_{};
    std::array<std::int16_t, static_cast<std::size_t>(kPatchRows) * kLanes> gu_{};
    std::array<std::int16_t, static_cast<std::size_t>(kPatchRows) * kLanes> gv_{};
    std::int32_t sum_{0};    // of the values
    std::int32_t sum_u_{0};  // of the gradients
    std::int32_t sum_v_{0};
    double square_{0};  // of the values about their mean
    double gain_u_{0};  // share of the gradient that a change of contrast explains
    double gain_v_{0};
    double huu_{0};  // of the gradients, mean and contrast taken off
    double huv_{0};
    double hvv_{0};
};

}  // namespace semtrack

#endif
