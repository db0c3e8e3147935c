#include "sil/world/model_street.hpp"

#include "math/trig.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

double between(std::uint32_t seed, std::uint32_t what, double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(unit(hash(seed, what)));
}

// Everything along the street: M with x along +z of N, y to the left, at the road's height there.
struct Builder {
    const Street& street;
    double z0;
    double z1;
    StreetModel out{};

    void place(const Pieces& pieces, double x, double z, double heading, double above = 0.0) {
        const Pose pose = model_pose(x, -road_height(street, z) - above, z, heading);
        for (const Piece& p : pieces) {
            out.pieces.push_back(transformed(p, pose));
        }
    }
};

// Borders of the pieces of a strip: knots of the height profile between z0 and z1.
std::vector<double> strip_ends(const Street& street, double z0, double z1) {
    std::vector<double> ends{z0};
    for (const HeightKnot& k : street.profile) {
        if (k.z > z0 && k.z < z1) {
            ends.push_back(k.z);
        }
    }
    ends.push_back(z1);
    return ends;
}

// A strip of ground from x0 to x1 (N), `above` the road, with vertical sides of depth `depth`.
void add_strip(Builder& b, double x0, double x1, double z0, double z1, double above, double depth, const Surface& top) {
    const std::vector<double> ends = strip_ends(b.street, z0, z1);
    for (std::size_t k = 1; k < ends.size(); ++k) {
        const double h0 = road_height(b.street, ends[k - 1]) + above;
        const double h1 = road_height(b.street, ends[k]) + above;
        Prism p;
        p.profile = {{ends[k - 1], h0 - depth}, {ends[k], h1 - depth}, {ends[k], h1}, {ends[k - 1], h0}};
        p.origin = Vec3(0, -0.5 * (x0 + x1), 0);
        p.half_low = p.half_high = 0.5 * (x1 - x0);
        b.out.pieces.push_back(transformed(make_prism(p, top), model_pose(0, 0, 0, 0.0)));
    }
}

// Runs f(from, to) for the parts of [z0, z1] outside the gaps.
template <class F>
void outside_gaps(const std::vector<Gap>& gaps, double z0, double z1, F f) {
    double z = z0;
    for (const Gap& g : gaps) {
        if (g.to_z <= z || g.from_z >= z1) {
            continue;
        }
        if (g.from_z > z) {
            f(z, g.from_z);
        }
        z = g.to_z;
    }
    if (z < z1) {
        f(z, z1);
    }
}

void add_road(Builder& b) {
    const Street& s = b.street;
    Surface asphalt{Material::kAsphalt, 0.37F, s.seed, {}};
    asphalt.p = {static_cast<float>(s.lane_width), static_cast<float>(s.lanes_left), static_cast<float>(kerb_right(s)),
                 static_cast<float>(-kerb_left(s))};
    add_strip(b, -120.0, 120.0, b.z0 - 20.0, b.z1 + 150.0, 0.0, 1.0, asphalt);
    for (const bool right : {true, false}) {
        const double kerb = right ? kerb_right(s) : kerb_left(s);
        const double side = right ? 1.0 : -1.0;
        Surface paving{Material::kPaving, 0.52F, s.seed + (right ? 1U : 2U), {}};
        paving.p = {static_cast<float>(-kerb), 0.0F, 0.0F, 0.0F};
        const Surface grass{Material::kLeaves, 0.22F, s.seed + (right ? 3U : 4U), {}};
        outside_gaps(right ? s.gaps_right : s.gaps_left, b.z0, b.z1, [&](double from, double to) {
            const double edge = kerb + side * s.pavement;
            const double wall = edge + side * (s.garden + 1.0);
            add_strip(b, right ? kerb : edge, right ? edge : kerb, from, to, 0.12, 0.3, paving);
            add_strip(b, right ? edge : wall, right ? wall : edge, from, to, 0.13, 0.3, grass);
        });
    }
}

