// A detector's answer to the left image: bounds of what is visible of each road user, with a detector's errors.
#ifndef SEMTRACK_SIL_WORLD_DETECTOR_HPP
#define SEMTRACK_SIL_WORLD_DETECTOR_HPP

#include <vector>

#include "sil/world/renderer.hpp"
#include "sil/world/truth.hpp"

namespace semtrack::sil::world {

inline constexpr double kMinDetectedShare = 0.2;

enum class DetectorMode { kRealistic, kIdeal };

/// Silhouettes in the scenario's order. Below 20 px or with more than 80 % hidden nothing is detected, in both modes.
/// Ideal: exact bounds and viewpoint classes, score 1. Realistic: DetectorErrors of the scenario; repeatable by
/// (scenario seed, frame, road user). Boxes lie inside the image; pedestrians carry no viewpoint.
[[nodiscard]] std::vector<Detection> detect(const Scene& scene, const Calibration& calibration, int frame,
                                            const std::vector<Silhouette>& silhouettes, DetectorMode mode);

}  // namespace semtrack::sil::world

#endif
