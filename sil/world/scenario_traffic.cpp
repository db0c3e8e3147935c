// Scenarios by what moves. N: x to the right of the ego's lane, z along the street.
#include "math/trig.hpp"
#include "sil/world/scenario_list.hpp"

namespace semtrack::sil::world {

namespace {

/// An open street: houses far back, no parked cars, side streets where `gaps` are.
Scenario make_base(std::uint32_t seed, int frames, double speed, std::vector<Phase> phases = {}) {
    Scenario s;
    s.seed = seed;
    s.frames = frames;
    s.street.seed = seed + 30U;
    s.street.gaps_right = {{20.0, 38.0}};
    s.street.gaps_left = {{20.0, 38.0}};
    s.imaging.right_offset = -5.0;
    s.ego.motion = make_motion(0.0, 0.0, 0.0, speed, std::move(phases));
    return s;
}

void add(Scenario& s, int id, ObjectClass object_class, const Motion& motion) {
    s.users.push_back(make_user(id, object_class, motion, s.seed * 100U + static_cast<std::uint32_t>(id)));
}

/// Up and down again: from `start` a sag, `straight` metres at `slope`, a crest, the same downwards, a sag. Vertical
/// curves are parabolas of `radius`, as roads are built.
std::vector<HeightKnot> hill_profile(double start, double slope, double radius, double straight) {
    constexpr double kStep_m = 1.0;
    const double sag = slope * radius;
    const double length = 4.0 * sag + 2.0 * straight;
    std::vector<HeightKnot> out;
    double height = 0.0;
    for (double z = 0.0; z <= length; z += kStep_m) {
        out.push_back({start + z, height});
        const double half = z + 0.5 * kStep_m < 0.5 * length ? z + 0.5 * kStep_m : length - z - 0.5 * kStep_m;
        const double rise = half < sag              ? half / radius
                            : half < sag + straight ? slope
                                                    : slope - (half - sag - straight) / radius;
        height += kStep_m * (z + 0.5 * kStep_m < 0.5 * length ? rise : -rise);
    }
    out.push_back({start + length, 0.0});
    return out;
}

constexpr ObjectClass kCar = ObjectClass::kCar;
constexpr double kLeftLane = -3.5;

}  // namespace

Scenario make_traffic_scenario() {
    Scenario s = make_empty_scenario();
    s.detector = DetectorErrors{};
    s.ego.motion = make_motion(0.0, 0.0, 0.0, 6.0);
    const double left = kLeftLane;
    s.users.push_back(make_user(1, ObjectClass::kTruck, make_motion(0.0, 12.0, 0.0, 6.2), 201U));
    s.users.push_back(make_user(2, ObjectClass::kVan, make_motion(left + 0.3, 6.5, 0.0, 6.6), 202U));
    s.users.push_back(make_user(3, kCar, make_motion(left + 0.2, 13.5, 0.0, 6.5), 203U));
    s.users.push_back(make_user(4, ObjectClass::kTruck, make_motion(3.3, 11.5, 0.0, 5.6, {{2.0, 0.2, 0.0}}), 204U));
    s.users.push_back(make_user(5, kCar, make_motion(left, 22.0, 0.0, 6.8), 205U));
    s.users.push_back(make_user(6, kCar, make_motion(0.1, 24.0, 0.0, 6.4), 206U));
    s.street.parking_right = 3.4;
    return s;
}

Scenario make_follow_scenario() {
    Scenario s = make_base(41U, 500, 13.5, {{10.0, 0.1, 0.0}, {5.0, -0.6, 0.0}, {10.0, 0.3, 0.0}});
    add(s, 1, kCar, make_motion(0.1, 16.0, 0.0, 13.6, {{10.0, 0.1, 0.0}, {5.0, -0.5, 0.0}, {10.0, 0.25, 0.0}}));
    int id = 2;
    for (int k = 0; k < 12; ++k) {
        add(s, id++, kCar, make_motion(kLeftLane + 0.1 * (k % 4), 90.0 + 105.0 * k, kPi, 11.0 + 0.5 * (k % 5)));
    }
    add_parked_cars(s.street, 0.0, 760.0, 9U, 100, s);
    return s;
}

Scenario make_crossing_scenario() {
    Scenario s = make_base(42U, 45, 0.0);
    add(s, 1, kCar, make_motion(-16.0, 27.0, 0.5 * kPi, 7.0));
    add(s, 2, kCar, make_motion(18.0, 31.0, -0.5 * kPi, 6.0));
    add(s, 3, kCar, make_motion(kLeftLane, 60.0, kPi, 6.5));
    add(s, 4, ObjectClass::kCyclist, make_motion(12.0, 23.0, -0.5 * kPi, 4.5));
    return s;
}

Scenario make_cut_in_scenario() {
    Scenario s = make_base(43U, 50, 9.0);
    add(s, 1, kCar, make_motion(kLeftLane, 2.0, 0.0, 12.5, change_lane(1.4, 12.5, 1.0, -30.0, -0.6)));
    add(s, 2, kCar, make_motion(0.0, 32.0, 0.0, 9.2));
    add_parked_cars(s.street, 0.0, 90.0, 4U, 10, s);
    return s;
}

Scenario make_beside_scenario() {
    Scenario s = make_base(44U, 50, 8.0);
    add(s, 1, kCar, make_motion(-2.7, 0.5, 0.0, 8.9, {{3.0, 0.25, 0.0}}));
    add(s, 2, kCar, make_motion(kLeftLane, 70.0, kPi, 8.0));
    add_parked_cars(s.street, 0.0, 90.0, 6U, 10, s);
    return s;
}

Scenario make_passed_scenario() {
    Scenario s = make_base(53U, 80, 7.6);
    add(s, 1, kCar, make_motion(-3.0, 14.0, 0.0, 6.0));
    add_parked_cars(s.street, 0.0, 90.0, 15U, 10, s);
    return s;
}

Scenario make_turning_scenario() {
    Scenario s = make_base(45U, 50, 4.0);
    add(s, 1, kCar, make_motion(0.0, 14.0, 0.0, 5.0, {{1.6, -0.3, 0.0}, {2.6, 0.0, 1.0 / 6.5}}));
    add(s, 2, kCar, make_motion(kLeftLane, 47.0, kPi, 5.0, {{2.2, 0.0, 0.0}, {2.8, 0.0, -1.0 / 7.5}}));
    add(s, 3, kCar, make_motion(14.0, 31.0, -0.5 * kPi, 4.5, {{2.0, 0.0, 0.0}, {2.8, 0.0, 1.0 / 7.5}}));
    return s;
}

Scenario make_reversing_scenario() {
    Scenario s = make_base(46U, 90, 0.0);
    s.street.gaps_right = {{4.0, 16.0}};
    add(s, 1, kCar,
        make_motion(3.1, 14.0, 0.25, 0.0,
                    {{2.5, 0.0, 0.0},
                     {1.0, -1.5, 0.0},
                     {2.5, 0.0, 1.0 / 12.0},
                     {0.75, 2.0, 0.0},
                     {0.6, 0.0, 0.0},
                     {3.0, 1.6, 0.0}}));
    add(s, 2, kCar, make_motion(kLeftLane, 70.0, kPi, 6.0));
    return s;
}

Scenario make_pedestrians_scenario() {
    Scenario s = make_base(47U, 50, 2.5);
    for (int k = 0; k < 3; ++k) {
        add(s, k + 1, ObjectClass::kPedestrian, make_motion(5.5 + 0.8 * k, 16.0 + 2.5 * k, -0.5 * kPi, 1.2 + 0.15 * k));
    }
    add(s, 4, ObjectClass::kPedestrian, make_motion(-6.5, 21.0, 0.5 * kPi, 1.5));
    add(s, 5, ObjectClass::kPedestrian, make_motion(-4.8, 13.0, 0.0, 1.1));
    add_parked_cars(s.street, 4.0, 60.0, 8U, 10, s);
    return s;
}

Scenario make_far_scenario() {
    Scenario s = make_base(48U, 50, 12.0);
    s.detector.least_height_px = 10.0;
    add(s, 1, kCar, make_motion(0.1, 62.0, 0.0, 12.5));
    add(s, 2, kCar, make_motion(kLeftLane + 0.2, 100.0, 0.0, 11.0));
    add(s, 3, kCar, make_motion(0.0, 84.0, 0.0, 12.0));
    return s;
}

Scenario make_occlusion_scenario() {
    Scenario s = make_base(49U, 70, 0.0);
    add(s, 1, ObjectClass::kTruck, make_motion(0.5, 17.0, 0.5 * kPi, 0.0));
    add(s, 2, kCar, make_motion(-15.0, 29.0, 0.5 * kPi, 5.5));
    return s;
}

Scenario make_standing_scenario() {
    Scenario s = make_base(50U, 50, 0.0);
    s.street.gaps_right = {};
    s.street.gaps_left = {};
    add(s, 1, kCar, make_motion(kLeftLane, 55.0, kPi, 10.0));
    add(s, 2, kCar, make_motion(kLeftLane + 0.2, 80.0, kPi, 9.0));
    add(s, 3, kCar, make_motion(0.2, 9.0, 0.0, 0.0, {{1.5, 0.0, 0.0}, {3.0, 1.8, 0.0}}));
    add_parked_cars(s.street, 2.0, 70.0, 12U, 10, s);
    return s;
}

Scenario make_braking_scenario() {
    Scenario s = make_base(51U, 45, 13.0, {{1.2, 0.0, 0.0}, {1.8, -7.0, 0.0}});
    s.ego.pitch_amplitude = 0.006;
    add(s, 1, kCar, make_motion(0.1, 22.0, 0.0, 13.0, {{0.8, 0.0, 0.0}, {1.85, -7.0, 0.0}}));
    add(s, 2, kCar, make_motion(kLeftLane, 75.0, kPi, 12.0));
    add_parked_cars(s.street, 0.0, 90.0, 13U, 10, s);
    return s;
}

Scenario make_hill_scenario() {
    Scenario s = make_base(52U, 75, 12.0);
    s.street.gaps_right = {};
    s.street.gaps_left = {};
    s.street.profile = hill_profile(6.0, 0.0875, 200.0, 10.0);
    add(s, 1, kCar, make_motion(0.1, 18.0, 0.0, 12.2));
    add(s, 2, kCar, make_motion(kLeftLane, 110.0, kPi, 10.0));
    add_parked_cars(s.street, 0.0, 130.0, 14U, 10, s);
    return s;
}

}  // namespace semtrack::sil::world
