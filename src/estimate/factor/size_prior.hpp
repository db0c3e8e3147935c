// Dimension prior r_P, paper Eq. (10) [eq:object-motion2]: |r|^2 = (d - d_l)^T Sigma_l^-1 (d - d_l), with the class's
// covariance (sizes are correlated: long cars are wide).
#ifndef SEMTRACK_ESTIMATE_FACTOR_SIZE_PRIOR_HPP
#define SEMTRACK_ESTIMATE_FACTOR_SIZE_PRIOR_HPP

#include "math/eigen.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct SizePrior {
    Vec3 mean_m{Vec3::Ones()};
    Mat3 covariance{Mat3::Identity()};
    Mat3 information{Mat3::Identity()};
};

/// Mean and information of a class, from model/class_prior and the correlations of the KITTI labels.
[[nodiscard]] SizePrior size_prior(ObjectClass object_class);
/// |r|^2; its gradient is 2 information (d - mean), its Hessian 2 information.
[[nodiscard]] double size_prior_cost(const SizePrior& prior, const Vec3& size_m);

}  // namespace semtrack

#endif
