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
constexpr double kLane_m = 2.5;  // to each side of the camera's axis
constexpr double kMinDisparity_px = 4.0;
constexpr double kGate_m = 0.15;        // a point of the road may leave the vehicle's plane by so much ...
constexpr double kGateSlope = 0.04;     // ... and this share of the distance (three sigmas of the slope) ...
constexpr double kLaneGateSlope = 0.2;  // ... a road that bends by this: steeper than any street
constexpr double kGateSigmas = 3.0;     // ... and by the noise of its match

double square(double x) {
    return x * x;
}

bool within(double ahead_m, double left_m, double aside_m) {
    return ahead_m > kNearest_m && ahead_m < kFarthest_m && std::fabs(left_m) < aside_m;
}

}  // namespace

void TrackerCore::place_vehicle() {
    const Mat3 R_l_c = level_.R_l_w() * T_w_c_.R;
    const Vec3 up_l = R_l_c * T_v_c_.R.transpose().col(2);
    const Vec3 ahead = ahead_of({R_l_c.transpose(), Vec3::Zero()});
    if (up_l(2) > 0.5) {  // on its wheels
        ground_.set_vehicle(-(up_l(0) * ahead(0) + up_l(1) * ahead(1)) / up_l(2),
                            -(up_l(1) * ahead(0) - up_l(0) * ahead(1)) / up_l(2));
    }
}

// sigma and per_px are taken where the point's ray meets the vehicle's plane (ray t, fall: how fast it comes down on
// it): a point that a wrong match threw far away is no better or worse than its neighbours.
void TrackerCore::collect_road(const FeatureMeasurement& m) {
    const double d = disparity(calibration_, static_cast<double>(m.u), static_cast<double>(m.u_right));
    if (m.owner != kBackground || !m.stereo || !(d > kMinDisparity_px)) {
        return;
    }
    const Mat3 R_l_c = level_.R_l_w() * T_w_c_.R;
    const Pose T_c_l{R_l_c.transpose(), Vec3::Zero()};  // the camera is the origin
    const Vec3 vehicle = ground_.vehicle_plane();
    const Vec3 ray_l = R_l_c * bearing(calibration_.left, static_cast<double>(m.u), static_cast<double>(m.v));
    const double depth_m = depth_from_disparity(calibration_, d);
    const Vec3 ray = ground_row(T_c_l, ray_l);
    const double fall = ray(1) * vehicle(1) + ray(2) * vehicle(2) - ray_l(2);
    const double meets_m = vehicle(0) / (fall > 1e-3 ? fall : 1e-3);
    const double t = meets_m < depth_m || depth_m > kFarthest_m ? meets_m : depth_m;
    RoadPoint p;
    p.ahead_m = ray(1) * depth_m;
    p.left_m = ray(2) * depth_m;
    p.up_m = ray_l(2) * depth_m;
    const double sigma_d2 = square(static_cast<double>(m.sigma_px)) + square(static_cast<double>(m.sigma_right_px));
    const double per_px = t * t * (fall > 0.0 ? fall : 0.0) / (calibration_.left.fx * calibration_.baseline_m);
    p.sigma_m =
        std::sqrt(square(per_px) * sigma_d2 + square(t / calibration_.left.fy * static_cast<double>(m.sigma_px)));
    const double off = std::fabs(road_residual(p, vehicle)) - kGate_m - kGateSigmas * p.sigma_m;
    if (fall > 0.0 && within(ray(1) * meets_m, ray(2) * meets_m, kAside_m) && off < kGateSlope * p.ahead_m) {
        (void)road_points_.try_push_back(p);
    }
    if (within(p.ahead_m, p.left_m, kLane_m) && off < kLaneGateSlope * p.ahead_m) {
        (void)lane_points_.try_push_back(p);
    }
}

void TrackerCore::learn_road() {
    road_points_.clear();
    lane_points_.clear();
    place_vehicle();
    if (config_.cues.ground && features_usable_) {
        for (const FeatureMeasurement& m : features_) {
            collect_road(m);
        }
        (void)ground_.add_road(road_points_, frame_);
    }
    const GroundPlane plane = ground_.plane(-1);
    health_.road_not_plane =
        road_shape_.update(road_chi2(lane_points_, Vec3(plane.height_m, plane.slope_forward, plane.slope_left)));
}

}  // namespace semtrack
