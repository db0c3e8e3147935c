#include "model/box_geometry.hpp"

#include <cmath>

namespace semtrack {

namespace {

constexpr int kHorizontal = 8;
constexpr int kVertical = 2;

// Vertical edges of the box by their signs (x, y) in O.
struct Corner {
    std::int8_t x;
    std::int8_t y;
};

/// What the visible faces say (docs/viewpoints.md): the outer vertical edges of the faces that are seen make the left
/// and the right edge of the 2D box; the corner nearest to the camera reaches lowest; the far one makes the top when
/// the roof is seen, the near one when it is not.
struct ViewCorners {
    Corner left;
    Corner right;
    Corner near;
    Corner far;
};
constexpr ViewCorners kViews[kHorizontal] = {
    {{-1, -1}, {1, -1}, {1, -1}, {1, 1}},  // 0 right side
    {{-1, -1}, {1, 1}, {1, -1}, {-1, 1}},  // 1 front and right
    {{1, -1}, {1, 1}, {1, 1}, {-1, 1}},    // 2 front
    {{1, -1}, {-1, 1}, {1, 1}, {-1, -1}},  // 3 front and left
    {{1, 1}, {-1, 1}, {1, 1}, {1, -1}},    // 4 left side
    {{1, 1}, {-1, -1}, {-1, 1}, {1, -1}},  // 5 rear and left: the paper's C_1..C_4
    {{-1, 1}, {-1, -1}, {-1, 1}, {1, 1}},  // 6 rear
    {{-1, 1}, {1, -1}, {-1, -1}, {1, 1}},  // 7 rear and right
};

constexpr EdgeVertices vertices_of(const ViewCorners& view, bool roof) {
    const Corner top = roof ? view.far : view.near;
    return {BoxVertex{view.left.x, view.left.y, 1}, BoxVertex{view.right.x, view.right.y, -1},
            BoxVertex{top.x, top.y, 1}, BoxVertex{view.near.x, view.near.y, -1}};
}

struct Tables {
    EdgeVertices of[kHorizontal][kVertical];
};

constexpr Tables make_tables() {
    Tables t{};
    for (int h = 0; h < kHorizontal; ++h) {
        for (int v = 0; v < kVertical; ++v) {
            t.of[h][v] = vertices_of(kViews[h], v == 1);
        }
    }
    return t;
}

constexpr Tables kTables = make_tables();

void extend(const PinholeCamera& camera, const Vec3& x_c, bool& any, Box2d& box) {
    const Vec2 q = project(camera, x_c);
    if (!any) {
        box = {q(0), q(1), q(0), q(1)};
        any = true;
        return;
    }
    box.left = q(0) < box.left ? q(0) : box.left;
    box.right = q(0) > box.right ? q(0) : box.right;
    box.top = q(1) < box.top ? q(1) : box.top;
    box.bottom = q(1) > box.bottom ? q(1) : box.bottom;
}

}  // namespace

BoxVertex box_vertex(int i) {
    return {static_cast<std::int8_t>((i & 1) != 0 ? 1 : -1), static_cast<std::int8_t>((i & 2) != 0 ? 1 : -1),
            static_cast<std::int8_t>((i & 4) != 0 ? 1 : -1)};
}

const EdgeVertices& edge_vertices(Viewpoint viewpoint) {
    const int h = viewpoint.horizontal & (kHorizontal - 1);
    return kTables.of[h][viewpoint.vertical == 1 ? 1 : 0];
}

Viewpoint visible_faces(const Pose& T_c_o, const Vec3& size_m) {
    const Vec3 camera_o = -(T_c_o.R.transpose() * T_c_o.t);
    const int along = camera_o(0) > 0.5 * size_m(0) ? 1 : camera_o(0) < -0.5 * size_m(0) ? -1 : 0;
    const int across = camera_o(1) > 0.5 * size_m(1) ? 1 : camera_o(1) < -0.5 * size_m(1) ? -1 : 0;
    //                                   right       none        left     of the two long sides
    constexpr std::int8_t kClass[3][3] = {{7, 6, 5},   // rear
                                          {0, -1, 4},  // neither
                                          {1, 2, 3}};  // front
    Viewpoint view;
    view.horizontal = kClass[along + 1][across + 1];
    view.vertical = camera_o(2) > 0.5 * size_m(2) ? 1 : 0;
    return view;
}

Status extreme_vertices(const PinholeCamera& camera, const Pose& T_c_o, const Vec3& size_m, EdgeVertices& out) {
    EdgeVertices found{};
    double best[kBoxEdges] = {0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 8; ++i) {
        const BoxVertex corner = box_vertex(i);
        const Vec3 x_c = T_c_o * corner.scaled(size_m);
        if (!(x_c(2) >= kMinDepth_m)) {
            return Status::kBehindCamera;
        }
        const Vec2 q = project(camera, x_c);
        const double value[kBoxEdges] = {-q(0), q(0), -q(1), q(1)};
        for (int e = 0; e < kBoxEdges; ++e) {
            if (i == 0 || value[e] > best[e]) {
                best[e] = value[e];
                found[static_cast<std::size_t>(e)] = corner;
            }
        }
    }
    out = found;
    return Status::kOk;
}

Status projected_box(const PinholeCamera& camera, const Pose& T_c_o, const Vec3& size_m, Box2d& out) {
    Vec3 corners[8];
    for (int i = 0; i < 8; ++i) {
        corners[i] = T_c_o * box_vertex(i).scaled(size_m);
    }
    bool any = false;
    Box2d box;
    for (int i = 0; i < 8; ++i) {
        if (corners[i](2) >= kMinDepth_m) {
            extend(camera, corners[i], any, box);
        }
        // The box's edges join vertices that differ in one bit; where one crosses the near plane, it is cut there.
        for (int bit = 1; bit < 8; bit <<= 1) {
            const int j = i | bit;
            if (j == i) {
                continue;
            }
            const double zi = corners[i](2);
            const double zj = corners[j](2);
            if ((zi >= kMinDepth_m) == (zj >= kMinDepth_m)) {
                continue;
            }
            const double s = (kMinDepth_m - zi) / (zj - zi);
            Vec3 cut = corners[i] + s * (corners[j] - corners[i]);
            cut(2) = kMinDepth_m;
            extend(camera, cut, any, box);
        }
    }
    if (!any) {
        return Status::kBehindCamera;
    }
    out = box;
    return Status::kOk;
}

double box_overlap(const Box2d& a, const Box2d& b) {
    const double w = (a.right < b.right ? a.right : b.right) - (a.left > b.left ? a.left : b.left);
    const double h = (a.bottom < b.bottom ? a.bottom : b.bottom) - (a.top > b.top ? a.top : b.top);
    if (!(w > 0.0) || !(h > 0.0)) {
        return 0.0;
    }
    const double common = w * h;
    const double all = (a.right - a.left) * (a.bottom - a.top) + (b.right - b.left) * (b.bottom - b.top) - common;
    return all > 0.0 ? common / all : 0.0;
}

bool clip_box(const Box2d& box, int width, int height, Box2d& out) {
    const double right = static_cast<double>(width - 1);
    const double bottom = static_cast<double>(height - 1);
    if (!(box.left < right) || !(box.right > 0.0) || !(box.top < bottom) || !(box.bottom > 0.0)) {
        return false;
    }
    out = {box.left > 0.0 ? box.left : 0.0, box.top > 0.0 ? box.top : 0.0, box.right < right ? box.right : right,
           box.bottom < bottom ? box.bottom : bottom};
    return true;
}

Box2d carried_to_right(const Calibration& calibration, const Box2d& box, double near_m, double far_m) {
    constexpr double kAtBorder_px = 1.5;
    const double last = static_cast<double>(calibration.width - 1);
    const double focal_base = calibration.left.fx * calibration.baseline_m;
    const double rows[4] = {right_row(calibration, box.top, focal_base / near_m),
                            right_row(calibration, box.top, focal_base / far_m),
                            right_row(calibration, box.bottom, focal_base / near_m),
                            right_row(calibration, box.bottom, focal_base / far_m)};
    Box2d out;
    out.left = box.left > kAtBorder_px ? right_column(calibration, box.left, near_m) : 0.0;
    out.right = box.right < last - kAtBorder_px ? right_column(calibration, box.right, far_m) : last;
    out.top = rows[0] < rows[1] ? rows[0] : rows[1];
    out.bottom = rows[2] > rows[3] ? rows[2] : rows[3];
    return out;
}

}  // namespace semtrack
