// Cars, vans, trucks, trams.
#include "sil/world/model_road_user.hpp"

namespace semtrack::sil::world {

namespace {

constexpr int kWheelFaces = 16;
constexpr double kInset_m = 0.015;

struct Chassis {
    double wheel_radius;
    double front_axle;  ///< x of the axles
    double rear_axle;
};

// Profile points in shares of length (-0.5..0.5) and height (0..1).
std::vector<Vec2> scaled(const std::vector<Vec2>& shares, const Vec3& size) {
    std::vector<Vec2> out;
    for (const Vec2& s : shares) {
        out.push_back({s(0) * size(0), s(1) * size(2)});
    }
    return out;
}

Prism side_prism(const std::vector<Vec2>& shares, const Vec3& size, double half_low, double half_high) {
    Prism p;
    p.profile = scaled(shares, size);
    p.half_low = half_low;
    p.half_high = half_high;
    p.b_low = p.profile[0](1);
    p.b_high = p.profile[0](1);
    for (const Vec2& v : p.profile) {
        p.b_low = v(1) < p.b_low ? v(1) : p.b_low;
        p.b_high = v(1) > p.b_high ? v(1) : p.b_high;
    }
    return p;
}

void add_wheels(const Vec3& size, const Chassis& chassis, const Look& look, Pieces& out) {
    const double outer = 0.5 * size(1);  // the wheels stand out of the body by kInset_m: their arches are painted on it
    for (const double x : {chassis.front_axle, chassis.rear_axle}) {
        for (const double side : {1.0, -1.0}) {
            Surface s{Material::kWheel, 0.05F, look.seed, {}};
            s.p = {static_cast<float>(x), static_cast<float>(chassis.wheel_radius),
                   static_cast<float>(chassis.wheel_radius), 0.0F};
            out.push_back(make_rod(Vec3(x, side * (outer - 0.22), chassis.wheel_radius),
                                   Vec3(x, side * outer, chassis.wheel_radius), chassis.wheel_radius, kWheelFaces, s));
        }
    }
    // A rod of n faces touches the ground with an edge only to within its sagitta: n is divisible by 4 and turned by
    // half a face, so its lowest face is flat, radius cos(pi/n) below the axle. The wheels are lowered by the rest.
    for (std::size_t k = out.size() - 4; k < out.size(); ++k) {
        double low = out[k].vertices[0](2);
        for (const Vec3& v : out[k].vertices) {
            low = v(2) < low ? v(2) : low;
        }
        out[k] = transformed(out[k], Pose{Mat3::Identity(), Vec3(0, 0, -low)});
    }
}

// Side faces, ends by the direction of their normal; faces looking up get `top`.
void dress_body(Piece& piece, const Vec3& size, const Chassis& chassis, double belt, const Look& look) {
    for (Face& f : piece.faces) {
        f.surface = Surface{Material::kCarTop, look.tone, look.seed, {}};
        f.surface.p = {static_cast<float>(size(0)), static_cast<float>(size(1)), static_cast<float>(size(2)), 0.0F};
        if (f.n(1) > 0.7 || f.n(1) < -0.7) {
            f.surface.material = Material::kCarSide;
            f.surface.p = {static_cast<float>(chassis.front_axle), static_cast<float>(chassis.rear_axle),
                           static_cast<float>(chassis.wheel_radius), static_cast<float>(belt)};
        } else if (f.n(0) > 0.6) {
            f.surface.material = Material::kCarFront;
            f.surface.p = {static_cast<float>(size(1)), static_cast<float>(belt), 0.0F, 0.0F};
        } else if (f.n(0) < -0.6) {
            f.surface.material = Material::kCarRear;
            f.surface.p = {static_cast<float>(size(1)), static_cast<float>(belt), 0.0F, 0.0F};
        }
    }
}

void dress_cabin(Piece& piece, const Vec3& size, double belt, const Look& look) {
    for (Face& f : piece.faces) {
        f.surface = Surface{Material::kCarTop, look.tone, look.seed + 7U, {}};
        f.surface.p = {static_cast<float>(size(0)), static_cast<float>(size(1)), static_cast<float>(size(2)), 0.0F};
        if (f.n(1) > 0.7 || f.n(1) < -0.7) {
            f.surface.material = Material::kGlassSide;
        }
        if (f.n(0) > 0.25 || f.n(0) < -0.25) {
            f.surface.material = Material::kGlassEnd;  // drawn over (y, z) however much it leans
            f.s_axis = Vec3::UnitY();
            f.t_axis = Vec3::UnitZ();
        }
        if (f.surface.material != Material::kCarTop) {
            f.surface.p = {static_cast<float>(belt), static_cast<float>(size(2)), static_cast<float>(size(0)),
                           static_cast<float>(size(1))};
        }
    }
}

std::vector<Vec2> cabin_profile(BodyStyle style) {
    switch (style) {
        case BodyStyle::kEstate:
            return {{-0.47, 0.60}, {0.24, 0.60}, {0.05, 0.975}, {-0.04, 1.0}, {-0.36, 1.0}, {-0.44, 0.96}};
        case BodyStyle::kHatchback:
            return {{-0.46, 0.60}, {0.28, 0.60}, {0.07, 0.975}, {-0.02, 1.0}, {-0.26, 1.0}, {-0.37, 0.95}};
        case BodyStyle::kSaloon:
            break;
    }
    return {{-0.38, 0.60}, {0.22, 0.60}, {0.04, 0.975}, {-0.03, 1.0}, {-0.16, 1.0}, {-0.23, 0.965}};
}

}  // namespace

Pieces make_car(const Vec3& size, const Look& look) {
    const Chassis chassis{0.205 * size(2), 0.31 * size(0), -0.30 * size(0)};
    const double belt = 0.60 * size(2);
    const double half = 0.5 * size(1);
    Pieces out;
    const std::vector<Vec2> lower = {{-0.49, 0.15}, {0.485, 0.13}, {0.5, 0.22}, {0.5, 0.33},
                                     {0.485, 0.40}, {-0.5, 0.40},  {-0.5, 0.24}};
    out.push_back(make_prism(side_prism(lower, size, half - kInset_m, half - kInset_m), Surface{}));
    dress_body(out.back(), size, chassis, belt, look);
    const std::vector<Vec2> upper = {{-0.5, 0.40}, {0.485, 0.40}, {0.46, 0.475},
                                     {0.24, 0.61}, {-0.40, 0.63}, {-0.485, 0.58}};
    out.push_back(make_prism(side_prism(upper, size, half - kInset_m, half - 0.06), Surface{}));
    dress_body(out.back(), size, chassis, belt, look);
    out.push_back(make_prism(side_prism(cabin_profile(look.style), size, half - 0.07, half - 0.22), Surface{}));
    dress_cabin(out.back(), size, belt, look);
    // Dark floor between the wheels: no daylight straight through a car, but a gap above the road.
    out.push_back(make_box(Vec3(-0.42 * size(0), -half + 0.25, 0.10 * size(2)),
                           Vec3(0.42 * size(0), half - 0.25, 0.2 * size(2)),
                           Surface{Material::kPlain, 0.03F, look.seed, {}}));
    for (const double side : {1.0, -1.0}) {
        const double y = side * (half - 0.09);
        out.push_back(make_box(Vec3(0.15 * size(0), y - 0.09, 0.60 * size(2)),
                               Vec3(0.18 * size(0), y + 0.09, 0.68 * size(2)),
                               Surface{Material::kPlain, look.tone, look.seed + 3U, {}}));
    }
    add_wheels(size, chassis, look, out);
    return out;
}

Pieces make_van(const Vec3& size, const Look& look) {
    const Chassis chassis{0.16 * size(2), 0.33 * size(0), -0.30 * size(0)};
    const double belt = 0.52 * size(2);
    const double half = 0.5 * size(1);
    Pieces out;
    const std::vector<Vec2> lower = {{-0.5, 0.13}, {0.48, 0.12}, {0.5, 0.18}, {0.5, 0.34},
                                     {0.46, 0.43}, {0.37, 0.52}, {-0.5, 0.52}};
    out.push_back(make_prism(side_prism(lower, size, half - kInset_m, half - kInset_m), Surface{}));
    dress_body(out.back(), size, chassis, belt, look);
    const std::vector<Vec2> upper = {{-0.5, 0.52}, {0.37, 0.52}, {0.25, 0.93},
                                     {0.18, 1.0},  {-0.47, 1.0}, {-0.495, 0.95}};
    out.push_back(make_prism(side_prism(upper, size, half - kInset_m, half - 0.12), Surface{}));
    dress_cabin(out.back(), size, belt, look);
    out.push_back(make_box(Vec3(-0.42 * size(0), -half + 0.25, 0.09 * size(2)),
                           Vec3(0.42 * size(0), half - 0.25, 0.2 * size(2)),
                           Surface{Material::kPlain, 0.03F, look.seed, {}}));
    add_wheels(size, chassis, look, out);
    return out;
}

Pieces make_truck(const Vec3& size, const Look& look) {
    const Chassis chassis{0.15 * size(2), 0.36 * size(0), -0.28 * size(0)};
    const double half = 0.5 * size(1);
    Pieces out;
    const std::vector<Vec2> cab = {{0.24, 0.14}, {0.5, 0.14}, {0.5, 0.42}, {0.475, 0.78}, {0.44, 0.82}, {0.24, 0.82}};
    out.push_back(make_prism(side_prism(cab, size, half - 0.04, half - 0.1), Surface{}));
    dress_cabin(out.back(), size, 0.45 * size(2), look);
    const std::vector<Vec2> load = {{-0.5, 0.30}, {0.22, 0.30}, {0.22, 1.0}, {-0.5, 1.0}};
    Surface cargo{Material::kCargo, 0.55F, look.seed + 11U, {}};
    cargo.p = {static_cast<float>(size(0)), static_cast<float>(size(2)), static_cast<float>(size(1)), 0.0F};
    out.push_back(make_prism(side_prism(load, size, half, half), cargo));
    out.push_back(make_box(Vec3(-0.48 * size(0), -half + 0.3, 0.16 * size(2)),
                           Vec3(0.4 * size(0), half - 0.3, 0.31 * size(2)),
                           Surface{Material::kPlain, 0.08F, look.seed, {}}));
    add_wheels(size, chassis, look, out);
    return out;
}

Pieces make_tram(const Vec3& size, const Look& look) {
    const Chassis chassis{0.1 * size(2), 0.36 * size(0), -0.36 * size(0)};
    const double half = 0.5 * size(1);
    Pieces out;
    const std::vector<Vec2> lower = {{-0.49, 0.08}, {0.49, 0.08}, {0.5, 0.2}, {0.5, 0.42}, {-0.5, 0.42}, {-0.5, 0.2}};
    out.push_back(make_prism(side_prism(lower, size, half - kInset_m, half - kInset_m), Surface{}));
    dress_body(out.back(), size, chassis, 0.4 * size(2), look);
    const std::vector<Vec2> upper = {{-0.5, 0.42}, {0.5, 0.42}, {0.48, 0.95}, {0.46, 1.0}, {-0.46, 1.0}, {-0.48, 0.95}};
    out.push_back(make_prism(side_prism(upper, size, half - kInset_m, half - 0.05), Surface{}));
    dress_cabin(out.back(), size, 0.42 * size(2), look);
    add_wheels(size, chassis, look, out);
    return out;
}

Pieces make_road_user(ObjectClass object_class, const Vec3& size_m, const Look& look, double gait) {
    switch (object_class) {
        case ObjectClass::kVan:
            return make_van(size_m, look);
        case ObjectClass::kTruck:
            return make_truck(size_m, look);
        case ObjectClass::kTram:
            return make_tram(size_m, look);
        case ObjectClass::kPedestrian:
            return make_pedestrian(size_m, look, gait);
        case ObjectClass::kCyclist:
            return make_cyclist(size_m, look, gait);
        case ObjectClass::kCar:
        case ObjectClass::kMisc:
            break;
    }
    return make_car(size_m, look);
}

}  // namespace semtrack::sil::world
