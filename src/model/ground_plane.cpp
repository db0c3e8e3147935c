#include "model/ground_plane.hpp"

#include <cmath>

namespace semtrack {

Vec3 ahead_of(const Pose& T_c_l) {
    const double x = T_c_l.R(2, 0);
    const double y = T_c_l.R(2, 1);
    const double length = std::sqrt(x * x + y * y);
    return length > 1e-3 ? Vec3(x / length, y / length, 0.0) : Vec3(1.0, 0.0, 0.0);
}

Vec3 ground_row(const Pose& T_c_l, const Vec3& x_l) {
    const Vec3 ahead = ahead_of(T_c_l);
    const Vec3 d = x_l + T_c_l.R.transpose() * T_c_l.t;
    return {-1.0, ahead(0) * d(0) + ahead(1) * d(1), ahead(0) * d(1) - ahead(1) * d(0)};
}

}  // namespace semtrack
