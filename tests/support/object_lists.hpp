// Outputs of a tracker to be encoded: a fixed one, random ones, and frames as text.
#ifndef SEMTRACK_TESTS_SUPPORT_OBJECT_LISTS_HPP
#define SEMTRACK_TESTS_SUPPORT_OBJECT_LISTS_HPP

#include <cstdio>
#include <limits>
#include <string>

#include "math/rng.hpp"
#include "math/trig.hpp"
#include "semtrack/can_encoder.hpp"

namespace semtrack::test {

inline constexpr std::int64_t kListTime_us = 1317039265123456;

inline void set_ego(Output& output, std::int64_t time_us, double speed, double yaw_rate) {
    output.ego.time_us = time_us;
    output.ego.status = EgoStatus::kTracked;
    output.ego.speed = speed;
    output.ego.yaw_rate = yaw_rate;
    output.ego.sigma_speed = 0.11;
    output.ego.sigma_yaw_rate = 0.004;
}

inline TrackedObject plain_object(std::uint32_t id, double x, double y) {
    TrackedObject o;
    o.id = id;
    o.slot = static_cast<int>(id) % kMaxObjects;
    o.status = TrackStatus::kMeasured;
    o.movement = MovementState::kMoving;
    o.existence = 0.97;
    o.age = 12;
    o.has_heading = true;
    o.position_v = {x, y, -0.4};
    o.velocity_v = {7.3, -0.6};
    o.speed = 7.3;
    o.yaw_v = -0.08;
    o.yaw_rate = 0.05;
    o.size = {4.1, 1.7, 1.5};
    o.sigma_position_v = {0.4, 0.2, 0.1};
    o.sigma_velocity_v = {0.3, 0.2};
    o.sigma_yaw = 0.06;
    return o;
}

/// A car ahead, an oncoming van, a standing pedestrian without heading: what the golden frames hold.
inline void golden_output(Output& output) {
    output = Output{};
    set_ego(output, kListTime_us, 8.4, -0.12);
    output.health.frames_dropped = 3;
    TrackedObject car = plain_object(7, 12.5, 1.25);
    TrackedObject van = plain_object(300, 40.0, 6.5);
    van.object_class = ObjectClass::kVan;
    van.movement = MovementState::kOncoming;
    van.velocity_v = {-13.2, 0.4};
    van.speed = 13.2;
    van.yaw_v = 3.1;
    van.occlusion = 1;
    TrackedObject person = plain_object(4096, 9.0, -4.0);
    person.object_class = ObjectClass::kPedestrian;
    person.status = TrackStatus::kCoasted;
    person.movement = MovementState::kStanding;
    person.has_heading = false;
    person.velocity_v = {0.0, 0.0};
    person.speed = 0.0;
    person.yaw_rate = 0.0;
    person.size = {0.6, 0.6, 1.75};
    person.truncation = 0.4;
    person.existence = 0.6;
    (void)output.objects.try_push_back(car);
    (void)output.objects.try_push_back(van);
    (void)output.objects.try_push_back(person);
}

inline double between(Rng& rng, double low, double high) {
    return low + (high - low) * rng.uniform();
}

/// A value that tends to the odd places: ends of the range and beyond, zero of both signs, half bits.
inline double odd_value(Rng& rng, double low, double high, double step) {
    switch (rng.next() % 10U) {
        case 0:
            return -0.0;
        case 1:
            return low;
        case 2:
            return high;
        case 3:
            return low + (static_cast<double>(rng.next() % 200U) + 0.5) * step;  // on half a bit
        case 4:
            return -0.5 * step;
        case 5:
            return 3.0 * high;
        case 6:
            return low < 0.0 ? 3.0 * low : -high;
        case 7:
            return rng.next() % 4U == 0U ? std::numeric_limits<double>::quiet_NaN() : 0.5 * step;
        default:
            return between(rng, low, high);
    }
}

inline TrackedObject random_object(Rng& rng, std::uint32_t id) {
    TrackedObject o;
    o.id = rng.next() % 4U == 0U ? 4094U + 4095U * (id - 1U) : id;
    o.slot = static_cast<int>(id) % kMaxObjects;
    o.object_class = static_cast<ObjectClass>(rng.next() % kObjectClasses);
    o.status = static_cast<TrackStatus>(rng.next() % 4U);
    o.movement = static_cast<MovementState>(rng.next() % 5U);
    o.existence = rng.uniform();
    o.age = static_cast<int>(rng.next() % 3000U);
    o.has_heading = rng.next() % 3U != 0U;
    o.speed = odd_value(rng, -10.0, 70.0, 0.01);
    const double y = odd_value(rng, -300.0, 355.34, 0.01);
    o.position_v = {between(rng, -200.0, 400.0), y == y ? y : 3.0, between(rng, -25.0, 25.0)};
    o.velocity_v = {odd_value(rng, -80.0, 83.82, 0.01), odd_value(rng, -80.0, 83.82, 0.01)};
    const double pi = kPi;
    constexpr std::uint32_t kAngles = 6;
    const std::uint32_t angle = rng.next() % kAngles;
    o.yaw_v = angle == 0U ? -pi : angle == 1U ? 0.0 : angle == 2U ? pi : angle == 3U ? -0.0 : between(rng, -pi, pi);
    o.yaw_rate = odd_value(rng, -2.0, 2.094, 0.001);
    o.size = {between(rng, 0.0, 45.0), between(rng, 0.0, 11.0), between(rng, 0.0, 11.0)};
    o.sigma_position_v = {odd_value(rng, 0.0, 20.44, 0.02), between(rng, 0.0, 3.0), between(rng, 0.0, 25.0)};
    o.sigma_velocity_v = {odd_value(rng, 0.0, 25.5, 0.05), between(rng, 0.0, 3.0)};
    o.sigma_yaw = between(rng, 0.0, 4.0);
    o.truncation = rng.uniform();
    o.occlusion = static_cast<int>(rng.next() % 4U);
    return o;
}

inline void random_output(Rng& rng, int objects, Output& output) {
    output = Output{};
    set_ego(output, static_cast<std::int64_t>(rng.next()) * 4000000, odd_value(rng, -80.0, 83.82, 0.01),
            odd_value(rng, -2.0, 2.095, 0.0005));
    output.ego.status = static_cast<EgoStatus>(rng.next() % 4U);
    output.ego.sigma_speed = between(rng, 0.0, 12.0);
    output.ego.sigma_yaw_rate = between(rng, 0.0, 0.6);
    output.health.frames_dropped = rng.next();
    output.health.ego_degraded = rng.next() % 2U == 0U;
    output.health.no_right_image = rng.next() % 2U == 0U;
    output.health.no_detections = rng.next() % 2U == 0U;
    output.health.road_not_plane = rng.next() % 2U == 0U;
    for (int k = 0; k < objects; ++k) {
        (void)output.objects.try_push_back(random_object(rng, static_cast<std::uint32_t>(k + 1)));
    }
}

/// As in a candump log: `600##1...` (FD), `600#...`.
inline std::string frame_text(const CanFrame& frame) {
    char id[12];
    (void)std::snprintf(id, sizeof id, frame.extended ? "%08X" : "%03X", static_cast<unsigned>(frame.id));
    std::string out = std::string(id) + (frame.fd ? "##1" : "#");
    for (std::size_t i = 0; i < frame.length; ++i) {
        char byte[3];
        (void)std::snprintf(byte, sizeof byte, "%02X", static_cast<unsigned>(frame.data[i]));
        out += byte;
    }
    return out;
}

}  // namespace semtrack::test

#endif
