#include "estimate/factor/face_view.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace semtrack {

namespace {
constexpr double kNearest_m = 1.0;
}

FaceViewResidual face_view_residual(const ObjectState& x, double width_m, const Vec3& camera_l, int horizontal,
                                    double sigma_rad) {
    // Classes 3 and 5: front and rear with the left side; 1 and 7 with the right one.
    const double side = horizontal == 3 || horizontal == 5 ? 1.0 : horizontal == 1 || horizontal == 7 ? -1.0 : 0.0;
    const double dx = camera_l(0) - x.p(0);
    const double dy = camera_l(1) - x.p(1);
    const double range = std::sqrt(dx * dx + dy * dy);
    FaceViewResidual out;
    if (side == 0.0 || !(range > kNearest_m)) {
        return out;
    }
    const SinCos h = sin_cos(x.theta);
    const double along = h.cos * dx + h.sin * dy;
    const double across = h.cos * dy - h.sin * dx;
    const double missed = 0.5 * width_m - side * across;
    if (missed > 0.0) {
        const double scale = 1.0 / (range * sigma_rad);
        out.r = missed * scale;
        out.J_theta = side * along * scale;
    }
    return out;
}

}  // namespace semtrack
