#include "front/box/infer_box.hpp"

#include <cmath>

#include "front/box/edge_planes.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr int kPasses = 4;
constexpr double kMinDepthInferred_m = 0.5;
constexpr double kMinExtent_px = 2.0;
constexpr double kGoodFit_px = 6.0;      // without viewpoint: hypotheses that fit worse are not offered
constexpr double kMaxMisfit = 0.8;       // of the box's larger side: beyond, such an object does not make such a box
constexpr double kConsistent_px = 1e-6;  // the corners that were assumed do make the edges
constexpr double kSamePose_rad = 1e-6;   // two corner pairs may meet in one pose: a corner straight behind another
constexpr double kSamePoseShare = 1e-6;  // of the depth
constexpr double kClassStep_px = 20.0;   // a step of viewpoint class away from the one given
constexpr double kAcross_px = 6.0;       // without viewpoint: a heading across the camera's axis; traffic goes along

/// Largest distance of the used edges from the box that the pose projects to; negative: behind the camera.
double reprojection_px(const BoxInferenceInput& in, unsigned mask, const Pose& T_c_o) {
    EdgeVertices exact;
    if (extreme_vertices(in.camera, T_c_o, in.size_m, exact) != Status::kOk) {
        return -1.0;
    }
    double worst = 0.0;
    for (int e = 0; e < kBoxEdges; ++e) {
        if (((mask >> static_cast<unsigned>(e)) & 1U) == 0U) {
            continue;
        }
        const Vec2 q = project(in.camera, T_c_o * exact[static_cast<std::size_t>(e)].scaled(in.size_m));
        const double d = std::fabs(q(e < kTop ? 0 : 1) - edge_value(in.box, e));
        worst = d > worst ? d : worst;
    }
    return worst;
}

bool in_range(const Vec3& p_c) {
    return p_c(2) > kMinDepthInferred_m && p_c.dot(p_c) < kMaxInferredDepth_m * kMaxInferredDepth_m;
}

int class_distance(int a, int b) {
    const int d = a > b ? a - b : b - a;
    return d > 4 ? 8 - d : d;
}

/// Lower is better: the residual, and what speaks against the class or, where none is given, against the heading.
double rank_px(const BoxInferenceInput& in, const BoxHypothesis& h) {
    const int wanted = in.viewpoint.horizontal;
    const double residual_px = h.residual_px < kConsistent_px ? 0.0 : h.residual_px;  // no order by rounding
    if (wanted >= 0) {
        return residual_px +
               kClassStep_px * (h.viewpoint.horizontal < 0 ? 4 : class_distance(h.viewpoint.horizontal, wanted));
    }
    const Vec3 axis_l = in.R_c_l.transpose().col(2);
    const double level = std::sqrt(axis_l(0) * axis_l(0) + axis_l(1) * axis_l(1));
    const SinCos t = sin_cos(h.theta);
    const double along = level > 0.0 ? std::fabs(axis_l(0) * t.cos + axis_l(1) * t.sin) / level : 0.0;
    return residual_px + kAcross_px * (1.0 - along);
}

