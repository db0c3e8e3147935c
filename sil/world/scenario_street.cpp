#include "math/trig.hpp"
#include "sil/world/scenario_list.hpp"

namespace semtrack::sil::world {

Motion make_motion(double x, double z, double heading, double speed, std::vector<Phase> phases) {
    Motion m;
    m.x = x;
    m.z = z;
    m.heading = heading;
    m.speed = speed;
    m.phases = std::move(phases);
    return m;
}

std::vector<Phase> change_lane(double wait_s, double speed, double arc_s, double radius, double acceleration) {
    const double first = (speed + 0.5 * acceleration * arc_s) * arc_s;
    const double second = first + acceleration * arc_s * arc_s;
    return {{wait_s, 0.0, 0.0}, {arc_s, acceleration, -1.0 / radius}, {arc_s, acceleration, first / (second * radius)}};
}

Scenario make_street_scenario() {
    Scenario s = make_empty_scenario();
    s.detector = DetectorErrors{};
    const double left_lane = -s.street.lane_width;
    // 1 drives ahead, brakes and turns off to the right; 2 comes towards us; 3 overtakes.
    s.users.push_back(
        make_user(1, ObjectClass::kCar,
                  make_motion(0.1, 15.0, 0.0, 8.0, {{1.6, 0.0, 0.0}, {1.6, -2.2, 0.0}, {2.5, 0.0, 1.0 / 7.2}}), 101U));
    s.users.push_back(make_user(2, ObjectClass::kCar, make_motion(left_lane + 0.2, 38.0, kPi, 9.5), 102U));
    s.users.push_back(
        make_user(3, ObjectClass::kCar, make_motion(0.0, -8.0, 0.0, 7.5, change_lane(2.0, 7.5, 1.1, 26.0, 1.5)), 113U));
    s.users.push_back(
        make_user(4, ObjectClass::kPedestrian, make_motion(kerb_right(s.street) + 1.2, 16.0, kPi, 1.3), 104U));
    s.users.push_back(make_user(5, ObjectClass::kPedestrian, make_motion(5.6, 56.0, -0.5 * kPi, 1.3), 105U));
    s.users.push_back(make_user(6, ObjectClass::kCyclist, make_motion(left_lane - 1.1, 30.0, kPi, 4.2), 106U));
    add_parked_cars(s.street, -2.0, 110.0, 5U, 10, s);
    s.imaging.exposure = {{40, 0.86}, {41, 0.9}, {44, 0.94}};
    return s;
}

Scenario make_empty_scenario() {
    Scenario s;
    s.seed = 7U;
    s.frames = 60;
    s.street.seed = 11U;
    s.street.gaps_right = {{38.0, 50.0}};
    s.street.gaps_left = {{70.0, 80.0}};
    s.ego.motion =
        make_motion(0.0, 0.0, 0.0, 7.5, {{1.5, 0.2, 0.0}, {1.5, -1.6, 0.0}, {1.0, 0.0, 0.012}, {1.0, 0.4, -0.012}});
    s.imaging.right_offset = -5.0;
    s.detector.false_positives = 0.0;
    return s;
}

}  // namespace semtrack::sil::world
