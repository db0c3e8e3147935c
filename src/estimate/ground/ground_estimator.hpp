// Ground contact G, first half: the road near the vehicle, from the bottoms of the other objects and from points on it.
//   Theta = (h, s_f, s_l) of model/ground_plane.hpp,  prior (camera height, 0, 0)
//   evidence: a point on the road, z_p - z_c = (-1, f, l) Theta + e,  e ~ N(0, sigma^2)
// Kept in information form, one share per object, so that an object is judged by the evidence of the others only. Old
// evidence fades: the road changes as the vehicle goes on.
#ifndef SEMTRACK_ESTIMATE_GROUND_GROUND_ESTIMATOR_HPP
#define SEMTRACK_ESTIMATE_GROUND_GROUND_ESTIMATOR_HPP

#include <array>
#include <cstdint>

#include "estimate/ground/road_fit.hpp"
#include "model/ground_plane.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/config.hpp"

namespace semtrack {

class GroundEstimator {
public:
    void init(const Config& config);
    /// Once a frame, dt_s after the last one.
    void fade(double dt_s);
    /// slot -1: not an object's. x_l: on the road, with the standard deviation of its height. An object's error is that
    /// of its size, the same in every frame: a frame's evidence counts by what has faded since the last one, so that
    /// all of them together count once.
    void add(int slot, const Pose& T_c_l, const Vec3& x_l, double sigma_m);
    /// The background points of this frame that may be road (road_fit.hpp). The road's own unevenness and the
    /// calibration stay from frame to frame: like an object's, a frame's evidence counts by what has faded. False: too
    /// few of them are road, and nothing was learnt.
    bool add_road(const RoadPoints& points, std::uint32_t seed);
    /// Slopes at which the vehicle itself stands in L, about which background points are looked for. The prior of
    /// plane() stays level: one frame's attitude carries bumps.
    void set_vehicle(double slope_forward, double slope_left);
    /// (h, s_f, s_l) of the plane on which the vehicle stands.
    [[nodiscard]] const Vec3& vehicle_plane() const { return vehicle_; }
    /// The object in this slot is another one from now on; what the old one said of the road stays.
    void release(int slot);
    /// From all evidence but the slot's (-1: from all). Cost: one 3x3 inverse.
    [[nodiscard]] GroundPlane plane(int without_slot) const;

private:
    struct Evidence {
        Mat3 information{Mat3::Zero()};
        Vec3 vector{Vec3::Zero()};  // information times what it says
    };

    Vec3 mean_{Vec3::Zero()};  // of the prior
    Vec3 vehicle_{Vec3::Zero()};
    double fresh_{1};  // share of an object's evidence that the last fade() took
    Evidence prior_{};
    Evidence all_{};   // of objects that are gone
    Evidence road_{};  // of background points
    std::array<Evidence, static_cast<std::size_t>(kMaxObjects)> of_slot_{};
};

}  // namespace semtrack

#endif
