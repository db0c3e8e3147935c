#include "semtrack/cycle.hpp"

#include "math/float_env.hpp"

namespace semtrack {

namespace {

/// Not asked: no such source. kError stops the cycle; anything else but kOk means that there is nothing.
template <class Source, class Item>
bool poll(Source* source, std::int64_t now_us, Item& item, bool& failed) {
    if (source == nullptr) {
        return false;
    }
    const SourceResult result = source->poll(now_us, item);
    failed = failed || result == SourceResult::kError;
    return result == SourceResult::kOk;
}

}  // namespace

void Cycle::init(const CyclePorts& ports, const CanConfig& can) {
    ports_ = ports;
    encoder_.init(can);
    frames_.clear();
    lists_.clear();
    counters_ = CycleCounters{};
}

CycleResult Cycle::step(Tracker& tracker, Output& output) noexcept {
    const FloatEnvironment environment;
    if (ports_.stereo == nullptr) {
        return CycleResult::kSourceError;
    }
    StereoFrame frame;
    switch (ports_.stereo->next(frame)) {
        case SourceResult::kOk:
            break;
        case SourceResult::kNone:
            return CycleResult::kNoFrame;
        case SourceResult::kEnd:
            return CycleResult::kEnd;
        case SourceResult::kError:
            return CycleResult::kSourceError;
    }
    Input input;
    input.time_us = frame.time_us;
    input.left = frame.left;
    input.right = frame.right;
    VehicleMotion motion;
    RigidTransform T_w_v;
    bool failed = false;
    lists_.clear();
    input.detections = poll(ports_.detections, frame.time_us, lists_, failed) ? &lists_ : nullptr;
    input.motion = poll(ports_.motion, frame.time_us, motion, failed) ? &motion : nullptr;
    input.T_w_v = poll(ports_.ego, frame.time_us, T_w_v, failed) ? &T_w_v : nullptr;
    features_.clear();
    input.features = poll(ports_.features, frame.time_us, features_, failed) ? &features_ : nullptr;
    if (failed) {
        return CycleResult::kSourceError;
    }
    if (tracker.process(input, output) != Status::kOk) {
        return CycleResult::kRefused;
    }
    if (ports_.can != nullptr) {
        output.health.can_state = ports_.can->state();
        output.health.can_lists_dropped = counters_.lists_dropped + ports_.can->lists_lost();
        publish(output, frame.time_us);
    }
    return CycleResult::kProcessed;
}

void Cycle::publish(const Output& output, std::int64_t time_us) {
    if (ports_.observer != nullptr) {
        ports_.observer->begin(Stage::kEncode);
    }
    const std::int64_t now_us = ports_.clock != nullptr ? ports_.clock->now_us() : time_us;
    // kCapacity: objects were left out; the header counts them and the list is whole all the same.
    const Status encoded = encoder_.encode(output, now_us, frames_);
    if (ports_.observer != nullptr) {
        ports_.observer->end(Stage::kEncode);
    }
    if (encoded != Status::kOk && encoded != Status::kCapacity) {
        ++counters_.lists_dropped;
        return;
    }
    if (ports_.can->begin_list(frames_.size(), time_us) != CanTx::Result::kSent) {
        ++counters_.lists_dropped;
        return;
    }
    for (const CanFrame& frame : frames_) {
        // A receiver drops a list that is not whole, so the rest of it would only load the bus.
        if (ports_.can->send(frame, time_us) != CanTx::Result::kSent) {
            ++counters_.lists_dropped;
            return;
        }
        ++counters_.frames_sent;
    }
    ++counters_.lists_sent;
}

}  // namespace semtrack
