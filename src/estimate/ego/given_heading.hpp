// Poses from a GPS/IMU point beside the camera by an angle that stays for a drive (0.1 to 1.1 degrees in KITTI's):
// every parked car then slides sideways by that share of the path. A vehicle does not slip: the camera's step tells the
// angle.
//   y = beta - psi / 2 = delta + c psi / s + e,  e ~ N(0, 0.5 deg)
// beta: of the step against V's x, to the left; psi: turned within the step, both about V's z; s: length of the step;
// delta: the angle; c: how far the camera lies ahead of the axle that does not slip.
#ifndef SEMTRACK_ESTIMATE_EGO_GIVEN_HEADING_HPP
#define SEMTRACK_ESTIMATE_EGO_GIVEN_HEADING_HPP

#include "math/eigen.hpp"
#include "math/pose.hpp"

namespace semtrack {

class GivenHeading {
public:
    void reset();
    /// T_prev_cur: of the camera, as given. Steps below 0.3 m, backwards or in a tight turn say nothing.
    void update(const Pose& T_prev_cur, const Mat3& R_v_c);
    /// R_given_c: the camera's axes in the given ones, R_w_c = R_w_given R_given_c; of the newest angle.
    [[nodiscard]] Mat3 correction(const Mat3& R_v_c) const;
    [[nodiscard]] double angle_rad() const { return x_(0); }

private:
    Vec2 x_{Vec2::Zero()};  // delta, c
    Mat2 covariance_{Mat2::Identity()};
};

}  // namespace semtrack

#endif
