#include "pipeline/level.hpp"

#include <cmath>

#include "math/so3.hpp"

namespace semtrack {

namespace {
constexpr double kAveraging_s = 1.0;
}

void LocalLevel::reset() {
    up_w_ = Vec3(0.0, 0.0, 1.0);
    R_l_w_ = Mat3::Identity();
}

void LocalLevel::update(const Mat3& R_w_v, double dt_s) {
    const double share = dt_s < kAveraging_s ? dt_s / kAveraging_s : 1.0;
    const Vec3 up = up_w_ + share * (Vec3(R_w_v.col(2)) - up_w_);
    const double length = std::sqrt(up.dot(up));
    if (!(length > 0.1)) {
        return;
    }  // upside down within a second: nothing to average
    up_w_ = up / length;
    // R = I + [w]x + [w]x^2 / (1 + c), w = up x z, c = up . z
    const double c = up_w_(2);
    if (!(c > -0.99)) {
        return;
    }
    const Mat3 W = skew(Vec3(up_w_(1), -up_w_(0), 0.0));
    R_l_w_ = orthonormalised(Mat3::Identity() + W + (1.0 / (1.0 + c)) * (W * W));
}

}  // namespace semtrack
