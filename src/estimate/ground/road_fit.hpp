// The road from stereo points of the background of one frame.
//   point i:  z_i = (-1, f_i, l_i) (Theta + c) + e_i,   e_i ~ N(0, sigma_i^2 + roughness^2)
//   z: height above the camera, f, l: ahead and left of it (model/ground_plane.hpp);  Theta ~ N(prior)
//   c ~ N(0, S): what all points have in common, in this frame and the next ones. A disparity that the calibration has
//   wrong by 0.4 px is a slope of h 0.4 / (fx b) = 0.0017; the road bends between the points and the objects; and boxes
//   are not drawn to end on the road.
// Kerbs, walls and plants are most of what is seen: of 64 planes through three points each and the prior's own, the one
// of the least truncated cost  sum min(r^2 / s^2, 9) + prior  starts a fit with redescending weights (Tukey). So at
// least half of the points have to be road, or the rest of them must not lie on one plane.
#ifndef SEMTRACK_ESTIMATE_GROUND_ROAD_FIT_HPP
#define SEMTRACK_ESTIMATE_GROUND_ROAD_FIT_HPP

#include <cstdint>

#include "model/ground_plane.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

struct RoadPoint {
    double ahead_m{0};  ///< of the camera, level
    double left_m{0};
    double up_m{0};     ///< z_p - z_c: negative
    double sigma_m{0};  ///< of up_m, where the road is, by the noise of the match
};
using RoadPoints = StaticVector<RoadPoint, kMaxBackgroundFeatures>;

/// A normal prior of (h, s_f, s_l).
struct RoadPrior {
    Vec3 mean{Vec3::Zero()};
    Mat3 information{Mat3::Zero()};
};

/// What the points say, without the prior: information I and the plane at which they want it, I Theta = vector.
struct RoadFit {
    bool valid{false};
    Mat3 information{Mat3::Zero()};
    Vec3 vector{Vec3::Zero()};
    Vec3 plane{Vec3::Zero()};  ///< (h, s_f, s_l), with the prior
    int inliers{0};
};

/// Unevenness of a road that is a plane: crown, ruts, patches. [m]
inline constexpr double kRoadRoughness_m = 0.02;

/// z_i - (-1, f, l) Theta.
[[nodiscard]] inline double road_residual(const RoadPoint& p, const Vec3& plane) {
    return p.up_m - (-plane(0) + p.ahead_m * plane(1) + p.left_m * plane(2));
}

/// Invalid with fewer than kMinRoadPoints points on the road. Points with numbers that are not finite, or without a
/// positive sigma, are left out. Cost: 65 + 5 passes over the points.
inline constexpr int kMinRoadPoints = 12;
[[nodiscard]] RoadFit fit_road(const RoadPoints& points, const RoadPrior& prior, std::uint32_t seed);

}  // namespace semtrack

#endif
