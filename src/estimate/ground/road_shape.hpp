// Is the road a plane? Points in the lane ahead, judged about the plane that ground contact uses.
//   A surface that goes on from the plane with a bend b near the distance f0:  r(f) = c + b |f - f0|, |c| < 0.4 m,
//   beyond f0 or before it; r: height above the plane. The line that most points follow within their own noise, half of
//   those on that side or more, tells what is road: walls, plants and cars do not lie on one line over metres of
//   length. chi2 = mean over these points of  r^2 / (sigma^2 + (0.06 + 0.004 f)^2), the largest of f0 = 6, 10 .. 26 m
// The expected value on a road as uneven as ground contact admits (factor/ground.hpp) is 1: the flag rises when chi2 is
// above 4, an error of twice what is admitted, in 3 frames in a row, and falls when it is below 2 in 5 frames in a row.
// Nothing to judge by, as without images: as below 2.
#ifndef SEMTRACK_ESTIMATE_GROUND_ROAD_SHAPE_HPP
#define SEMTRACK_ESTIMATE_GROUND_ROAD_SHAPE_HPP

#include "estimate/ground/road_fit.hpp"

namespace semtrack {

inline constexpr double kRoadRise = 4.0;
inline constexpr double kRoadFall = 2.0;
inline constexpr int kRoadRiseFrames = 3;
inline constexpr int kRoadFallFrames = 5;

/// chi2 of the lane ahead about `plane` = (h, s_f, s_l); 0 when too little of it is seen. Points with numbers that are
/// not finite, or without a positive sigma, are left out. Cost: 2 x 6 x 33 passes over the points.
[[nodiscard]] double road_chi2(const RoadPoints& lane, const Vec3& plane);

/// The flag with its hysteresis.
class RoadShape {
public:
    void reset() { *this = RoadShape{}; }
    /// Once a frame. Returns the flag.
    bool update(double chi2);

private:
    bool bent_{false};
    int frames_{0};  ///< in a row that speak for a change
};

}  // namespace semtrack

#endif
