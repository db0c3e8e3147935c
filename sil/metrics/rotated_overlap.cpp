#include "sil/metrics/rotated_overlap.hpp"

#include <algorithm>
#include <array>

#include "math/trig.hpp"

namespace semtrack::sil {

namespace {

using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

/// Corners of a in the axes of b (x along b's length, y along its width), origin at b's middle, in the order of a walk.
Polygon corners_in(const ObjectRow& a, const ObjectRow& b) {
    const SinCos turn = sin_cos(wrap_angle(b.rotation_y - a.rotation_y));
    const SinCos own = sin_cos(b.rotation_y);
    const double dx = a.bottom_c0(0) - b.bottom_c0(0);
    const double dz = a.bottom_c0(2) - b.bottom_c0(2);
    const double mx = own.cos * dx - own.sin * dz;
    const double my = own.sin * dx + own.cos * dz;
    const double l = 0.5 * a.size_m(0);
    const double w = 0.5 * a.size_m(1);
    Polygon out;
    for (const Point& c : {Point{l, w}, Point{-l, w}, Point{-l, -w}, Point{l, -w}}) {
        out.push_back({mx + turn.cos * c[0] - turn.sin * c[1], my + turn.sin * c[0] + turn.cos * c[1]});
    }
    return out;
}

/// The part of a convex polygon with sign * p[axis] <= limit (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& in, std::size_t axis, double sign, double limit) {
    Polygon out;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const Point& a = in[i];
        const Point& b = in[(i + 1U) % in.size()];
        const double da = limit - sign * a[axis];
        const double db = limit - sign * b[axis];
        if (da >= 0.0) {
            out.push_back(a);
        }
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
            const double s = da / (da - db);
            out.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
        }
    }
    return out;
}

double area(const Polygon& p) {
    double twice = 0.0;
    for (std::size_t i = 1; i + 1U < p.size(); ++i) {
        twice += (p[i][0] - p[0][0]) * (p[i + 1U][1] - p[0][1]) - (p[i + 1U][0] - p[0][0]) * (p[i][1] - p[0][1]);
    }
    return 0.5 * std::max(twice, -twice);
}

double common_area(const ObjectRow& a, const ObjectRow& b) {
    Polygon p = corners_in(a, b);
    for (const std::size_t axis : {0U, 1U}) {
        const double limit = 0.5 * b.size_m(axis == 0U ? 0 : 1);
        p = clip(p, axis, 1.0, limit);
        p = clip(p, axis, -1.0, limit);
    }
    return area(p);
}

double over_union(double common, double a, double b) {
    const double both = a + b - common;
    return common > 0.0 && both > 0.0 ? std::min(common / both, 1.0) : 0.0;
}

}  // namespace

double birdseye_overlap(const ObjectRow& a, const ObjectRow& b) {
    return over_union(common_area(a, b), a.size_m(0) * a.size_m(1), b.size_m(0) * b.size_m(1));
}

double box3d_overlap(const ObjectRow& a, const ObjectRow& b) {
    const double lower = std::min(a.bottom_c0(1), b.bottom_c0(1));  // y points down
    const double upper = std::max(a.bottom_c0(1) - a.size_m(2), b.bottom_c0(1) - b.size_m(2));
    const double common = lower > upper ? common_area(a, b) * (lower - upper) : 0.0;
    return over_union(common, a.size_m.prod(), b.size_m.prod());
}

}  // namespace semtrack::sil
