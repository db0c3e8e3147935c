// Ground contact G (ours, beside the paper's cues): the bottom of the box lies on the road,
//   r = (z_b - z_c + h) / sigma,   z_b = p_z - d_h / 2,  z_c the camera's, h its height above the road, all in L.
// sigma grows with the distance: the road is no plane. Measured on labelled cars about a flat plane: 0.23 m at
// 10-20 m, 0.47 m at 40-60 m.
#ifndef SEMTRACK_ESTIMATE_FACTOR_GROUND_HPP
#define SEMTRACK_ESTIMATE_FACTOR_GROUND_HPP

#include "model/object_window.hpp"

namespace semtrack {

struct GroundPrior {
    bool valid{false};
    double camera_height_m{1.65};
    double camera_height_sigma_m{0.03};
};

struct GroundResidual {
    double r{0};
    double J_z{0};       ///< by p(2)
    double J_height{0};  ///< by size(2)
};

[[nodiscard]] GroundResidual ground_residual(const ObjectState& x, double height_m, const Pose& T_c_l,
                                             const GroundPrior& prior);

}  // namespace semtrack

#endif
