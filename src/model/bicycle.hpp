// Kinematic bicycle model, the paper's motion model (after gu2017), held at the rear axle: at 15 degrees of steering
// the box centre moves 7 degrees off the heading, the rear axle along it.
#ifndef SEMTRACK_MODEL_BICYCLE_HPP
#define SEMTRACK_MODEL_BICYCLE_HPP

#include "model/object_window.hpp"

namespace semtrack {

/// Largest steering angle of a road vehicle.
inline constexpr double kMaxSteering_rad = 0.7;

/// q = p - L/2 (cos theta, sin theta, 0) moves by v dt along the heading half-way; theta by v dt tan(delta) / L:
///   q' = q + v dt (cos theta_m, sin theta_m, 0),  theta' = theta + v dt tan(delta) / L,  theta_m = (theta + theta') /
///   2
/// The paper takes theta in place of theta_m; over the 0.4 s between older frames of the window that is an error of
/// second order. v and delta stay. wheelbase_m > 0; |delta| is clamped to kMaxSteering_rad.
[[nodiscard]] ObjectState bicycle_step(const ObjectState& x, double wheelbase_m, double dt_s);

/// Derivative of (p', theta', v', delta') by (p, theta, v, delta) at x, wheelbase fixed.
[[nodiscard]] Mat6 bicycle_jacobian(const ObjectState& x, double wheelbase_m, double dt_s);

}  // namespace semtrack

#endif
