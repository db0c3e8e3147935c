// What the ego-motion is expected to be without images: from the vehicle's sensors, else as it was.
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_PREDICTION_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_PREDICTION_HPP

#include "math/eigen.hpp"
#include "math/pose.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// xi_a = Ad(T_a_b) xi_b for perturbations (translation, rotation): T_a_b exp(xi_b) = exp(xi_a) T_a_b.
[[nodiscard]] Mat6 adjoint(const Pose& T_a_b);

struct MotionPrediction {
    Pose T_cur_prev{};              ///< a point in the last camera frame -> in the coming one
    Mat6 covariance{Mat6::Zero()};  ///< of T_prev_cur (translation, rotation), perturbed in the coming camera
};

/// Speed along V's x and yaw rate about V's z, on an arc. dt_s > 0. Not finite numbers count as standing still.
[[nodiscard]] MotionPrediction predict_from_vehicle(const VehicleMotion& motion, const Pose& T_v_c, double dt_s);
/// The last motion T_last (T_cur_prev over last_dt_s) goes on at the same rate. last_dt_s 0: nothing is known yet.
[[nodiscard]] MotionPrediction predict_constant(const Pose& T_last, double last_dt_s, double dt_s);

}  // namespace semtrack

#endif
