// Overlap of oriented boxes: their common area (or volume) over that of both together.
#ifndef SEMTRACK_SIL_METRICS_ROTATED_OVERLAP_HPP
#define SEMTRACK_SIL_METRICS_ROTATED_OVERLAP_HPP

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

/// Seen from above: rectangles length x width in camera 0's x-z plane. 0 for boxes that only touch. Exact but for
/// rounding (about 1e-15 of the areas). Sizes must be positive.
[[nodiscard]] double birdseye_overlap(const ObjectRow& a, const ObjectRow& b);

/// The same with the common height; boxes stand upright (y is the vertical).
[[nodiscard]] double box3d_overlap(const ObjectRow& a, const ObjectRow& b);

}  // namespace semtrack::sil

#endif
