// Scenarios for the ego-motion alone: long enough to see a length bias, and the traffic's street without traffic.
#include "sil/world/scenario_list.hpp"

namespace semtrack::sil::world {

Scenario make_avenue_scenario() {
    Scenario s;
    s.seed = 61U;
    s.frames = 340;
    s.street.seed = 91U;
    s.street.gaps_right = {{60.0, 78.0}, {190.0, 204.0}, {300.0, 316.0}};
    s.street.gaps_left = {{120.0, 136.0}, {230.0, 244.0}};
    s.imaging.right_offset = -5.0;
    s.imaging.rectification_px = 0.0;
    s.detector.false_positives = 0.0;
    s.ego.motion = make_motion(0.0, 0.0, 0.0, 9.0,
                               {{4.0, 0.4, 0.0},
                                {2.0, 0.0, 0.002},
                                {4.0, 0.0, -0.002},
                                {2.0, 0.0, 0.002},
                                {5.0, -0.5, 0.0},
                                {2.0, 0.3, -0.003},
                                {4.0, 0.3, 0.003},
                                {2.0, 0.3, -0.003}});
    add_parked_cars(s.street, 0.0, 380.0, 19U, 1, s);
    return s;
}

Scenario make_avenue_residual_scenario() {
    Scenario s = make_avenue_scenario();
    s.imaging.rectification_px = Imaging{}.rectification_px;
    return s;
}

// The residual of a rectification turns the estimate by where in the image the features lie, traffic or not: it is left
// out, so that the two differ by the traffic alone.
Scenario make_queue_scenario() {
    Scenario s = make_traffic_scenario();
    s.imaging.rectification_px = 0.0;
    return s;
}

Scenario make_queue_empty_scenario() {
    Scenario s = make_queue_scenario();
    s.users.clear();
    return s;
}

}  // namespace semtrack::sil::world
