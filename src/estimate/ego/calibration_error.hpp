// What an error of the calibration does to the estimated motion. A rectification leaves a residual that no calibration
// knows: the measured disparity is off by a smooth function of the place in the image, the same one in every frame. Its
// effect does not average out over features or frames, so it is kept apart from the noise.
//
// The error is taken as e(u, v) = e_0 + e_1 x + e_2 y, x and y from -1 to 1 across the image; each e_i has mean 0 and
// kDisparityError_px.
#ifndef SEMTRACK_ESTIMATE_EGO_CALIBRATION_ERROR_HPP
#define SEMTRACK_ESTIMATE_EGO_CALIBRATION_ERROR_HPP

#include <array>

#include "estimate/ego/ego_window.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

/// Rows of real pairs are off by 0.1 to 0.7 px within one image and 0.2 to 0.4 between drives; the columns, by which
/// disparity is measured, come from the same calibration.
inline constexpr double kDisparityError_px = 0.1;
inline constexpr std::size_t kDisparityModes = 3;

/// Change of a pose (translation, rotation; perturbed in the current camera) by each e_i, per px.
using DisparityResponse = std::array<Vec6, kDisparityModes>;

/// Of the motion from `before` to `now`: the step of a least-squares fit of `now` to landmarks placed by `before`'s
/// disparities, when all disparities change. Zero when fewer than 10 landmarks were seen in both. One pass over the
/// landmarks.
[[nodiscard]] DisparityResponse motion_response(const EgoWindow& window, const EgoFrame& before, const EgoFrame& now,
                                                const Calibration& calibration);

/// Sum of what the modes contribute to a covariance.
[[nodiscard]] Mat6 covariance_of(const DisparityResponse& response);

}  // namespace semtrack

#endif