bool evaluate(const BoxInferenceInput& in, const EdgePlanes& planes, double theta, BoxHypothesis& out) {
    Vec3 p_c;
    if (!position_at(planes, theta, p_c) || !in_range(p_c)) {
        return false;
    }
    const Pose T_c_o{in.R_c_l * rot_z(theta), p_c};
    const double residual = reprojection_px(in, planes.mask, T_c_o);
    if (residual < 0.0) {
        return false;
    }
    out.p_c = p_c;
    out.theta = theta;
    out.edges = planes.mask;
    out.residual_px = residual;
    out.viewpoint = visible_faces(T_c_o, in.size_m);
    out.rank_px = rank_px(in, out);
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

/// Angles to try: the roots of the closed form, or the one that is known. Returns how many.
int headings(const BoxInferenceInput& in, const EdgePlanes& planes, int horizontal, double thetas[2]) {
    if (in.has_theta) {
        thetas[0] = in.theta;
        return 1;
    }
    if (planes.count == kBoxEdges) {
        return heading_roots(planes, thetas) ? 2 : 0;
    }
    thetas[0] = heading_of_class(in, horizontal);
    return 1;
}

/// Which end of a vertical edge of the box reaches farthest out: all points but the vertex lie on the inner side of the
/// edge's plane, so the slant of the box's vertical against that plane decides. A level camera sees no slant.
std::int8_t outer_end(const EdgePlane& plane, const Vec3& up_c, int edge) {
    const double slant = plane.a.dot(up_c);
    const bool upper = edge == kLeft || edge == kTop ? slant <= 0.0 : slant >= 0.0;
    return static_cast<std::int8_t>(upper ? 1 : -1);
}

std::int8_t flipped(std::int8_t sign, int flip) {
    return static_cast<std::int8_t>(flip != 0 ? -sign : sign);
}

/// Solves for one root with these corners. false: no pose in front of the camera.
bool solve_corners(const BoxInferenceInput& in, unsigned valid, const EdgeVertices& vertices, int horizontal, int root,
                   BoxHypothesis& out) {
    const EdgePlanes planes = edge_planes(in.camera, in.R_c_l, in.box, valid, vertices, in.size_m);
    double thetas[2] = {0.0, 0.0};
    return root < headings(in, planes, horizontal, thetas) && evaluate(in, planes, thetas[root], out);
}

bool same_pose(const BoxHypothesis& a, const BoxHypothesis& b) {
    const double turn = wrap_angle(a.theta - b.theta);
    const Vec3 d = a.p_c - b.p_c;
    return std::fabs(turn) < kSamePose_rad && d.dot(d) < kSamePoseShare * kSamePoseShare * a.p_c.dot(a.p_c);
}

/// Lower first; equals in the order in which they came. The worst one gives way when the list is full.
void insert_ranked(BoxHypotheses& out, const BoxHypothesis& h) {
    for (BoxHypothesis& other : out) {
        if (same_pose(other, h)) {
            return;
        }
    }
    if (out.size() == kMaxBoxHypotheses) {
        if (!(h.rank_px < out[out.size() - 1].rank_px)) {
            return;
        }
        out.truncate(out.size() - 1);
    }
    (void)out.try_push_back(h);
    for (int k = out.size() - 1; k > 0 && out[k - 1].rank_px > h.rank_px; --k) {
        out[k] = out[k - 1];
        out[k - 1] = h;
    }
}

double misfit_of_class(const BoxHypothesis& h, int horizontal) {
    return h.residual_px +
           kClassStep_px * (h.viewpoint.horizontal < 0 ? 4 : class_distance(h.viewpoint.horizontal, horizontal));
}

/// From the table's corners to those that the solution itself has, and again: the pose that fits best on the way.
bool follow_table(const BoxInferenceInput& in, unsigned valid, const Viewpoint& view, BoxHypothesis& best) {
    bool found = false;
    EdgeVertices vertices = edge_vertices(view);
    for (int pass = 0; pass < kPasses; ++pass) {
        BoxHypothesis local;
        bool any = false;
        for (int root = 0; root < 2; ++root) {
            BoxHypothesis h;
            if (solve_corners(in, valid, vertices, view.horizontal, root, h) &&
                (!any || misfit_of_class(h, view.horizontal) < misfit_of_class(local, view.horizontal))) {
                local = h;
                any = true;
            }
        }
        if (any && (!found || misfit_of_class(local, view.horizontal) < misfit_of_class(best, view.horizontal))) {
            best = local;
            found = true;
        }
        if (!any || extreme_vertices(in.camera, {in.R_c_l * rot_z(local.theta), local.p_c}, in.size_m, vertices) !=
                        Status::kOk) {
            break;
        }
    }
    return found;
}

bool is_exact(const BoxHypothesis& h, const Viewpoint& view) {
    return h.viewpoint.horizontal == view.horizontal && h.residual_px < kConsistent_px &&
           (view.vertical < 0 || h.viewpoint.vertical == view.vertical);
}

/// The class fixes the corners of the left and right edge; those of the top and bottom edge are tried, four times
/// four, because off the optical axis they are others than the table's (docs/viewpoints.md). Every pose whose own
/// corners are the ones assumed is exact and goes into the list. Without any (the size is a prior, edges are noisy) the
/// pose that the table leads to is better than the best of odd corners.
void solve_class(const BoxInferenceInput& in, unsigned valid, const Viewpoint& view, bool given, BoxHypotheses& out) {
    BoxHypothesis best;
    const bool found = follow_table(in, valid, view, best);
    bool exact = found && is_exact(best, view);
    if (exact) {
        insert_ranked(out, best);
    }
    EdgeVertices vertices = edge_vertices(view);
    const EdgePlanes planes = edge_planes(in.camera, in.R_c_l, in.box, valid, vertices, in.size_m);
    for (int e = 0; e < kBoxEdges; ++e) {
        vertices[static_cast<std::size_t>(e)].z = outer_end(planes.edge[e], in.R_c_l.col(2), e);
    }
    const EdgeVertices table = vertices;
    for (int k = 0; k < 32; ++k) {  // the table's own corners come first
        vertices[kTop].x = flipped(table[kTop].x, k & 2);
        vertices[kTop].y = flipped(table[kTop].y, k & 4);
        vertices[kBottom].x = flipped(table[kBottom].x, k & 8);
        vertices[kBottom].y = flipped(table[kBottom].y, k & 16);
        BoxHypothesis h;
        if (solve_corners(in, valid, vertices, view.horizontal, k & 1, h) && is_exact(h, view)) {
            insert_ranked(out, h);
            exact = true;
        }
    }
    if (exact || !found) {
        return;
    }
    const double width = in.box.right - in.box.left;
    const double height = in.box.bottom - in.box.top;
    const double misfit_px = given ? kMaxMisfit * (width > height ? width : height) : kGoodFit_px;
    if (best.residual_px < misfit_px && (given || best.viewpoint.horizontal == view.horizontal)) {
        insert_ranked(out, best);
    }
}

Status infer_upright(const BoxInferenceInput& in, BoxHypotheses& out) {
    // Depth from the height, sideways from the middle of the box, or from one edge and half the width where the other
    // one is the border's. A pedestrian has no theta.
    const unsigned valid = valid_edges(in.box, in.width, in.height);
    constexpr unsigned kHeightEdges = (1U << kTop) | (1U << kBottom);
    const bool left = (valid & (1U << kLeft)) != 0U;
    const bool right = (valid & (1U << kRight)) != 0U;
    if ((valid & kHeightEdges) != kHeightEdges || (!left && !right)) {
        return Status::kNotObservable;
    }
    const double half_width = 0.25 * (in.size_m(0) + in.size_m(1));
    const double u_px = left && right ? 0.5 * (in.box.left + in.box.right) : left ? in.box.left : in.box.right;
    const Vec3 up_c = in.R_c_l.col(2);
    const double half = 0.5 * in.size_m(2);
    const Vec3 planes[3] = {{1.0, 0.0, -(u_px - in.camera.cx) / in.camera.fx},
                            {0.0, 1.0, -(in.box.top - in.camera.cy) / in.camera.fy},
                            {0.0, 1.0, -(in.box.bottom - in.camera.cy) / in.camera.fy}};
    const double sideways = left && right ? 0.0 : left ? -half_width : half_width;
    const Vec3 vertex_c[3] = {Vec3(sideways, 0.0, 0.0), half * up_c, -half * up_c};
    Mat3 A;
    Vec3 b;
    for (int r = 0; r < 3; ++r) {
        A.row(r) = planes[r].transpose();
        b(r) = -planes[r].dot(vertex_c[r]);
    }
    BoxHypothesis h;
    h.p_c = A.inverse() * b;
    h.edges = valid;
    if (!std::isfinite(h.p_c(0) + h.p_c(1) + h.p_c(2)) || !in_range(h.p_c)) {
        return Status::kNotObservable;
    }
    (void)out.try_push_back(h);
    return Status::kOk;
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
    const unsigned valid = valid_edges(input.box, input.width, input.height);
    const bool given = input.viewpoint.horizontal >= 0 && input.viewpoint.horizontal < 8;
    for (int h = 0; h < 8; ++h) {
        if (given && h != input.viewpoint.horizontal) {
            continue;
        }
        const Viewpoint view{static_cast<std::int8_t>(h), input.viewpoint.vertical};
        solve_class(input, valid, view, given, out);
    }
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