void add_garden(Builder& b, bool right, double from, double to, std::uint32_t h) {
    const double side = right ? 1.0 : -1.0;
    const double x = (right ? kerb_right(b.street) : kerb_left(b.street)) + side * (b.street.pavement + 0.25);
    const std::uint32_t kind = h % 4U;
    if (b.street.garden < 0.8 || kind == 0U) {
        return;
    }
    const double tall = between(h, 5U, 0.8, 1.35);
    const Surface surface =
        kind == 3U ? Surface{Material::kBrick, 0.45F, h, {}} : Surface{Material::kLeaves, 0.24F, h, {}};
    const double open = between(h, 6U, 0.25, 0.7) * (to - from);
    Pieces hedge;
    hedge.push_back(make_box(Vec3(0.2, -0.28, 0.0), Vec3(open, 0.28, tall), surface));
    if (to - from - open > 2.5) {
        hedge.push_back(make_box(Vec3(open + 1.4, -0.28, 0.0), Vec3(to - from - 0.2, 0.28, tall), surface));
    }
    b.place(hedge, x, from, 0.0, 0.12);
}

void add_houses(Builder& b, bool right) {
    const Street& s = b.street;
    const double side = right ? 1.0 : -1.0;
    const double front = (right ? kerb_right(s) : kerb_left(s)) + side * (s.pavement + s.garden);
    std::uint32_t k = right ? 1000U : 2000U;
    outside_gaps(right ? s.gaps_right : s.gaps_left, b.z0, b.z1, [&](double from, double to) {
        double z = from;
        while (z < to - 3.0) {
            const std::uint32_t h = hash(s.seed, k++);
            double length = between(h, 1U, 8.0, 13.5);
            if (to - z - length < 5.0) {
                length = to - z;
            }
            const double eaves = between(h, 2U, 3.9, 7.6);
            const double ridge = eaves + between(h, 3U, 2.2, 4.2);
            const double back = between(h, 4U, 0.0, 0.9);
            const double x = front + side * back;
            // A house of the left side is the right one turned by 180 degrees.
            b.place(make_house(length, 9.0, eaves, ridge, h), x, right ? z : z + length, right ? 0.0 : kPi);
            b.out.houses.push_back({static_cast<float>(z), static_cast<float>(z + length), static_cast<float>(x),
                                    static_cast<float>(eaves)});
            add_garden(b, right, z, z + length, h);
            const double yard = h % 5U == 0U ? between(h, 7U, 1.5, 3.5) : 0.0;
            z += length + yard;
        }
    });
}

void add_tree(Builder& b, double x, double z, double height, double radius, std::uint32_t seed) {
    b.place(make_tree(height, radius, seed), x, z, between(seed, 9U, 0.0, kTwoPi));
    ShadowBlock crown;
    crown.x = static_cast<float>(x);
    crown.z = static_cast<float>(z);
    crown.half_length = crown.half_width = static_cast<float>(radius);
    crown.height = static_cast<float>(height - radius);
    crown.crown = true;
    b.out.crowns.push_back(crown);
}

bool is_in_gap(const std::vector<Gap>& gaps, double z) {
    for (const Gap& g : gaps) {
        if (z > g.from_z - 1.5 && z < g.to_z + 1.5) {
            return true;
        }
    }
    return false;
}

void add_furniture(Builder& b, bool right) {
    const Street& s = b.street;
    const double side = right ? 1.0 : -1.0;
    const double kerb = right ? kerb_right(s) : kerb_left(s);
    const std::vector<Gap>& gaps = right ? s.gaps_right : s.gaps_left;
    std::uint32_t k = right ? 3000U : 4000U;
    for (double z = b.z0 + (right ? 3.0 : 9.0); z < b.z1 && s.tree_spacing > 0.0; z += s.tree_spacing) {
        const std::uint32_t h = hash(s.seed, k++);
        const double at = z + between(h, 1U, -3.0, 3.0);
        if (is_in_gap(gaps, at) || h % 3U == 0U) {
            continue;
        }
        add_tree(b, kerb + side * 0.8, at, between(h, 2U, 4.6, 7.5), between(h, 3U, 1.2, 1.9), h);
    }
    for (double z = b.z0 + (right ? 11.0 : 24.0); z < b.z1; z += 27.0) {
        const std::uint32_t h = hash(s.seed, k++);
        if (is_in_gap(gaps, z)) {
            continue;
        }
        b.place(make_lamp(6.0, 1.3), kerb + side * 0.35, z, right ? 0.0 : kPi, 0.12);
        if (!is_in_gap(gaps, z + 9.0)) {
            b.place(make_traffic_sign(h), kerb + side * 0.5, z + 9.0, h % 2U == 0U ? 0.0 : kPi, 0.12);
        }
    }
}

