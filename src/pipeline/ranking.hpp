// The score that ranks objects: how far a published box is to be trusted.
//   existence x detector x n / (n + 3) x E,   n: detections so far,
//   E: expected bird's-eye overlap with the true box, when it lies s along the line of sight away, s ~ N(0, sigma^2):
//      overlap(s) = A / (2 l w - A),  A = max(0, l - |s cos a|) max(0, w - |s sin a|),  a: heading against the ray
#ifndef SEMTRACK_PIPELINE_RANKING_HPP
#define SEMTRACK_PIPELINE_RANKING_HPP

#include "track/track_table.hpp"

namespace semtrack {

/// Mean of overlap(s) by a fixed rule of 16 points; exact within 0.02 up to sigma_m = 2 (0.04 to 5).
[[nodiscard]] double expected_overlap(double length_m, double width_m, double cos_a, double sin_a, double sigma_m);
/// 0..1.
[[nodiscard]] double ranking_score(const Track& track);

}  // namespace semtrack

#endif
