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
        const double inv2 = 1.0 / (range * range);
        out.J_p = Vec3(out.r * dx * inv2 - side * h.sin * scale, out.r * dy * inv2 + side * h.cos * scale, 0.0);
        out.J_theta = side * along * scale;
        out.J_width = 0.5 * scale;
    }
    return out;
}

}  // namespace semtrack
