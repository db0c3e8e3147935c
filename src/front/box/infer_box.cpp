#include "front/box/infer_box.hpp"

#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr int kPasses = 4;  // exact vertices are chosen anew after each solution
constexpr double kMinDepthInferred_m = 0.5;
constexpr double kMinExtent_px = 2.0;
constexpr double kGoodFit_px = 6.0;  // without viewpoint: hypotheses that fit worse are not offered

struct Plane {
    Vec3 a{Vec3::Zero()};  // normal in C
    double cos{0};         // a . R_c_l R_z C d = cos * cos(theta) + sin * sin(theta) + one
    double sin{0};
    double one{0};
    bool valid{false};
};

struct Planes {
    Plane edge[kBoxEdges];
    unsigned mask{0};
    int count{0};
};

Planes planes_of(const BoxInferenceInput& in, const EdgeVertices& vertices) {
    Planes out;
    const double u[2] = {(in.box.left - in.camera.cx) / in.camera.fx, (in.box.right - in.camera.cx) / in.camera.fx};
    const double v[2] = {(in.box.top - in.camera.cy) / in.camera.fy, (in.box.bottom - in.camera.cy) / in.camera.fy};
    const bool valid[kBoxEdges] = {in.box.left > kBorder_px,
                                   in.box.right<in.width - 1 - kBorder_px, in.box.top> kBorder_px,
                                   in.box.bottom < in.height - 1 - kBorder_px};
    for (int e = 0; e < kBoxEdges; ++e) {
        Plane& plane = out.edge[e];
        plane.valid = valid[e];
        plane.a = e < 2 ? Vec3(1.0, 0.0, -u[e]) : Vec3(0.0, 1.0, -v[e - 2]);
        const Vec3 q = in.R_c_l.transpose() * plane.a;
        const Vec3 c = vertices[static_cast<std::size_t>(e)].scaled(in.size_m);
        plane.cos = q(0) * c(0) + q(1) * c(1);
        plane.sin = q(1) * c(0) - q(0) * c(1);
        plane.one = q(2) * c(2);
        if (valid[e]) {
            out.mask |= 1U << static_cast<unsigned>(e);
            ++out.count;
        }
    }
    return out;
}

double offset(const Plane& plane, const SinCos& t) {
    return plane.cos * t.cos + plane.sin * t.sin + plane.one;
}

/// Least squares of a_e . p = -offset_e over the valid edges, exact for three. false: not enough of them.
bool position(const Planes& planes, double theta, Vec3& p_c) {
    if (planes.count < 3) {
        return false;
    }
    const SinCos t = sin_cos(theta);
    Mat3 H = Mat3::Zero();
    Vec3 g = Vec3::Zero();
    for (const Plane& plane : planes.edge) {
        if (!plane.valid) {
            continue;
        }
        H += plane.a * plane.a.transpose();
        g += plane.a * offset(plane, t);
    }
    const double determinant = H.determinant();
    if (!(determinant > 1e-12)) {
        return false;
    }
    p_c = -(H.inverse() * g);
    // One Newton step removes the rounding of the normal equations.
    Vec3 rest = g + H * p_c;
    p_c -= H.inverse() * rest;
    return std::isfinite(p_c(0)) && std::isfinite(p_c(1)) && std::isfinite(p_c(2));
}

/// Largest distance of the used edges from the box that the pose projects to; negative: behind the camera.
double reprojection_px(const BoxInferenceInput& in, const Planes& planes, const Vec3& p_c, double theta) {
    Box2d box;
    EdgeVertices unused;
    const Pose T_c_o{in.R_c_l * rot_z(theta), p_c};
    if (extreme_vertices(in.camera, T_c_o, in.size_m, unused) != Status::kOk ||
        projected_box(in.camera, T_c_o, in.size_m, box) != Status::kOk) {
        return -1.0;
    }
    double worst = 0.0;
    for (int e = 0; e < kBoxEdges; ++e) {
        const double d = std::fabs(edge_value(box, e) - edge_value(in.box, e));
        worst = planes.edge[e].valid && d > worst ? d : worst;
    }
    return worst;
}

