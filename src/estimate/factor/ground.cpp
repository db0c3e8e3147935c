#include "estimate/factor/ground.hpp"

#include <cmath>

namespace semtrack {

namespace {
constexpr double kRoadSigma_m = 0.10;         // crown, kerbs, tyres, label noise
constexpr double kRoadSigmaPerMetre = 0.008;  // a road leaves a plane by 0.5 degrees
}  // namespace

GroundResidual ground_residual(const ObjectState& x, double height_m, const Pose& T_c_l, const GroundPrior& prior) {
    const Vec3 camera_l = -(T_c_l.R.transpose() * T_c_l.t);
    const double dx = x.p(0) - camera_l(0);
    const double dy = x.p(1) - camera_l(1);
    const double far = kRoadSigmaPerMetre * std::sqrt(dx * dx + dy * dy);
    const double h = prior.camera_height_sigma_m;
    const double weight = 1.0 / std::sqrt(kRoadSigma_m * kRoadSigma_m + far * far + h * h);
    return {weight * (x.p(2) - 0.5 * height_m - camera_l(2) + prior.camera_height_m), weight, -0.5 * weight};
}

}  // namespace semtrack
