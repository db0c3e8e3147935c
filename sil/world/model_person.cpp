// Pedestrians and cyclists.
#include <cmath>

#include "math/trig.hpp"
#include "sil/world/model_road_user.hpp"

namespace semtrack::sil::world {

namespace {

Surface cloth(float tone, std::uint32_t seed) {
    return {Material::kCloth, tone, seed, {}};
}

// Length, width and height of the outline of the pieces.
void outline(const Pieces& pieces, Vec3& lo, Vec3& hi) {
    lo = Vec3::Constant(1e9);
    hi = Vec3::Constant(-1e9);
    for (const Piece& p : pieces) {
        for (const Vec3& v : p.vertices) {
            lo = lo.cwiseMin(v);
            hi = hi.cwiseMax(v);
        }
    }
}

// Moves the person so that its outline stands on the ground in the middle of the box: gait changes the outline by
// centimetres, the box does not follow.
void settle(Pieces& pieces) {
    Vec3 lo;
    Vec3 hi;
    outline(pieces, lo, hi);
    const Pose shift{Mat3::Identity(), Vec3(-0.5 * (lo(0) + hi(0)), -0.5 * (lo(1) + hi(1)), -lo(2))};
    for (Piece& p : pieces) {
        p = transformed(p, shift);
    }
}

void add_wheel(double x, double radius, const Look& look, Pieces& out) {
    Surface s{Material::kWheel, 0.05F, look.seed, {}};
    s.p = {static_cast<float>(x), static_cast<float>(radius), static_cast<float>(radius), 1.0F};
    out.push_back(make_rod(Vec3(x, -0.025, radius), Vec3(x, 0.025, radius), radius, 16, s));
}

}  // namespace

Pieces make_pedestrian(const Vec3& size, const Look& look, double gait) {
    const double h = size(2);
    const double swing = sin_cos(kPi * gait).sin;
    const double stride = 0.5 * size(0) - 0.08;
    const double hip = 0.5 * h;
    const float trousers = look.tone > 0.35F ? 0.10F : 0.45F;
    Pieces out;
    for (const double side : {1.0, -1.0}) {
        const double foot = side * swing * stride;
        const double y = side * 0.05 * h;
        out.push_back(
            make_rod(Vec3(0.0, y, hip), Vec3(0.6 * foot, y, 0.26 * h), 0.048 * h, 8, cloth(trousers, look.seed)));
        out.push_back(make_rod(Vec3(0.6 * foot, y, 0.27 * h), Vec3(foot - 0.03, y, 0.04), 0.036 * h, 8,
                               cloth(trousers, look.seed)));
        out.push_back(make_box(Vec3(foot - 0.08, y - 0.045, 0.0), Vec3(foot + 0.12, y + 0.045, 0.07),
                               Surface{Material::kPlain, 0.06F, look.seed, {}}));
        const double hand = -side * swing * 0.6 * stride;
        const double shoulder = side * (0.5 * size(1) - 0.06);
        out.push_back(make_rod(Vec3(0.0, 0.85 * shoulder, 0.79 * h), Vec3(0.4 * hand, shoulder, 0.6 * h), 0.05, 8,
                               cloth(look.tone, look.seed + 1U)));
        out.push_back(make_rod(Vec3(0.4 * hand, shoulder, 0.61 * h), Vec3(hand + 0.05, shoulder, 0.46 * h), 0.04, 8,
                               cloth(look.tone, look.seed + 1U)));
    }
    Prism torso;
    torso.profile = {{-0.11, 0.47 * h}, {0.11, 0.47 * h},  {0.13, 0.70 * h},
                     {0.08, 0.83 * h},  {-0.08, 0.83 * h}, {-0.12, 0.72 * h}};
    torso.half_low = 0.5 * size(1) - 0.14;
    torso.half_high = 0.5 * size(1) - 0.11;
    torso.b_low = 0.47 * h;
    torso.b_high = 0.83 * h;
    out.push_back(make_prism(torso, cloth(look.tone, look.seed + 2U)));
    out.push_back(make_rod(Vec3(0, 0, 0.82 * h), Vec3(0.01, 0, 0.89 * h), 0.055, 8,
                           Surface{Material::kSkin, 0.5F, look.seed, {}}));
    out.push_back(make_ellipsoid(Vec3(0.02, 0, 0.93 * h), Vec3(0.10, 0.08, 0.07 * h),
                                 Surface{Material::kSkin, 0.5F, look.seed, {}}));
    out.push_back(make_ellipsoid(Vec3(-0.02, 0, 0.95 * h), Vec3(0.10, 0.088, 0.05 * h),
                                 Surface{Material::kCloth, 0.12F, look.seed + 5U, {}}));
    settle(out);
    return out;
}

Pieces make_cyclist(const Vec3& size, const Look& look, double gait) {
    const double h = size(2);
    const double r = 0.34;
    const double axle = 0.5 * size(0) - r;
    const Surface frame{Material::kPlain, 0.5F, look.seed + 9U, {}};
    const Vec3 crank(-0.05, 0, 0.30);
    const Vec3 saddle(-0.25, 0, 0.54 * h);
    const Vec3 bar(0.38, 0, 0.60 * h);
    Pieces out;
    add_wheel(axle, r, look, out);
    add_wheel(-axle, r, look, out);
    out.push_back(make_rod(Vec3(-axle, 0, r), crank, 0.02, 6, frame));
    out.push_back(make_rod(crank, saddle, 0.025, 6, frame));
    out.push_back(make_rod(crank, Vec3(0.34, 0, 0.5 * h), 0.03, 6, frame));
    out.push_back(make_rod(Vec3(-axle, 0, r), saddle, 0.015, 6, frame));
    out.push_back(make_rod(Vec3(axle, 0, r), bar, 0.025, 6, frame));
    out.push_back(make_rod(Vec3(bar(0), -0.5 * size(1), bar(2)), Vec3(bar(0), 0.5 * size(1), bar(2)), 0.02, 6, frame));
    out.push_back(make_box(saddle - Vec3(0.13, 0.08, 0.03), saddle + Vec3(0.13, 0.08, 0.03),
                           Surface{Material::kPlain, 0.05F, look.seed, {}}));
    const Vec3 hip = saddle + Vec3(0.02, 0, 0.08);
    const Vec3 neck(0.14, 0, 0.84 * h);
    for (const double side : {1.0, -1.0}) {
        const SinCos pedal = sin_cos(kTwoPi * gait + (side > 0.0 ? 0.0 : kPi));
        const Vec3 foot = crank + Vec3(0.16 * pedal.cos, side * 0.12, 0.16 * pedal.sin);
        const Vec3 knee = 0.5 * (hip + foot) + Vec3(0.2, side * 0.05, 0.06);
        const Vec3 side_y(0, side * 0.12, 0);
        out.push_back(make_rod(hip + side_y, knee, 0.075, 8, cloth(0.12F, look.seed)));
        out.push_back(make_rod(knee, foot, 0.055, 8, cloth(0.12F, look.seed)));
        out.push_back(make_box(foot + Vec3(-0.08, -0.045, -0.04), foot + Vec3(0.16, 0.045, 0.04),
                               Surface{Material::kPlain, 0.5F, look.seed, {}}));
        const Vec3 shoulder = neck + Vec3(-0.02, side * 0.17, -0.06);
        const Vec3 hand = bar + Vec3(0, side * (0.5 * size(1) - 0.06), 0.03);
        out.push_back(make_rod(shoulder, hand, 0.045, 8, cloth(look.tone, look.seed + 1U)));
    }
    Prism torso;  // leaning forward: its length axis runs from the hip to the neck
    const Vec3 axis = neck - hip;
    const double length = std::sqrt(axis.dot(axis));
    torso.b = axis / length;
    torso.a = Vec3(torso.b(2), 0, -torso.b(0));
    torso.origin = hip;
    torso.profile = {{-0.12, -0.05}, {0.12, -0.05},   {0.14, 0.7 * length},
                     {0.08, length}, {-0.09, length}, {-0.13, 0.7 * length}};
    torso.half_low = 0.15;
    torso.half_high = 0.19;
    torso.b_low = -0.05;
    torso.b_high = length;
    out.push_back(make_prism(torso, cloth(look.tone, look.seed + 2U)));
    out.push_back(make_ellipsoid(Vec3(0.24, 0, 0.925 * h), Vec3(0.10, 0.08, 0.12),
                                 Surface{Material::kSkin, 0.5F, look.seed, {}}));
    out.push_back(make_ellipsoid(Vec3(0.21, 0, h - 0.09), Vec3(0.14, 0.10, 0.09),
                                 Surface{Material::kCloth, 0.75F, look.seed + 5U, {}}));
    return out;
}

}  // namespace semtrack::sil::world