bool in_range(const Vec3& p_c) {
    return p_c(2) > kMinDepthInferred_m && p_c.dot(p_c) < kMaxInferredDepth_m * kMaxInferredDepth_m;
}

/// Roots of a cos + b sin + c = 0; noise may push |c| a little beyond the amplitude: then the nearest angle.
bool heading_roots(const Planes& planes, double roots[2]) {
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
    constexpr double kSlack = 1.6;  // a box wider than any heading makes it is taken as side-on
    if (!(amplitude > 0.0) || !(std::fabs(c) < kSlack * amplitude)) {
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

int class_distance(int a, int b) {
    const int d = a > b ? a - b : b - a;
    return d > 4 ? 8 - d : d;
}

/// Lower is better: the residual, and a step of viewpoint class counts like 20 px.
double rank(const BoxHypothesis& h, const Viewpoint& wanted) {
    constexpr double kClassStep_px = 20.0;
    const int steps = h.viewpoint.horizontal < 0 ? 4 : class_distance(h.viewpoint.horizontal, wanted.horizontal);
    return h.residual_px + kClassStep_px * steps;
}

bool evaluate(const BoxInferenceInput& in, const Planes& planes, double theta, BoxHypothesis& out) {
    Vec3 p_c;
    if (!position(planes, theta, p_c) || !in_range(p_c)) {
        return false;
    }
    const double residual = reprojection_px(in, planes, p_c, theta);
    if (residual < 0.0) {
        return false;
    }
    out.p_c = p_c;
    out.theta = theta;
    out.edges = planes.mask;
    out.residual_px = residual;
    out.viewpoint = visible_faces({in.R_c_l * rot_z(theta), p_c}, in.size_m);
    return true;
}

/// Heading in L of an object seen under the middle of a class's angles.
double heading_of_class(const BoxInferenceInput& in, int horizontal) {
    const Vec3 ray_l = in.R_c_l.transpose() * bearing(in.camera, 0.5 * (in.box.left + in.box.right), in.camera.cy);
    const double to_object = atan2_rad(ray_l(1), ray_l(0));
    // alpha is measured from the side: class 6 (rear seen) drives away along the ray, class 0 shows its right side.
    const double turn = (6 - horizontal) * (kPi / 4.0);
    return wrap_angle(to_object + turn);
}

/// Best pose for one class; false: none.
bool solve_class(const BoxInferenceInput& in, const Viewpoint& view, BoxHypothesis& best) {
    bool found = false;
    EdgeVertices vertices = edge_vertices(view);
    for (int pass = 0; pass < kPasses; ++pass) {
        const Planes planes = planes_of(in, vertices);
        double thetas[2] = {in.theta, in.theta};
        int count = 1;
        if (planes.count == kBoxEdges && !in.has_theta) {
            if (!heading_roots(planes, thetas)) {
                break;
            }
            count = 2;
        } else if (!in.has_theta) {
            thetas[0] = heading_of_class(in, view.horizontal);
        }
        bool improved = false;
        BoxHypothesis local;
        for (int i = 0; i < count; ++i) {
            BoxHypothesis h;
            if (!evaluate(in, planes, thetas[i], h)) {
                continue;
            }
            if (!improved || rank(h, view) < rank(local, view)) {
                local = h;
            }
            improved = true;
        }
        if (!improved) {
            break;
        }
        if (!found || rank(local, view) < rank(best, view)) {
            best = local;
        }
        found = true;
        // Off the optical axis another corner may make the top or bottom edge: take the exact ones and solve again.
        EdgeVertices exact;
        if (extreme_vertices(in.camera, {in.R_c_l * rot_z(local.theta), local.p_c}, in.size_m, exact) != Status::kOk) {
            break;
        }
        vertices = exact;
    }
    return found;
}

Status infer_upright(const BoxInferenceInput& in, BoxHypotheses& out) {
    // Position from the middle of the box and the height; a pedestrian has no theta.
    const bool whole = in.box.top > kBorder_px && in.box.bottom < in.height - 1 - kBorder_px;
    const double extent = in.box.bottom - in.box.top;
    if (!whole || !(extent > kMinExtent_px)) {
        return Status::kNotObservable;
    }
    const Vec3 up_c = in.R_c_l.col(2);
    const double half = 0.5 * in.size_m(2);
    const Vec3 planes[3] = {{1.0, 0.0, -(0.5 * (in.box.left + in.box.right) - in.camera.cx) / in.camera.fx},
                            {0.0, 1.0, -(in.box.top - in.camera.cy) / in.camera.fy},
                            {0.0, 1.0, -(in.box.bottom - in.camera.cy) / in.camera.fy}};
    const double lift[3] = {0.0, half, -half};
    Mat3 A;
    Vec3 b;
    for (int r = 0; r < 3; ++r) {
        A.row(r) = planes[r].transpose();
        b(r) = -planes[r].dot(up_c) * lift[r];
    }
    BoxHypothesis h;
    h.p_c = A.inverse() * b;
    h.edges = 0xFU;
    if (!std::isfinite(h.p_c(0) + h.p_c(1) + h.p_c(2)) || !in_range(h.p_c)) {
        return Status::kNotObservable;
    }
    (void)out.try_push_back(h);
    return Status::kOk;
}

void insert_ranked(BoxHypotheses& out, const BoxHypothesis& h) {
    for (BoxHypothesis& other : out) {
        if (other.viewpoint.horizontal == h.viewpoint.horizontal) {
            if (h.residual_px < other.residual_px) {
                other = h;
            }
            return;
        }
    }
    (void)out.try_push_back(h);
}

void sort_by_residual(BoxHypotheses& out) {
    for (int i = 1; i < out.size(); ++i) {
        const BoxHypothesis h = out[i];
        int k = i;
        for (; k > 0 && out[k - 1].residual_px > h.residual_px; --k) {
            out[k] = out[k - 1];
        }
        out[k] = h;
    }
}

bool usable(const BoxInferenceInput& in) {
    const Box2d& b = in.box;
    return std::isfinite(b.left + b.top + b.right + b.bottom) && b.right - b.left > kMinExtent_px &&
           b.bottom - b.top > kMinExtent_px && in.size_m.minCoeff() > 0.0 && std::isfinite(in.theta);
}

}  // namespace

Status infer_box(const BoxInferenceInput& input, BoxHypotheses& out) {
    out.clear();
    if (!usable(input)) {
        return Status::kNotObservable;
    }
    if (!class_prior(input.object_class).has_heading) {
        return infer_upright(input, out);
    }
    const bool given = input.viewpoint.horizontal >= 0 && input.viewpoint.horizontal < 8;
    for (int h = 0; h < 8; ++h) {
        if (given && h != input.viewpoint.horizontal) {
            continue;
        }
        for (int v = 0; v < 2; ++v) {
            if (given && input.viewpoint.vertical >= 0 && v != input.viewpoint.vertical) {
                continue;
            }
            BoxHypothesis best;
            const Viewpoint view{static_cast<std::int8_t>(h), static_cast<std::int8_t>(v)};
            if (!solve_class(input, view, best)) {
                continue;
            }
            if (!given && (best.viewpoint.horizontal != h || best.residual_px > kGoodFit_px)) {
                continue;
            }
            insert_ranked(out, best);
        }
    }
    sort_by_residual(out);
    return out.empty() ? Status::kNotObservable : Status::kOk;
}

Viewpoint viewpoint_from_alpha(double alpha_rad, const Vec3& p_c, const Vec3& size_m) {
    // In the camera frame: rotation_y = alpha + atan2(x, z); heading (cos ry, 0, -sin ry), left (sin ry, 0, cos ry).
    const SinCos ry = sin_cos(alpha_rad + atan2_rad(p_c(0), p_c(2)));
    Pose T_c_o;
    T_c_o.R << ry.cos, ry.sin, 0.0, 0.0, 0.0, -1.0, -ry.sin, ry.cos, 0.0;
    T_c_o.t = p_c;
    return visible_faces(T_c_o, size_m);
}

}  // namespace semtrack
