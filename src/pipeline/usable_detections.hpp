// What of a detector's list the tracker can use.
#ifndef SEMTRACK_PIPELINE_USABLE_DETECTIONS_HPP
#define SEMTRACK_PIPELINE_USABLE_DETECTIONS_HPP

#include "semtrack/types.hpp"

namespace semtrack {

/// Fills `out` with the detections of `in` that are finite and meet the image, clipped to it (width x height px), each
/// object once: of boxes that overlap by kSameObjectOverlap or more (intersection over union; two vehicles or two
/// people) the one with the highest score stays; of two classes with scores within kEqualScores the commoner one (the
/// order of ObjectClass), of equals the first. Keeps the order. Returns how many were dropped. O(n^2), n <=
/// kMaxDetections.
[[nodiscard]] std::uint32_t take_usable(const DetectionList& in, int width, int height, DetectionList& out);

/// Detectors' own suppression ends at 0.5-0.7, within a class: more is the same object as two classes, or a row twice.
inline constexpr double kSameObjectOverlap = 0.8;
inline constexpr double kEqualScores = 0.1;

}  // namespace semtrack

#endif
