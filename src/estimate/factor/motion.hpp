// Motion model r_M, paper Eq. (15)-(16) (after gu2017): r = W (x_t - f(x_{t-1})), W the square root of the
// information. Three models: bicycle at the rear axle (vehicles), straight on (pedestrians), and standing.
#ifndef SEMTRACK_ESTIMATE_FACTOR_MOTION_HPP
#define SEMTRACK_ESTIMATE_FACTOR_MOTION_HPP

#include "model/class_prior.hpp"
#include "model/object_window.hpp"

namespace semtrack {

/// Random walk of each component; a step over dt has sigma = density sqrt(dt), so frames may lie any time apart.
struct MotionNoise {
    double position{0.1};  ///< m / sqrt(s), in the plane
    double height{0.1};    ///< m / sqrt(s): the road is no plane
    double heading{0.1};   ///< rad / sqrt(s)
    double speed{1.0};     ///< m/s / sqrt(s)
    double steering{0.1};  ///< rad / sqrt(s)
    double ego_across{0};  ///< of the camera's own step, across it: an error of its direction turns every path
};

struct MotionModelSpec {
    MotionModel model{MotionModel::kVehicle};
    bool standing{false};     ///< f(x) = x with v = 0
    double wheelbase_m{2.5};  ///< vehicles
    MotionNoise noise{};
    Vec3 ego_direction{Vec3(1.0, 0.0, 0.0)};  ///< of the camera's step in L, level, of length 1 ...
    double ego_step_m{0};                     ///< ... and its length
};

/// Fills the camera's step from its poses before and after.
void set_ego_step(const Pose& T_before_l, const Pose& T_after_l, MotionModelSpec& spec);

/// r [sigmas] of (p, theta, v, delta); J_before, J_after 6x6 by the states when derivatives is set.
void motion_residual(const ObjectState& before, const ObjectState& after, double dt_s, const MotionModelSpec& spec,
                     bool derivatives, Vec6& r, Mat6& J_before, Mat6& J_after);

}  // namespace semtrack

#endif
