// The tracked features of one owner, laid out for the tests of two-view and of rigid geometry.
#ifndef SEMTRACK_FRONT_RANSAC_POINT_PAIRS_HPP
#define SEMTRACK_FRONT_RANSAC_POINT_PAIRS_HPP

#include <array>
#include <cstdint>

#include "semtrack/capacity.hpp"

namespace semtrack {

inline constexpr std::size_t kMaxPairs = static_cast<std::size_t>(kMaxBackgroundFeatures);
static_assert(kMaxBackgroundFeatures >= kMaxObjectFeatures, "the background is the largest owner");

/// One entry per candidate, 1 = agrees with the model.
using PairFlags = std::array<std::uint8_t, kMaxPairs>;

/// Left-image positions before (p) and now (q): centred in each image and scaled alike, so that one unit is
/// `px_per_unit` pixels in both and thresholds in pixels keep their meaning.
struct ImagePairs {
    int size{0};
    float px_per_unit{1};
    std::array<float, kMaxPairs> px{};
    std::array<float, kMaxPairs> py{};
    std::array<float, kMaxPairs> qx{};
    std::array<float, kMaxPairs> qy{};
};

/// Points with stereo before and now: position in the camera of the frame before [m], its disparity there and the
/// measurement of this frame relative to the principal point of the left camera [px].
struct StereoPairs {
    int size{0};
    std::array<float, kMaxPairs> x{};
    std::array<float, kMaxPairs> y{};
    std::array<float, kMaxPairs> z{};
    std::array<float, kMaxPairs> d_before{};
    std::array<float, kMaxPairs> u{};
    std::array<float, kMaxPairs> v{};
    std::array<float, kMaxPairs> d{};
};

}  // namespace semtrack

#endif
