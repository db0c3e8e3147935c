#include "sil/world/model_piece.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace semtrack::sil::world {

namespace {

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

// The two model axes along which a face with this normal extends.
void set_texture_axes(Face& face) {
    const Vec3 n = face.n.cwiseAbs();
    if (n(2) >= n(0) && n(2) >= n(1)) {
        face.s_axis = Vec3::UnitX();
        face.t_axis = Vec3::UnitY();
    } else if (n(1) >= n(0)) {
        face.s_axis = Vec3::UnitX();
        face.t_axis = Vec3::UnitZ();
    } else {
        face.s_axis = Vec3::UnitY();
        face.t_axis = Vec3::UnitZ();
    }
}

Face make_face(const Vec3& normal, const Vec3& point, const Surface& surface) {
    Face face;
    face.n = normal / std::sqrt(normal.dot(normal));
    face.d = face.n.dot(point);
    face.surface = surface;
    set_texture_axes(face);
    return face;
}

double half_width(const Prism& p, double b) {
    return p.half_low + (p.half_high - p.half_low) * (b - p.b_low) / (p.b_high - p.b_low);
}

Vec3 point_of(const Prism& p, const Vec2& ab, double c) {
    return p.origin + ab(0) * p.a + ab(1) * p.b + c * p.c;
}

}  // namespace

Piece make_prism(const Prism& prism, const Surface& surface) {
    Piece piece;
    const std::size_t n = prism.profile.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2& from = prism.profile[k];
        const Vec2 edge = prism.profile[(k + 1) % n] - from;
        const Vec3 normal = edge(1) * prism.a - edge(0) * prism.b;
        piece.faces.push_back(make_face(normal, point_of(prism, from, 0.0), surface));
        const double h = half_width(prism, from(1));
        piece.vertices.push_back(point_of(prism, from, h));
        piece.vertices.push_back(point_of(prism, from, -h));
    }
    const double slope = (prism.half_high - prism.half_low) / (prism.b_high - prism.b_low);
    piece.faces.push_back(make_face(prism.c - slope * prism.b, piece.vertices[0], surface));
    piece.faces.push_back(make_face(-prism.c - slope * prism.b, piece.vertices[1], surface));
    return piece;
}

Piece make_box(const Vec3& lo, const Vec3& hi, const Surface& surface) {
    Prism p;
    p.profile = {{lo(0), lo(2)}, {hi(0), lo(2)}, {hi(0), hi(2)}, {lo(0), hi(2)}};
    p.origin = Vec3(0, 0.5 * (lo(1) + hi(1)), 0);
    p.half_low = p.half_high = 0.5 * (hi(1) - lo(1));
    return make_prism(p, surface);
}

Piece make_rod(const Vec3& from, const Vec3& to, double radius, int n, const Surface& surface) {
    Prism p;
    const Vec3 axis = to - from;
    const double length = std::sqrt(axis.dot(axis));
    p.c = axis / length;
    const Vec3 helper = p.c(2) * p.c(2) > 0.5 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    p.a = helper - helper.dot(p.c) * p.c;
    p.a /= std::sqrt(p.a.dot(p.a));
    p.b = cross(p.c, p.a);
    p.origin = 0.5 * (from + to);
    p.half_low = p.half_high = 0.5 * length;
    for (int k = 0; k < n; ++k) {
        const SinCos sc = sin_cos(kTwoPi * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
        p.profile.push_back({radius * sc.cos, radius * sc.sin});
    }
    return make_prism(p, surface);
}

Piece make_ellipsoid(const Vec3& centre, const Vec3& radii, const Surface& surface) {
    Piece piece;
    piece.centre = centre;
    piece.radii = radii;
    piece.skin = surface;
    for (int k = 0; k < 8; ++k) {
        piece.vertices.push_back(centre + Vec3((k & 1) != 0 ? radii(0) : -radii(0), (k & 2) != 0 ? radii(1) : -radii(1),
                                               (k & 4) != 0 ? radii(2) : -radii(2)));
    }
    return piece;
}

Piece transformed(const Piece& piece, const Pose& T_a_b) {
    Piece out = piece;
    for (Vec3& v : out.vertices) {
        v = T_a_b * v;
    }
    for (Face& f : out.faces) {
        f.n = T_a_b.R * f.n;
        f.d += f.n.dot(T_a_b.t);
        f.s_axis = T_a_b.R * f.s_axis;
        f.t_axis = T_a_b.R * f.t_axis;
        f.s0 -= f.s_axis.dot(T_a_b.t);
        f.t0 -= f.t_axis.dot(T_a_b.t);
    }
    out.centre = T_a_b * piece.centre;
    out.R = T_a_b.R * piece.R;
    return out;
}

Pose model_pose(double x, double y, double z, double heading_rad, double pitch_rad) {
    const SinCos h = sin_cos(heading_rad);
    const SinCos p = sin_cos(pitch_rad);
    const Vec3 level(h.sin, 0, h.cos);
    const Vec3 up(0, -1, 0);
    Pose pose;
    pose.R.col(0) = p.cos * level + p.sin * up;
    pose.R.col(1) = Vec3(-h.cos, 0, h.sin);
    pose.R.col(2) = p.cos * up - p.sin * level;
    pose.t = Vec3(x, y, z);
    return pose;
}

}  // namespace semtrack::sil::world
