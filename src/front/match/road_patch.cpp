#include "front/match/road_patch.hpp"

namespace semtrack {

RoadPlane::RoadPlane(const Calibration& calibration, double camera_height_m)
    : cx_(static_cast<float>(calibration.left.cx)), cy_(static_cast<float>(calibration.left.cy)) {
    if (camera_height_m > 0.0) {
        slope_ =
            static_cast<float>(calibration.left.fx / calibration.left.fy * calibration.baseline_m / camera_height_m);
    }
}

// d(u', v') / d(u, v) of u' = k u, v' = k v with k = z / (z - t), z proportional to 1 / v: (k, (u / v) k (k - 1); 0,
// k^2). Here its inverse, from now to the reference.
PatchWarp RoadPlane::warp(float u, float v, float growth) const {
    const float inverse = 1.0F / growth;
    PatchWarp out;
    out.a = inverse;
    out.b = -(u - cx_) / (v - cy_) * (growth - 1.0F) * inverse * inverse;
    out.d = inverse * inverse;
    return out;
}

}  // namespace semtrack
