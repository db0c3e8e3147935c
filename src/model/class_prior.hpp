// What is known of an object by its class alone.
#ifndef SEMTRACK_MODEL_CLASS_PRIOR_HPP
#define SEMTRACK_MODEL_CLASS_PRIOR_HPP

#include "math/eigen.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

enum class MotionModel : std::uint8_t { kVehicle, kPedestrian };

/// Sizes are (length, width, height). Source: means and standard deviations of the KITTI object labels.
struct ClassPrior {
    Vec3 size_m;
    Vec3 size_sigma_m;
    double wheelbase_ratio;  ///< wheelbase / length (bicycle model)
    MotionModel motion;
    bool has_heading;  ///< viewpoint and theta mean something
};

[[nodiscard]] const ClassPrior& class_prior(ObjectClass object_class);

}  // namespace semtrack

#endif
