#include "semtrack/vehicle_motion_frame.hpp"

#include "publish/e2e.hpp"
#include "publish/messages.hpp"

namespace semtrack {

namespace {

std::uint16_t data_id_of(const DialectSpec& dialect) {
    return static_cast<std::uint16_t>(kE2eFirstDataId + dialect.messages);
}

Received<double>& member(VehicleMotionSignals& signals, SignalId id) {
    switch (id) {
        case SignalId::kVehicleSpeed:
            return signals.speed;
        case SignalId::kVehicleYawRate:
            return signals.yaw_rate;
        case SignalId::kSigmaVehicleSpeed:
            return signals.sigma_speed;
        default:
            return signals.sigma_yaw_rate;
    }
}

}  // namespace

std::uint32_t vehicle_motion_id(const CanConfig& config) {
    return config.base_id + dialect_spec(config.dialect).messages;
}

E2eState decode_vehicle_motion(const CanConfig& config, const CanFrame& frame, E2eCheck& check,
                               VehicleMotionSignals& signals) {
    const DialectSpec& dialect = dialect_spec(config.dialect);
    const MessageSpec& m = dialect.vehicle_motion;
    if (frame.id != vehicle_motion_id(config) || frame.extended != config.extended) {
        return E2eState::kNoNewData;
    }
    if (frame.fd != dialect.fd || frame.length != m.length) {
        return E2eState::kError;
    }
    const E2eState state = dialect.fd ? check_profile5(frame.data, m.length, data_id_of(dialect), check)
                                      : check_profile11(frame.data, m.length, data_id_of(dialect), check);
    if (!usable(state)) {
        return state;
    }
    int bit = protection_bits(dialect);
    for (int i = 0; i < m.signals; ++i) {
        const SignalId id = m.signal[static_cast<std::size_t>(i)];
        const SignalSpec& s = signal_spec(id);
        const std::uint64_t raw = get_bits(frame.data, bit, s.length);
        Received<double>& value = member(signals, id);
        value.valid = raw <= max_raw(s);
        value.value = value.valid ? physical(s, raw) : 0.0;
        bit += s.length;
    }
    return state;
}

bool to_vehicle_motion(const VehicleMotionSignals& signals, std::int64_t time_us, VehicleMotion& motion) {
    if (!signals.speed.valid || !signals.yaw_rate.valid) {
        return false;
    }
    motion = VehicleMotion{};
    motion.time_us = time_us;
    motion.speed = signals.speed.value;
    motion.yaw_rate = signals.yaw_rate.value;
    if (signals.sigma_speed.valid && signals.sigma_speed.value > 0.0) {
        motion.sigma_speed = signals.sigma_speed.value;
    }
    if (signals.sigma_yaw_rate.valid && signals.sigma_yaw_rate.value > 0.0) {
        motion.sigma_yaw_rate = signals.sigma_yaw_rate.value;
    }
    return true;
}

void encode_vehicle_motion(const CanConfig& config, const VehicleMotionSignals& signals, std::uint8_t counter,
                           CanFrame& frame) {
    const DialectSpec& dialect = dialect_spec(config.dialect);
    const MessageSpec& m = dialect.vehicle_motion;
    frame = CanFrame{};
    frame.id = vehicle_motion_id(config);
    frame.extended = config.extended;
    frame.fd = dialect.fd;
    frame.length = m.length;
    VehicleMotionSignals values = signals;
    int bit = protection_bits(dialect);
    for (int i = 0; i < m.signals; ++i) {
        const SignalId id = m.signal[static_cast<std::size_t>(i)];
        const SignalSpec& s = signal_spec(id);
        const Received<double>& value = member(values, id);
        const Quantised q = quantise(s, {value.value, value.valid});
        put_bits(frame.data, bit, s.length, q.saturated ? all_ones(s.length) : q.raw);
        bit += s.length;
    }
    if (dialect.fd) {
        protect_profile5(frame.data, m.length, data_id_of(dialect), counter);
    } else {
        protect_profile11(frame.data, m.length, data_id_of(dialect),
                          static_cast<std::uint8_t>(counter % kProfile11Counters));
    }
}

}  // namespace semtrack
