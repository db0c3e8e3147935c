#include "sil/world/raycast.hpp"

#include <cmath>

#include "sil/world/material.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

namespace {

constexpr double kNear_m = 0.15;
constexpr double kMinInverse = 1.0 / kFar_m;

// Bound of rows and columns from the outline; everything if a part is beside or behind the camera.
void set_bounds(const View& view, const Piece& piece, Target& target) {
    target.row0 = 0;
    target.row1 = view.height - 1;
    target.u0 = -0.5;
    target.u1 = view.width - 0.5;
    const Pose T_c_n = view.T_n_c.inverse();
    double u0 = 1e9;
    double u1 = -1e9;
    double v0 = 1e9;
    double v1 = -1e9;
    bool behind = false;
    bool before = false;
    for (const Vec3& vertex : piece.vertices) {
        const Vec3 x = T_c_n * vertex;
        if (x(2) < kNear_m) {
            behind = true;
            continue;
        }
        before = true;
        const double u = view.cx + view.fx * x(0) / x(2);
        const double v = view.row_cy + x(1) / x(2) / view.row_scale;
        u0 = u < u0 ? u : u0;
        u1 = u > u1 ? u : u1;
        v0 = v < v0 ? v : v0;
        v1 = v > v1 ? v : v1;
    }
    if (!before) {
        target.row1 = -1;
        return;
    }
    if (behind) {
        return;
    }
    const auto clamp = [](double x, double lo, double hi) { return x < lo ? lo : (x > hi ? hi : x); };
    if (u1 < -1.0 || u0 > view.width || v1 < -1.0 || v0 > view.height) {
        target.row1 = -1;
        return;
    }
    target.row0 = static_cast<int>(clamp(std::floor(v0 - 0.5), 0.0, view.height - 1.0));
    target.row1 = static_cast<int>(clamp(std::ceil(v1 + 0.5), 0.0, view.height - 1.0));
    target.u0 = clamp(u0 - 0.5, -0.5, view.width - 0.5);
    target.u1 = clamp(u1 + 0.5, -0.5, view.width - 0.5);
}

Linear linear_of(const View& view, const Vec3& direction_n) {
    const Vec3 d = view.T_n_c.R.transpose() * direction_n;
    return {d(0), d(1), d(2)};
}

void prepare_face(const View& view, const Face& face, int owner, std::vector<Shade>& shades, Target& target) {
    double distance = face.d - face.n.dot(view.T_n_c.t);
    const bool front = distance < -1e-6;
    if (!front && distance < 1e-6) {
        distance = 1e-6;
    }
    Linear q = linear_of(view, face.n);
    q = {q.a / distance, q.b / distance, q.c / distance};
    if (!front) {
        target.backs.push_back(q);
        return;
    }
    Shade shade;
    shade.surface = face.surface;
    shade.s = linear_of(view, face.s_axis);
    shade.t = linear_of(view, face.t_axis);
    shade.s0 = face.s0 + face.s_axis.dot(view.T_n_c.t);
    shade.t0 = face.t0 + face.t_axis.dot(view.T_n_c.t);
    shade.q = q;
    const double direct = face.n.dot(sun_direction());
    shade.direct = direct > 0.0 ? static_cast<float>(direct) : 0.0F;
    shade.skylight = static_cast<float>(0.75 - 0.25 * face.n(1));
    shade.ground = (face.surface.material == Material::kAsphalt || face.surface.material == Material::kPaving ||
                    face.surface.material == Material::kLeaves) &&
                   face.n(1) < -0.9 && owner < 0;
    shade.owner = owner;
    target.fronts.push_back({q, static_cast<std::uint32_t>(shades.size())});
    shades.push_back(shade);
}

// Narrows [lo, hi] to where m u + k > 0.
void narrow(double m, double k, double& lo, double& hi) {
    if (m > 0.0) {
        const double u = -k / m;
        lo = u > lo ? u : lo;
    } else if (m < 0.0) {
        const double u = -k / m;
        hi = u < hi ? u : hi;
    } else if (k <= 0.0) {
        hi = lo - 1.0;
    }
}

struct RowLine {
    double m;  ///< q = m column + k
    double k;
};

RowLine on_row(const View& view, const Linear& q, double du, double ray_y) {
    return {q.a / view.fx, q.a * (du - view.cx) / view.fx + q.b * ray_y + q.c};
}

constexpr int kChunk = 64;

// Columns x0 .. x0 + count - 1 of a convex piece: the nearest of its front faces' planes, where nothing nearer stands.
// Loops without branches, face by face, so that the compiler uses vectors.
void draw_chunk(const Target& target, const RowLine* front, std::size_t n, int x0, int count, float* q,
                std::uint32_t* id) {
    std::array<float, kChunk> best;
    std::array<std::uint32_t, kChunk> face;
    for (std::size_t i = 0; i < n; ++i) {
        const float k = static_cast<float>(front[i].k);
        const float m = static_cast<float>(front[i].m);
        const std::uint32_t own = target.fronts[i].id;
        for (int x = 0; x < count; ++x) {
            const std::size_t at = static_cast<std::size_t>(x);
            const float here = k + m * static_cast<float>(x0 + x);
            const bool nearer = i == 0 || here < best[at];
            best[at] = nearer ? here : best[at];
            face[at] = nearer ? own : face[at];
        }
    }
    for (int x = 0; x < count; ++x) {
        const std::size_t at = static_cast<std::size_t>(x);
        const float before = q[x];
        const std::uint32_t visible = best[at] > before ? ~0U : 0U;
        q[x] = best[at] > before ? best[at] : before;
        id[x] = (face[at] & visible) | (id[x] & ~visible);
    }
}

void trace_faces(const View& view, const Target& target, double du, double ray_y, float* q, std::uint32_t* id,
                 Span& span) {
    std::array<RowLine, 32> front;
    const std::size_t n = target.fronts.size() < front.size() ? target.fronts.size() : front.size();
    double lo = target.u0 - du;
    double hi = target.u1 - du;
    lo = lo < 0.0 ? 0.0 : lo;
    hi = hi > view.width - 1.0 ? view.width - 1.0 : hi;
    for (std::size_t i = 0; i < n; ++i) {
        front[i] = on_row(view, target.fronts[i].q, du, ray_y);
        narrow(front[i].m, front[i].k - kMinInverse, lo, hi);
    }
    for (const Linear& b : target.backs) {
        const RowLine back = on_row(view, b, du, ray_y);
        for (std::size_t i = 0; i < n; ++i) {
            narrow(front[i].m - back.m, front[i].k - back.k, lo, hi);
        }
    }
    if (!(lo <= hi)) {
        return;
    }  // also keeps the bounds in int's range: they start inside the image and only narrow
    const int first = static_cast<int>(std::ceil(lo));
    const int last = static_cast<int>(std::floor(hi));
    if (first > last) {
        return;
    }
    span.add(first, last);
    for (int x = first; x <= last; x += kChunk) {
        draw_chunk(target, front.data(), n, x, last - x + 1 < kChunk ? last - x + 1 : kChunk, q + x, id + x);
    }
}

// Rays against the unit sphere; leaves may have holes.
void trace_ellipsoid(const View& view, const Target& target, double du, double ray_y, float* q, std::uint32_t* id,
                     Span& span) {
    const Piece& piece = *target.ellipsoid;
    const double c = target.origin.dot(target.origin) - 1.0;
    const int first = static_cast<int>(std::ceil(target.u0 - du < 0.0 ? 0.0 : target.u0 - du));
    const int limit =
        static_cast<int>(std::floor(target.u1 - du > view.width - 1.0 ? view.width - 1.0 : target.u1 - du));
    // The ray d = d0 + x d1 of column x: its products are polynomials of x.
    const Vec3 d0 = target.to_sphere * Vec3(view.ray_x(du), ray_y, 1.0);
    const Vec3 d1 = target.to_sphere.col(0) / view.fx;
    const double a0 = d0.dot(d0);
    const double a1 = 2.0 * d0.dot(d1);
    const double a2 = d1.dot(d1);
    const double b0 = target.origin.dot(d0);
    const double b1 = target.origin.dot(d1);
    for (int x = first; x <= limit; ++x) {
        const double column = x;
        const double a = a0 + column * (a1 + column * a2);
        const double b = b0 + column * b1;
        const double disc = b * b - a * c;
        if (disc <= 0.0 || b >= 0.0) {
            continue;
        }
        const double depth = (-b - std::sqrt(disc)) / a;
        const float inverse = static_cast<float>(1.0 / depth);
        if (depth < kNear_m || inverse <= q[x]) {
            continue;
        }
        if (piece.ragged) {
            const Vec3 on = target.origin + depth * (d0 + column * d1);  // unit vector: also the normal
            const double facing = std::sqrt(disc) / std::sqrt(a);
            const Vec3 metres = on.cwiseProduct(piece.radii);
            if (!leaf_at(piece.skin, static_cast<float>(metres(0)), static_cast<float>(metres(1)),
                         static_cast<float>(metres(2)), static_cast<float>(depth / view.fx),
                         static_cast<float>(1.0 - facing))) {
                continue;
            }
        }
        q[x] = inverse;
        id[x] = target.id;
        span.add(x, x);
    }
}

}  // namespace