// Houses across the street's end and in the side streets, trees in front of them.
void add_ends(Builder& b) {
    const Street& s = b.street;
    for (int k = -3; k <= 2; ++k) {
        const std::uint32_t h = hash(s.seed, 5000U + static_cast<std::uint32_t>(k + 8));
        b.place(make_house(12.0, 9.0, between(h, 1U, 5.0, 9.0), between(h, 2U, 9.5, 13.0), h), 12.0 * k, b.z1 + 25.0,
                -0.5 * kPi);
        add_tree(b, 11.0 * k + 3.0, b.z1 + 15.0, between(h, 3U, 7.0, 12.0), between(h, 4U, 2.0, 3.4), h);
    }
    // Woods behind the houses: no view of the horizon between them.
    for (const double x : {-75.0, 75.0}) {
        const Surface woods{Material::kLeaves, 0.2F, s.seed + 6U, {}};
        add_strip(b, x - 4.0, x + 4.0, b.z0, b.z1 + 40.0, 7.0, 8.0, woods);
    }
    for (const bool right : {true, false}) {
        for (const Gap& g : right ? s.gaps_right : s.gaps_left) {
            const std::uint32_t h = hash(s.seed, static_cast<std::uint32_t>(g.from_z + 500.0));
            const double side = right ? 1.0 : -1.0;
            b.place(make_house(30.0, 9.0, 6.5, 10.0, h), side * 45.0, right ? g.from_z - 10.0 : g.from_z + 20.0,
                    right ? 0.0 : kPi);
            add_tree(b, side * 30.0, g.from_z + 1.0, 8.0, 2.6, h + 1U);
            add_tree(b, side * 33.0, g.to_z + 1.0, 9.0, 2.8, h + 2U);
        }
    }
}

}  // namespace

Pieces make_house(double length, double depth, double eaves, double ridge, std::uint32_t seed) {
    constexpr std::array<float, 6> kTones{0.78F, 0.62F, 0.50F, 0.70F, 0.36F, 0.85F};
    const float tone = kTones[hash(seed, 31U) % kTones.size()];
    const bool brick = hash(seed, 32U) % 5U == 0U;
    Surface wall{Material::kFacade, tone, seed, {}};
    wall.p = {static_cast<float>(length), static_cast<float>(eaves), static_cast<float>(between(seed, 33U, 2.3, 3.4)),
              brick ? 1.0F : 0.0F};
    Pieces out;
    out.push_back(make_box(Vec3(0, -depth, 0), Vec3(length, 0, eaves), wall));
    Prism roof;
    roof.a = Vec3::UnitY();
    roof.b = Vec3::UnitZ();
    roof.c = Vec3::UnitX();
    roof.profile = {{-depth - 0.4, eaves - 0.1},
                    {0.4, eaves - 0.1},
                    {0.4, eaves + 0.08},
                    {-0.5 * depth, ridge},
                    {-depth - 0.4, eaves + 0.08}};
    roof.origin = Vec3(0.5 * length, 0, 0);
    roof.half_low = roof.half_high = 0.5 * length + 0.15;
    out.push_back(make_prism(roof, Surface{Material::kRoof, 0.26F + 0.1F * unit(hash(seed, 34U)), seed, {}}));
    const double cx = between(seed, 35U, 0.2, 0.8) * length;
    out.push_back(make_box(Vec3(cx - 0.4, -0.45 * depth, eaves), Vec3(cx + 0.4, -0.45 * depth + 0.6, ridge + 0.9),
                           Surface{Material::kBrick, 0.4F, seed, {}}));
    out.push_back(
        make_rod(Vec3(0.15, 0.06, 0.0), Vec3(0.15, 0.06, eaves), 0.055, 6, Surface{Material::kPlain, 0.18F, seed, {}}));
    if (hash(seed, 36U) % 2U == 0U && length > 9.0) {  // dormer
        const double dx = between(seed, 37U, 0.25, 0.6) * length;
        Surface face = wall;
        face.p = {1.8F, 1.5F, 1.8F, 2.0F};
        Pieces dormer;
        dormer.push_back(make_box(Vec3(0.0, -3.2, 0.0), Vec3(1.8, -0.7, 1.5), face));
        dormer.push_back(
            make_box(Vec3(-0.15, -3.3, 1.5), Vec3(1.95, -0.5, 1.65), Surface{Material::kRoof, 0.2F, seed, {}}));
        const Pose up{Mat3::Identity(), Vec3(dx, 0, eaves + 0.35)};
        for (const Piece& p : dormer) {
            out.push_back(transformed(p, up));
        }
    }
    return out;
}

