// The vehicle's own sensors (wheel speed, yaw rate) as a further factor of the ego adjustment, between the camera poses
// T_before and T_now (camera from world) of two frames that follow each other:
//   e = log(T_now T_before^-1 M^-1),  M: T_cur_prev by predict_from_vehicle();  cost 0.5 rho(e^T Lambda e), Huber
// (a wheel that slips counts linearly). e = (translation, rotation), left perturbations.
#ifndef SEMTRACK_ESTIMATE_EGO_VEHICLE_FACTOR_HPP
#define SEMTRACK_ESTIMATE_EGO_VEHICLE_FACTOR_HPP

#include "estimate/ego/ego_prediction.hpp"
#include "math/eigen.hpp"
#include "math/pose.hpp"

namespace semtrack {

/// Motion from the frame before, measured by the vehicle.
struct VehicleStep {
    bool valid{false};
    Pose T_cur_prev{};
    Mat6 information{Mat6::Zero()};
};

/// valid only when the covariance of the prediction can be inverted.
[[nodiscard]] VehicleStep vehicle_step(const MotionPrediction& prediction);

/// e, and its derivatives by perturbed_left() of T_now and T_before; e beyond 1 rad is no longer exact.
void vehicle_residual(const Pose& T_now, const Pose& T_before, const VehicleStep& step, Vec6& e, Mat6& J_now,
                      Mat6& J_before);

}  // namespace semtrack

#endif