SampleGrid sample_grid(int samples) {
    constexpr std::array<int, 4> kFour{1, 3, 0, 2};
    constexpr std::array<int, 8> kEight{2, 6, 0, 4, 7, 3, 5, 1};
    SampleGrid grid;
    for (int k = 0; k < samples; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const int column = samples == 8 ? kEight[i] : kFour[i];
        grid.du[i] = (static_cast<double>(column) + 0.5) / static_cast<double>(samples) - 0.5;
        grid.dv[i] = (static_cast<double>(k) + 0.5) / static_cast<double>(samples) - 0.5;
    }
    return grid;
}

Target prepare(const View& view, const Piece& piece, int owner, std::vector<Shade>& shades) {
    Target target;
    set_bounds(view, piece, target);
    if (target.row1 < target.row0) {
        return target;
    }
    if (!piece.is_ellipsoid()) {
        for (const Face& f : piece.faces) {
            prepare_face(view, f, owner, shades, target);
        }
        if (target.fronts.empty()) {
            target.row1 = -1;
        }
        return target;
    }
    target.ellipsoid = &piece;
    const Mat3 inverse_radii = piece.radii.cwiseInverse().asDiagonal();
    target.origin = inverse_radii * (piece.R.transpose() * (view.T_n_c.t - piece.centre));
    target.to_sphere = inverse_radii * (piece.R.transpose() * view.T_n_c.R);
    if (target.origin.dot(target.origin) <= 1.0) {
        target.row1 = -1;
    }
    target.id = static_cast<std::uint32_t>(shades.size());
    Shade shade;
    shade.surface = piece.skin;
    shade.owner = owner;
    shade.ellipsoid = &piece;
    shades.push_back(shade);
    return target;
}

void RowSamples::resize(int w, int samples) {
    width = w;
    for (int k = 0; k < samples; ++k) {
        q[static_cast<std::size_t>(k)].assign(static_cast<std::size_t>(w), 0.0F);
        id[static_cast<std::size_t>(k)].assign(static_cast<std::size_t>(w), 0U);
    }
}

void RowSamples::clear(int samples) {
    resize(width, samples);
}

Span trace_row(const View& view, const SampleGrid& grid, const Target& target, int row, RowSamples& out) {
    Span span;
    for (int k = 0; k < view.samples; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const double ray_y = view.ray_y(static_cast<double>(row) + grid.dv[i]);
        if (target.ellipsoid != nullptr) {
            trace_ellipsoid(view, target, grid.du[i], ray_y, out.q[i].data(), out.id[i].data(), span);
        } else {
            trace_faces(view, target, grid.du[i], ray_y, out.q[i].data(), out.id[i].data(), span);
        }
    }
    return span;
}

}  // namespace semtrack::sil::world
