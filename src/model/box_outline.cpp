#include "model/box_outline.hpp"

namespace semtrack {

namespace {

/// Keeps the extreme point of each edge.
struct Search {
    BoxOutline outline{};
    std::array<double, kBoxEdges> best{};

    void offer(int edge, double value, const OutlinePoint& point) {
        const auto e = static_cast<std::size_t>(edge);
        if (!outline[e].valid || value > best[e]) {
            best[e] = value;
            outline[e] = point;
            outline[e].valid = true;
        }
    }
    void offer_rows(const PinholeCamera& camera, const Vec3& x_c, const OutlinePoint& point) {
        const double v = project(camera, x_c)(1);
        offer(kTop, -v, point);
        offer(kBottom, v, point);
    }
};

/// How far inside a border's plane a point lies, in metres at its depth: side 0 left, 1 right.
double inside(const std::array<double, 2>& slope, int side, const Vec3& x_c) {
    const auto s = static_cast<std::size_t>(side);
    return side == 0 ? x_c(0) - slope[s] * x_c(2) : slope[s] * x_c(2) - x_c(0);
}

}  // namespace

double OutlinePoint::share_of_b(const Vec3& x_a, const Vec3& x_b) const {
    const double fa = x_a(0) - slope * x_a(2);
    const double fb = x_b(0) - slope * x_b(2);
    const double t = fa - fb > 1e-9 || fb - fa > 1e-9 ? fa / (fa - fb) : 0.0;
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

BoxOutline box_outline(const PinholeCamera& camera, int width, const Pose& T_c_o, const Vec3& size_m) {
    const std::array<double, 2> slope{(0.0 - camera.cx) / camera.fx,
                                      (static_cast<double>(width - 1) - camera.cx) / camera.fx};
    std::array<BoxVertex, 8> corner;
    std::array<Vec3, 8> x_c;
    bool whole = true;  // in front of the camera
    bool outside[2] = {false, false};
    for (int i = 0; i < 8; ++i) {
        const auto k = static_cast<std::size_t>(i);
        corner[k] = box_vertex(i);
        x_c[k] = T_c_o * corner[k].scaled(size_m);
        whole = whole && x_c[k](2) >= kMinDepth_m;
        outside[0] = outside[0] || inside(slope, 0, x_c[k]) < 0.0;
        outside[1] = outside[1] || inside(slope, 1, x_c[k]) < 0.0;
    }
    Search search;
    for (int i = 0; i < 8; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (x_c[k](2) >= kMinDepth_m) {
            const OutlinePoint vertex{true, false, corner[k], corner[k], 0.0};
            const double u = project(camera, x_c[k])(0);
            search.offer(kLeft, -u, vertex);
            search.offer(kRight, u, vertex);
            if (inside(slope, 0, x_c[k]) >= 0.0 && inside(slope, 1, x_c[k]) >= 0.0) {
                search.offer_rows(camera, x_c[k], vertex);
            }
        }
        for (int bit = 1; bit < 8; bit <<= 1) {  // the box's sides join vertices that differ in one bit
            const auto j = static_cast<std::size_t>(i | bit);
            for (int side = 0; side < 2 && j != k; ++side) {
                if ((inside(slope, side, x_c[k]) >= 0.0) == (inside(slope, side, x_c[j]) >= 0.0)) {
                    continue;
                }
                const OutlinePoint cut{true, true, corner[k], corner[j], slope[static_cast<std::size_t>(side)]};
                const Vec3 x = x_c[k] + cut.share_of_b(x_c[k], x_c[j]) * (x_c[j] - x_c[k]);
                if (x(2) >= kMinDepth_m && inside(slope, 1 - side, x) >= 0.0) {
                    search.offer_rows(camera, x, cut);
                }
            }
        }
    }
    search.outline[kLeft].valid = search.outline[kLeft].valid && (whole || !outside[0]);
    search.outline[kRight].valid = search.outline[kRight].valid && (whole || !outside[1]);
    return search.outline;
}

Status seen_box(const PinholeCamera& camera, int width, int height, const Pose& T_c_o, const Vec3& size_m, Box2d& out) {
    const BoxOutline outline = box_outline(camera, width, T_c_o, size_m);
    if (!outline[kTop].valid) {
        return Status::kBehindCamera;
    }
    Box2d box{0.0, 0.0, static_cast<double>(width - 1), 0.0};
    for (int e = 0; e < kBoxEdges; ++e) {
        const OutlinePoint& point = outline[static_cast<std::size_t>(e)];
        if (!point.valid) {
            continue;  // left or right: it goes on to the border
        }
        const Vec3 x_a = T_c_o * point.a.scaled(size_m);
        const Vec3 x_b = T_c_o * point.b.scaled(size_m);
        const Vec2 q = project(camera, point.cut ? Vec3(x_a + point.share_of_b(x_a, x_b) * (x_b - x_a)) : x_a);
        (e == kLeft ? box.left : e == kRight ? box.right : e == kTop ? box.top : box.bottom) = q(e <= kRight ? 0 : 1);
    }
    return clip_box(box, width, height, out) ? Status::kOk : Status::kBehindCamera;
}

}  // namespace semtrack
