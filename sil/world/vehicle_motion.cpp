#include "sil/world/vehicle_motion.hpp"

#include "math/rng.hpp"

namespace semtrack::sil::world {

namespace {

constexpr std::uint32_t kSensorSeed = 7919U;  // other numbers than the scenario draws elsewhere

}  // namespace

std::map<std::int64_t, VehicleMotion> vehicle_motion(const Scene& scene) {
    Rng rng(scene.scenario().seed + kSensorSeed);
    const double scale = 1.0 + kWheelScale * rng.normal();
    const double bias = kYawRateBias_radps * rng.normal();
    std::map<std::int64_t, VehicleMotion> out;
    for (int frame = 0; frame < scene.frames(); ++frame) {
        const PathState& ego = scene.ego(frame);
        VehicleMotion m;
        m.time_us = frame * kFrame_us;
        m.speed = scale * ego.speed + kWheelNoise_mps * rng.normal();
        m.yaw_rate = bias - ego.turn_rate + kYawRateNoise_radps * rng.normal();
        out[m.time_us] = m;
    }
    return out;
}

}  // namespace semtrack::sil::world
