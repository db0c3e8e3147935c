// Small scenes and helpers that the tests of the rendered street share.
#ifndef SEMTRACK_TESTS_SIL_WORLD_WORLD_CASES_HPP
#define SEMTRACK_TESTS_SIL_WORLD_WORLD_CASES_HPP

#include <cstdint>

#include "sil/world/renderer.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

/// The empty street, standing camera without bumps, no noise, exact rectification, right camera as
/// bright as the left one.
inline Scenario quiet_street() {
    Scenario s = find_scenario("empty");
    s.ego = Ego{};
    s.ego.pitch_amplitude = s.ego.roll_amplitude = s.ego.height_amplitude = 0.0;
    s.imaging = Imaging{};
    s.detector = DetectorErrors{};
    s.imaging.noise_sigma = 0.0;
    s.imaging.rectification_px = 0.0;
    return s;
}

inline Scenario with_user(Scenario s, ObjectClass object_class, double x, double z, double heading) {
    Motion m;
    m.x = x;
    m.z = z;
    m.heading = heading;
    s.users.push_back(make_user(1, object_class, m, 3U));
    return s;
}

/// The pair's geometry at a quarter of its size: quick to render.
inline Calibration small_calibration(const Scenario& s) {
    Calibration c = world_calibration(s);
    c.width = 310;
    c.height = 94;
    c.left = PinholeCamera{180.375, 180.375, 152.025, 42.85};
    c.right = c.detection = c.left;
    return c;
}

/// FNV-1a of bytes: pixels or text.
template <class Bytes>
std::uint64_t hash_of(const Bytes& bytes) {
    std::uint64_t h = 14695981039346656037ULL;
    for (const auto b : bytes) {
        h = (h ^ static_cast<std::uint8_t>(b)) * 1099511628211ULL;
    }
    return h;
}

}  // namespace semtrack::sil::world

#endif
