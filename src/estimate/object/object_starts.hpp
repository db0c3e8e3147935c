// Other starts for an object's window. Gauss-Newton does not leave a wrong heading, nor the wrong depth of an object
// that entered half outside the image; a start that owes nothing to the present solution does.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_STARTS_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_STARTS_HPP

#include "estimate/object/object_problem.hpp"

namespace semtrack {

/// Wrong faces over the window; an adjacent class is often the detector's error. Bounded a frame (redescending), so
/// that a few wrong classes do not hold a heading that the edges contradict. Without any class in the window: driving
/// backwards costs, so that the sign of the speed tells front from rear; not for one that was parked: it backs out.
[[nodiscard]] double heading_cost(const ObjectWindow& window, const ObjectVariables& x);

/// Another heading than the one that was found while the object stood. Bounded: what was found may be the twin.
inline constexpr double kTurningMost = 1.0;  // half of a frame that contradicts: enough against noise
[[nodiscard]] double turning_cost(const ObjectWindow& window, const ObjectVariables& x);

/// Landmarks lie on the body: cost of those outside the box. The observations alone do not tie a box to its landmarks.
[[nodiscard]] double outside_cost(const ObjectWindow& window, const ObjectVariables& x);

/// The present solution x turned to its twin, the second heading whose box is nearly as wide in the image: mirrored
/// about the line of sight, or, with the same two faces, on the other side of the heading at which the box is widest.
/// Landmarks stay where they are in the world. false: the twin shows other faces, the detector's class would have told.
[[nodiscard]] bool twin_start(const ObjectWindow& window, bool mirrored, ObjectVariables& x);

/// The present solution x moved along the line of sight to where its landmarks are, with the size that was known before:
/// boxes whose bottom something hid put an object too far away, and its own stereo points tell. Heading and image
/// position stay, landmarks too in the world. false: fewer than four landmarks are seen, or their middle lies within
/// 1 m of the box.
[[nodiscard]] bool landmark_start(const ObjectWindow& window, ObjectVariables& x);

/// Standing for so many frames: its heading has been published, and is kept.
inline constexpr int kStoodLong = 5;

inline constexpr int kFreshStarts = 3;       // with a viewpoint
inline constexpr int kFreshStartsBlind = 8;  // without: around the circle

/// From the boxes alone: where each whole box stands with the class's mean size and one heading, a straight path
/// through them. option: with a viewpoint 0 and 1 are headings left and right of the class's middle, 2 along the
/// path, the way round that the class says; without it, eight headings around the circle. Landmarks are those of x,
/// moved along. false: no whole box, or the path has no direction.
[[nodiscard]] bool fresh_start(const ObjectWindow& window, const Calibration& calibration, int option,
                               ObjectVariables& x);

}  // namespace semtrack

#endif
