// The road for ground contact (G): stereo points of the background, in the image where the vehicle's own plane shows
// road. Points on objects belong to the objects, so that no object is judged by its own.
#include <cmath>

#include "math/camera.hpp"
#include "pipeline/tracker_core.hpp"

namespace semtrack {

namespace {

constexpr double kNearest_m = 3.0;
constexpr double kFarthest_m = 40.0;
constexpr double kAside_m = 8.0;
constexpr double kMinDisparity_px = 4.0;
constexpr double kGateSlope = 0.04;  // a point that is off by more of its distance is no road (2.3 degrees) ...
constexpr double kGate_m = 0.15;     // ... beside this

}  // namespace

void TrackerCore::place_vehicle() {
    const Mat3 R_l_c = level_.R_l_w() * T_w_c_.R;
    const Pose T_c_l{R_l_c.transpose(), Vec3::Zero()};
    const Vec3 up = R_l_c * T_v_c_.R.transpose().col(2);
    const Vec3 ahead = ahead_of(T_c_l);
    if (up(2) > 0.5) {  // on its wheels
        ground_.set_vehicle(-(up(0) * ahead(0) + up(1) * ahead(1)) / up(2),
                            -(up(1) * ahead(0) - up(0) * ahead(1)) / up(2));
    }
}

void TrackerCore::learn_road() {
    if (!config_.cues.ground || !features_usable_) {
        return;
    }
    place_vehicle();
    const Mat3 R_l_c = level_.R_l_w() * T_w_c_.R;
    const Pose T_c_l{R_l_c.transpose(), Vec3::Zero()};  // the camera is the origin
    const Vec3 vehicle = ground_.vehicle_plane();
    road_points_.clear();
    for (const FeatureMeasurement& m : features_) {
        const double d = disparity(calibration_, static_cast<double>(m.u), static_cast<double>(m.u_right));
        if (m.owner != kBackground || !m.stereo || !(d > kMinDisparity_px)) {
            continue;
        }
        const Vec3 ray_l = R_l_c * bearing(calibration_.left, static_cast<double>(m.u), static_cast<double>(m.v));
        const Vec3 x_l = ray_l * depth_from_disparity(calibration_, d);
        const Vec3 a = ground_row(T_c_l, x_l);
        const Vec3 a_ray = ground_row(T_c_l, ray_l);
        // Where the ray meets the vehicle's plane: ray_z t = -h + (s . ray) t
        const double fall = a_ray(1) * vehicle(1) + a_ray(2) * vehicle(2) - ray_l(2);
        const double t = fall > 0.0 ? vehicle(0) / fall : 0.0;
        RoadPoint p;
        p.ahead_m = a(1);
        p.left_m = a(2);
        p.up_m = x_l(2);
        const double depth = t > 0.0 ? t : 1.0;
        const double focal_baseline = calibration_.left.fx * calibration_.baseline_m;
        p.per_px = depth * depth / focal_baseline * fall;
        const double sigma_d = std::sqrt(static_cast<double>(m.sigma_px) * static_cast<double>(m.sigma_px) +
                                         static_cast<double>(m.sigma_right_px) * static_cast<double>(m.sigma_right_px));
        const double by_row = depth / calibration_.left.fy * static_cast<double>(m.sigma_px);
        p.sigma_m = std::sqrt(p.per_px * p.per_px * sigma_d * sigma_d + by_row * by_row);
        const double off = road_residual(p, vehicle);
        const bool in_region = t * a_ray(1) > kNearest_m && t * a_ray(1) < kFarthest_m && t * a_ray(2) < kAside_m &&
                               t * a_ray(2) > -kAside_m;
        if (in_region && std::fabs(off) < kGate_m + kGateSlope * a(1) + 3.0 * p.sigma_m) {
            (void)road_points_.try_push_back(p);
        }
    }
    (void)ground_.add_road(road_points_, frame_);
#ifdef ROAD_DEBUG
    ROAD_DEBUG
#endif
}

}  // namespace semtrack
