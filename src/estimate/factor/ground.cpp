#include "estimate/factor/ground.hpp"

#include <cmath>

namespace semtrack {

namespace {
constexpr double kRoadSigma_m = 0.06;  // crown, kerbs, tyres
constexpr double kRoadSigmaPerMetre = 0.004;
}  // namespace

GroundResidual ground_residual(const ObjectState& x, double height_m, const Pose& T_c_l, const GroundPlane& plane) {
    const Vec3 camera_l = -(T_c_l.R.transpose() * T_c_l.t);
    const Vec3 a = ground_row(T_c_l, x.p);
    const double distance = std::sqrt(a(1) * a(1) + a(2) * a(2));
    const double road = kRoadSigma_m + kRoadSigmaPerMetre * distance;
    const double weight = 1.0 / std::sqrt(road * road + a.dot(plane.covariance * a));
    const Vec3 theta(plane.height_m, plane.slope_forward, plane.slope_left);
    const Vec3 ahead = ahead_of(T_c_l);
    GroundResidual out;
    out.r = weight * (x.p(2) - 0.5 * height_m - camera_l(2) - a.dot(theta));
    out.J_p = weight * Vec3(-(plane.slope_forward * ahead(0) - plane.slope_left * ahead(1)),
                            -(plane.slope_forward * ahead(1) + plane.slope_left * ahead(0)), 1.0);
    out.J_height = -0.5 * weight;
    return out;
}

}  // namespace semtrack
