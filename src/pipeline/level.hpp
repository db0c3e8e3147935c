// The local vertical: V's up averaged over about the last second. W's z is wrong after a slope (at 5 degrees the ends
// of a car move by 0.17 m, straight into depth); V's up of one frame carries bumps.
#ifndef SEMTRACK_PIPELINE_LEVEL_HPP
#define SEMTRACK_PIPELINE_LEVEL_HPP

#include "math/eigen.hpp"

namespace semtrack {

class LocalLevel {
public:
    void reset();
    /// R_w_v of this frame, dt since the last one.
    void update(const Mat3& R_w_v, double dt_s);
    /// Smallest rotation that turns the averaged up to z.
    [[nodiscard]] const Mat3& R_l_w() const { return R_l_w_; }

private:
    Vec3 up_w_{0.0, 0.0, 1.0};
    Mat3 R_l_w_{Mat3::Identity()};
};

}  // namespace semtrack

#endif
