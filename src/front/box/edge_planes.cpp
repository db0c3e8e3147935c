#include "front/box/edge_planes.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace semtrack {

unsigned valid_edges(const Box2d& box, int width, int height) {
    const bool valid[kBoxEdges] = {box.left > kBorder_px, box.right<width - 1 - kBorder_px, box.top> kBorder_px,
                                   box.bottom < height - 1 - kBorder_px};
    unsigned mask = 0;
    for (int e = 0; e < kBoxEdges; ++e) {
        mask |= valid[e] ? 1U << static_cast<unsigned>(e) : 0U;
    }
    return mask;
}

EdgePlanes edge_planes(const PinholeCamera& camera, const Mat3& R_c_l, const Box2d& box, unsigned valid,
                       const EdgeVertices& vertices, const Vec3& size_m) {
    EdgePlanes out;
    out.mask = valid;
    for (int e = 0; e < kBoxEdges; ++e) {
        EdgePlane& plane = out.edge[e];
        const double value = edge_value(box, e);
        plane.a = e < kTop ? Vec3(1.0, 0.0, -(value - camera.cx) / camera.fx)
                           : Vec3(0.0, 1.0, -(value - camera.cy) / camera.fy);
        const Vec3 q = R_c_l.transpose() * plane.a;
        const Vec3 c = vertices[static_cast<std::size_t>(e)].scaled(size_m);
        plane.cos = q(0) * c(0) + q(1) * c(1);
        plane.sin = q(1) * c(0) - q(0) * c(1);
        plane.one = q(2) * c(2);
        plane.valid = ((valid >> static_cast<unsigned>(e)) & 1U) != 0U;
        out.count += plane.valid ? 1 : 0;
    }
    return out;
}

bool heading_roots(const EdgePlanes& planes, double roots[2]) {
    if (planes.count != kBoxEdges) {
        return false;
    }
    const double h = planes.edge[kBottom].a(2) - planes.edge[kTop].a(2);  // -(v_b - v_t)
    const double w = planes.edge[kRight].a(2) - planes.edge[kLeft].a(2);  // -(u_r - u_l)
    const double n[kBoxEdges] = {h, -h, -w, w};
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    for (int e = 0; e < kBoxEdges; ++e) {
        a += n[e] * planes.edge[e].cos;
        b += n[e] * planes.edge[e].sin;
        c += n[e] * planes.edge[e].one;
    }
    const double amplitude = std::sqrt(a * a + b * b);
    if (!(amplitude > 0.0) || !(std::fabs(c) < kWidthSlack * amplitude)) {
        return false;
    }
    double x = -c / amplitude;
    x = x > 1.0 ? 1.0 : x < -1.0 ? -1.0 : x;
    const double phase = atan2_rad(b, a);
    const double spread = atan2_rad(std::sqrt((1.0 - x) * (1.0 + x)), x);
    roots[0] = wrap_angle(phase + spread);
    roots[1] = wrap_angle(phase - spread);
    return true;
}

bool position_at(const EdgePlanes& planes, double theta, Vec3& p_c) {
    if (planes.count < 3) {
        return false;
    }
    const SinCos t = sin_cos(theta);
    Mat3 H = Mat3::Zero();
    Vec3 g = Vec3::Zero();
    for (const EdgePlane& plane : planes.edge) {
        if (plane.valid) {
            H += plane.a * plane.a.transpose();
            g += plane.a * (plane.cos * t.cos + plane.sin * t.sin + plane.one);
        }
    }
    const double determinant = H.determinant();
    if (!(determinant > 1e-12)) {
        return false;
    }
    const Mat3 inverse = H.inverse();
    p_c = -(inverse * g);
    p_c -= inverse * (g + H * p_c);  // one step removes the rounding of the normal equations
    return std::isfinite(p_c(0)) && std::isfinite(p_c(1)) && std::isfinite(p_c(2));
}

}  // namespace semtrack