Pieces make_tree(double height, double crown, std::uint32_t seed) {
    Pieces out;
    out.push_back(make_rod(Vec3(0, 0, 0), Vec3(0.05, 0.05, height - crown), 0.09 + 0.02 * crown, 8,
                           Surface{Material::kBark, 0.25F, seed, {}}));
    for (std::uint32_t k = 0; k < 7U; ++k) {
        const SinCos around = sin_cos(kTwoPi * (static_cast<double>(k) / 6.0 + between(seed, 40U + k, 0.0, 0.2)));
        const double r = k == 6U ? 0.0 : 0.58 * crown;
        const double up = k == 6U ? height - 0.7 * crown : height - crown * between(seed, 50U + k, 0.9, 1.8);
        const double size = crown * between(seed, 60U + k, 0.45, 0.75);
        Piece blob = make_ellipsoid(Vec3(r * around.cos, r * around.sin, up), Vec3(size, size, 0.85 * size),
                                    Surface{Material::kLeaves, 0.24F, seed + k, {}});
        blob.ragged = true;
        out.push_back(blob);
    }
    return out;
}

Pieces make_lamp(double height, double arm) {
    const Surface metal{Material::kPlain, 0.33F, 77U, {}};
    Pieces out;
    out.push_back(make_rod(Vec3(0, 0, 0), Vec3(0, 0, height), 0.06, 8, metal));
    out.push_back(make_rod(Vec3(0, 0, height), Vec3(0, arm, height + 0.2), 0.035, 6, metal));
    out.push_back(make_box(Vec3(-0.15, arm - 0.1, height + 0.12), Vec3(0.15, arm + 0.5, height + 0.25),
                           Surface{Material::kPlain, 0.7F, 78U, {}}));
    return out;
}

Pieces make_traffic_sign(std::uint32_t seed) {
    Pieces out;
    out.push_back(make_rod(Vec3(0, 0, 0), Vec3(0, 0, 2.6), 0.03, 6, Surface{Material::kPlain, 0.45F, seed, {}}));
    out.push_back(
        make_rod(Vec3(-0.04, 0, 2.3), Vec3(-0.06, 0, 2.3), 0.3, 12, Surface{Material::kSign, 0.8F, seed, {}}));
    return out;
}

StreetModel make_street(const Street& street, double z0, double z1) {
    Builder b{street, z0, z1};
    add_road(b);
    add_houses(b, true);
    add_houses(b, false);
    add_furniture(b, true);
    add_furniture(b, false);
    add_ends(b);
    return std::move(b.out);
}

}  // namespace semtrack::sil::world
