// Pinhole projection, paper's pi with focal lengths: every residual is in pixels.
#ifndef SEMTRACK_MATH_CAMERA_HPP
#define SEMTRACK_MATH_CAMERA_HPP

#include "math/eigen.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

inline constexpr double kMinDepth_m = 0.1;  ///< nearer points count as behind the camera

/// Requires x_c(2) >= kMinDepth_m.
[[nodiscard]] inline Vec2 project(const PinholeCamera& camera, const Vec3& x_c) {
    return {camera.fx * x_c(0) / x_c(2) + camera.cx, camera.fy * x_c(1) / x_c(2) + camera.cy};
}
/// Ray with z = 1.
[[nodiscard]] inline Vec3 bearing(const PinholeCamera& camera, double u, double v) {
    return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0};
}
/// uR of the point with left column uL at depth z: uL - (cxL - cxR) - fx b / z.
[[nodiscard]] inline double right_column(const Calibration& c, double u_left, double depth_m) {
    return u_left - (c.left.cx - c.right.cx) - c.left.fx * c.baseline_m / depth_m;
}
/// Disparity without the difference of the principal points; depth = fx b / d.
[[nodiscard]] inline double disparity(const Calibration& c, double u_left, double u_right) {
    return u_left - u_right - (c.left.cx - c.right.cx);
}
[[nodiscard]] inline double depth_from_disparity(const Calibration& c, double disparity_px) {
    return c.left.fx * c.baseline_m / disparity_px;
}
/// Row in the right image, RowOffset's formula.
[[nodiscard]] inline double right_row(const Calibration& c, double v_left, double disparity_px) {
    return v_left + (c.right.cy - c.left.cy) + c.row_offset.constant + c.row_offset.slope * (v_left - c.left.cy) +
           c.row_offset.per_disparity * disparity_px;
}

}  // namespace semtrack

#endif
