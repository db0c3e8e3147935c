// The street through bad cameras and detectors.
#include "sil/world/scenario_list.hpp"

namespace semtrack::sil::world {

Scenario make_short_street_scenario() {
    Scenario s = make_street_scenario();
    s.frames = 40;
    s.imaging.exposure = {};
    return s;
}

Scenario make_night_scenario() {
    Scenario s = make_short_street_scenario();
    s.imaging.gain = 0.3;
    s.imaging.noise_sigma = 4.0;
    return s;
}

Scenario make_exposure_scenario() {
    Scenario s = make_short_street_scenario();
    s.imaging.exposure = {{15, 0.5}, {25, 0.7}, {32, 1.0}};
    return s;
}

Scenario make_dropped_scenario() {
    Scenario s = make_short_street_scenario();
    s.imaging.dropped = {12, 25, 26};
    return s;
}

Scenario make_blackout_scenario() {
    Scenario s = make_braking_scenario();
    s.imaging.dropped = {15, 16, 17, 18, 19};
    return s;
}

Scenario make_blind_right_scenario() {
    Scenario s = make_short_street_scenario();
    s.imaging.blind_right_from = 20;
    s.imaging.blind_right_to = 24;
    return s;
}

Scenario make_misaligned_scenario() {
    Scenario s = make_short_street_scenario();
    s.imaging.row_error_px = 1.0;
    return s;
}

Scenario make_detector_5hz_scenario() {
    Scenario s = make_short_street_scenario();
    s.detector.every = 2;
    return s;
}

Scenario make_detector_misses_scenario() {
    Scenario s = make_short_street_scenario();
    s.detector.miss = 0.3;
    return s;
}

Scenario make_no_viewpoint_scenario() {
    Scenario s = make_short_street_scenario();
    s.detector.viewpoints = false;
    return s;
}

}  // namespace semtrack::sil::world
