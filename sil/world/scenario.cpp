#include "sil/world/scenario.hpp"

#include <array>

#include "math/trig.hpp"
#include "sil/sequence.hpp"
#include "sil/world/scenario_list.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

struct Entry {
    const char* name;
    Scenario (*make)();
};

constexpr std::array<Entry, 30> kScenarios{{
    {"street", make_street_scenario},
    {"empty", make_empty_scenario},
    {"traffic", make_traffic_scenario},
    {"follow", make_follow_scenario},
    {"crossing", make_crossing_scenario},
    {"cut_in", make_cut_in_scenario},
    {"beside", make_beside_scenario},
    {"passed", make_passed_scenario},
    {"turning", make_turning_scenario},
    {"reversing", make_reversing_scenario},
    {"pedestrians", make_pedestrians_scenario},
    {"far", make_far_scenario},
    {"occlusion", make_occlusion_scenario},
    {"standing", make_standing_scenario},
    {"braking", make_braking_scenario},
    {"hill", make_hill_scenario},
    {"night", make_night_scenario},
    {"exposure", make_exposure_scenario},
    {"dropped", make_dropped_scenario},
    {"blackout", make_blackout_scenario},
    {"blind_right", make_blind_right_scenario},
    {"misaligned", make_misaligned_scenario},
    {"detector_5hz", make_detector_5hz_scenario},
    {"detector_misses", make_detector_misses_scenario},
    {"no_viewpoint", make_no_viewpoint_scenario},
    {"short_street", make_short_street_scenario},
    {"avenue", make_avenue_scenario},
    {"avenue_residual", make_avenue_residual_scenario},
    {"queue", make_queue_scenario},
    {"queue_empty", make_queue_empty_scenario},
}};

// Spread of KITTI's cars: 0.12, 0.09, 0.4 m about the class mean.
double spread(std::uint32_t seed, std::uint32_t what, double amplitude) {
    return amplitude * (2.0 * static_cast<double>(unit(hash(seed, what))) - 1.0);
}

float paint(std::uint32_t seed) {
    constexpr std::array<float, 8> kTones{0.06F, 0.10F, 0.18F, 0.30F, 0.42F, 0.55F, 0.72F, 0.85F};
    return kTones[hash(seed, 21U) % kTones.size()];
}

bool in_gap(const std::vector<Gap>& gaps, double z) {
    for (const Gap& g : gaps) {
        if (z > g.from_z - 3.0 && z < g.to_z + 3.0) {
            return true;
        }
    }
    return false;
}

void add_row(const std::vector<Gap>& gaps, double x, double heading, double z0, double z1, std::uint32_t seed, int& id,
             Scenario& scenario) {
    double z = z0;
    std::uint32_t k = 0;
    while (z < z1) {
        const std::uint32_t h = hash(seed, k++);
        if (!in_gap(gaps, z) && h % 10U < 8U) {
            Motion m;
            m.x = x + spread(h, 1U, 0.12);
            m.z = z;
            m.heading = heading + (h % 7U == 0U ? kPi : 0.0) + spread(h, 2U, 0.025);
            scenario.users.push_back(make_user(id++, h % 9U == 1U ? ObjectClass::kVan : ObjectClass::kCar, m, h));
        }
        z += 6.1 + static_cast<double>(unit(hash(h, 3U))) * 2.2;
    }
}

}  // namespace

Scenario find_scenario(const std::string& name) {
    for (const Entry& e : kScenarios) {
        if (name == e.name) {
            Scenario s = e.make();
            s.name = name;
            return s;
        }
    }
    std::string known;
    for (const Entry& e : kScenarios) {
        known += std::string(known.empty() ? "" : ", ") + e.name;
    }
    throw InputError("unknown scenario '" + name + "' (there are " + known + ")");
}

std::vector<std::string> all_scenario_names() {
    std::vector<std::string> names;
    for (const Entry& e : kScenarios) {
        names.emplace_back(e.name);
    }
    return names;
}

RoadUser make_user(int id, ObjectClass object_class, const Motion& motion, std::uint32_t seed) {
    RoadUser u;
    u.id = id;
    u.object_class = object_class;
    u.motion = motion;
    u.look.seed = hash(seed, 20U);
    u.look.tone = paint(seed);
    u.look.style = static_cast<BodyStyle>(hash(seed, 22U) % 3U);
    double l = 4.0;
    double w = 1.65;
    double h = 1.52;
    switch (object_class) {
        case ObjectClass::kVan:
            l = 4.9;
            w = 1.9;
            h = 2.1;
            break;
        case ObjectClass::kTruck:
            l = 8.5;
            w = 2.5;
            h = 3.2;
            break;
        case ObjectClass::kTram:
            l = 16.0;
            w = 2.5;
            h = 3.5;
            break;
        case ObjectClass::kPedestrian:
            l = 0.8;
            w = 0.62;
            h = 1.75;
            break;
        case ObjectClass::kCyclist:
            l = 1.78;
            w = 0.6;
            h = 1.75;
            break;
        case ObjectClass::kCar:
        case ObjectClass::kMisc:
            break;
    }
    const bool person = object_class == ObjectClass::kPedestrian || object_class == ObjectClass::kCyclist;
    u.length = l + (person ? 0.0 : spread(seed, 10U, 0.1 * l));
    u.width = w + spread(seed, 11U, person ? 0.04 : 0.08);
    u.height = h + spread(seed, 12U, person ? 0.09 : 0.07);
    return u;
}

double kerb_right(const Street& s) {
    return 0.5 * s.lane_width + s.parking_right;
}
double kerb_left(const Street& s) {
    return -0.5 * s.lane_width - s.lane_width * static_cast<double>(s.lanes_left) - s.parking_left;
}

void add_parked_cars(const Street& street, double z0, double z1, std::uint32_t seed, int first_id, Scenario& scenario) {
    int id = first_id;
    add_row(street.gaps_right, kerb_right(street) - 1.05, 0.0, z0, z1, hash(seed, 1U), id, scenario);
    add_row(street.gaps_left, kerb_left(street) + 1.05, kPi, z0 + 3.0, z1, hash(seed, 2U), id, scenario);
}

}  // namespace semtrack::sil::world
