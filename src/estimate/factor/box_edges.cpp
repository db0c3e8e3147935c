#include "estimate/factor/box_edges.hpp"

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {
constexpr double kParallel_m = 0.01;  // a side along the border's plane has no point in it
}

double box_heading(const ObjectState& x, ObjectClass object_class, const DetectionView& view) {
    if (class_prior(object_class).has_heading) {
        return x.theta;
    }
    const Vec3 camera_l = -(view.T_d_l.R.transpose() * view.T_d_l.t);
    return atan2_rad(camera_l(1) - x.p(1), camera_l(0) - x.p(0));
}

void box_edge_residuals(const ObjectState& x, ObjectClass object_class, const Vec3& size_m, const DetectionView& view,
                        const BoxOutline& outline, const BoxMeasurement& box, bool derivatives, EdgeResiduals& out) {
    const bool has_heading = class_prior(object_class).has_heading;
    const Mat3 R_l_o = rot_z(box_heading(x, object_class, view));
    const Mat3 R_d_o = view.T_d_l.R * R_l_o;
    const Vec3 centre_d = view.T_d_l * x.p;
    for (int e = 0; e < kBoxEdges; ++e) {
        EdgeResidual& edge = out[static_cast<std::size_t>(e)];
        edge = EdgeResidual{};
        const double sigma = box.sigma_px[static_cast<std::size_t>(e)];
        const OutlinePoint& point = outline[static_cast<std::size_t>(e)];
        const Vec3 x_a = centre_d + R_d_o * point.a.scaled(size_m);
        const Vec3 x_b = centre_d + R_d_o * point.b.scaled(size_m);
        const double share = point.cut ? point.share_of_b(x_a, x_b) : 0.0;
        const Vec3 x_d = x_a + share * (x_b - x_a);
        if (!(sigma > 0.0) || !point.valid || !(x_d(2) >= kMinDepth_m)) {
            continue;
        }
        const bool column = e == kLeft || e == kRight;
        const int axis = column ? 0 : 1;
        const double focal = (column ? view.camera.fx : view.camera.fy) / sigma;
        const double centre = column ? view.camera.cx : view.camera.cy;
        const double slope = x_d(axis) / x_d(2);
        edge.valid = true;
        edge.r = focal * slope + (centre - edge_value(box.box, e)) / sigma;
        if (!derivatives) {
            continue;
        }
        Vec3 g = Vec3::Zero();  // derivative by x_d
        g(axis) = focal / x_d(2);
        g(2) = -focal * slope / x_d(2);
        if (point.cut) {
            // The point slides along the side a-b as the box moves, so that it stays in the border's plane n . x = 0.
            const Vec3 n(1.0, 0.0, -point.slope);
            const Vec3 side = x_b - x_a;
            const double across = n.dot(side);
            if (across > kParallel_m || across < -kParallel_m) {
                g -= (g.dot(side) / across) * n;
            }
        }
        const Vec3 corner_o = (1.0 - share) * point.a.scaled(size_m) + share * point.b.scaled(size_m);
        edge.J_state.head<3>() = view.T_d_l.R.transpose() * g;
        const Vec3 g_o = R_d_o.transpose() * g;
        if (has_heading) {
            edge.J_state(3) = g_o(1) * corner_o(0) - g_o(0) * corner_o(1);
        }
        edge.J_size = corner_o.cwiseQuotient(size_m).cwiseProduct(g_o);
    }
}

}  // namespace semtrack
