// How a patch of road looks to the other camera and a frame later. The road is a plane h below the camera: at row v its
// depth is z = fy h / (v - cy), so
//   disparity d = fx b / z = s (v - cy),  s = (fx / fy) (b / h):  a row further down moves s px to the left in the
//   right image (0.33 px on KITTI: an upright patch of 11 rows is 3.6 px off from its top to its bottom);
//   by a motion along the road that makes a depth k times smaller, u' = k u, v' = k v (about the principal point), and
//   the patch grows k times in u, k^2 times in v, and shears.
// A patch that is followed over several frames knows k from its depths: no more of the motion is needed.
#ifndef SEMTRACK_FRONT_MATCH_ROAD_PATCH_HPP
#define SEMTRACK_FRONT_MATCH_ROAD_PATCH_HPP

#include "front/match/patch_align.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

class RoadPlane {
public:
    RoadPlane() = default;
    /// camera_height_m: above the road; the camera looks along it.
    RoadPlane(const Calibration& calibration, double camera_height_m);

    /// px of disparity per row; 0: there is no road.
    [[nodiscard]] float slope() const { return slope_; }
    /// Rows where the road may be: kMinRows_px or more below the principal point (about 60 m on KITTI).
    [[nodiscard]] bool may_show(float v) const { return slope_ > 0.0F && v - cy_ > kMinRows_px; }
    /// Disparity of the road at a row that may show it.
    [[nodiscard]] float disparity(float v) const { return slope_ * (v - cy_); }
    /// The road's part of what PatchTemplate::build wants, for a patch now at (u, v) that was `growth` times deeper
    /// when its reference was taken. v must show the road.
    [[nodiscard]] PatchWarp warp(float u, float v, float growth) const;

    static constexpr float kMinRows_px = 20.0F;

private:
    float slope_{0};
    float cx_{0};
    float cy_{0};
};

}  // namespace semtrack

#endif
