// A received list at another time of the receiver.
#include "math/trig.hpp"
#include "semtrack/can_receiver.hpp"

namespace semtrack {

namespace {

constexpr std::int64_t kLongest_us = 1000000;
constexpr double kSmallAngle = 1e-4;  // sin(x) / x = 1 - x^2 / 6 to 1e-17

bool firm(const Received<double>& value) {
    return value.valid && !value.saturated;
}

}  // namespace

Status bring_to_time(std::int64_t own_us, ReceivedList& list) {
    if (!list.taken_us.valid || !firm(list.ego_speed) || !firm(list.ego_yaw_rate)) {
        return Status::kInvalidArgument;
    }
    const std::uint64_t ahead_us = static_cast<std::uint64_t>(own_us) - static_cast<std::uint64_t>(list.taken_us.value);
    const auto step_us = static_cast<std::int64_t>(ahead_us);
    if (step_us > kLongest_us || step_us < -kLongest_us) {
        return Status::kInvalidArgument;
    }
    const double dt = static_cast<double>(step_us) * 1e-6;
    // The ego's chord: speed * dt * sin(half) / half, turned by half of the yaw.
    const double half = 0.5 * list.ego_yaw_rate.value * dt;
    const SinCos h = sin_cos(half);
    const double shrink = half * half > kSmallAngle * kSmallAngle ? h.sin / half : 1.0 - half * half / 6.0;
    const double chord = list.ego_speed.value * dt * shrink;
    const SinCos turn = sin_cos(2.0 * half);
    for (ReceivedObject& o : list.objects) {
        const double vx = o.velocity_x.value;  // 0 when not valid: the object is taken as standing
        const double vy = o.velocity_y.value;
        const double x = o.x.value + vx * dt - chord * h.cos;
        const double y = o.y.value + vy * dt - chord * h.sin;
        o.x.value = turn.cos * x + turn.sin * y;
        o.y.value = turn.cos * y - turn.sin * x;
        o.velocity_x.value = turn.cos * vx + turn.sin * vy;
        o.velocity_y.value = turn.cos * vy - turn.sin * vx;
        if (o.yaw.valid) {
            o.yaw.value = wrap_angle(o.yaw.value + o.yaw_rate.value * dt - 2.0 * half);
        }
    }
    list.taken_us.value = own_us;
    list.image_time_us = static_cast<std::int64_t>(static_cast<std::uint64_t>(list.image_time_us) + ahead_us);
    list.age_us = {};
    return Status::kOk;
}

}  // namespace semtrack
