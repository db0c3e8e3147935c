// One step over the HAL interfaces: read, process, encode, send. The SIL replay and an ECU's daemon run this code.
#ifndef SEMTRACK_CYCLE_HPP
#define SEMTRACK_CYCLE_HPP

#include <cstdint>

#include "semtrack/can_encoder.hpp"
#include "semtrack/hal/can_tx.hpp"
#include "semtrack/hal/clock.hpp"
#include "semtrack/hal/sources.hpp"
#include "semtrack/hal/stage_observer.hpp"
#include "semtrack/tracker.hpp"

namespace semtrack {

/// Who a cycle talks to. stereo is needed; each of the others may be null.
struct CyclePorts {
    StereoSource* stereo{nullptr};
    DetectionSource* detections{nullptr};
    VehicleMotionSource* motion{nullptr};
    EgoPoseSource* ego{nullptr};
    FeatureSource* features{nullptr};
    CanTx* can{nullptr};
    Clock* clock{nullptr};  ///< null: frames are stamped as sent at the image's time
    StageObserver* observer{nullptr};
};

enum class CycleResult : std::uint8_t {
    kProcessed = 0,
    kEnd,         ///< the stereo source has nothing more
    kNoFrame,     ///< nothing new yet
    kSourceError, ///< a source failed; nothing was processed
    kRefused      ///< the tracker refused the input (its state is untouched)
};

/// Only grow.
struct CycleCounters {
    std::uint32_t frames_sent{0};   ///< CAN frames
    std::uint32_t lists_sent{0};    ///< whole lists
    std::uint32_t lists_dropped{0}; ///< the bus was busy or off: the list, or the rest of it, was not sent
};

class Cycle {
public:
    void init(const CyclePorts& ports, const CanConfig& can);
    /// Sets and restores the floating-point environment (round to nearest, no flush to zero) for encoding too. Fills Health::can_*.
    [[nodiscard]] CycleResult step(Tracker& tracker, Output& output) noexcept;
    [[nodiscard]] const CycleCounters& counters() const { return counters_; }
    [[nodiscard]] const CanEncoder& encoder() const { return encoder_; }

private:
    void publish(const Output& output, std::int64_t time_us);

    CyclePorts ports_{};
    CanEncoder encoder_{};
    CanList frames_{};
    StaticVector<DetectionList, kMaxDetectionLists> lists_{};
    ExternalFeatures features_{};
    CycleCounters counters_{};
};

}  // namespace semtrack

#endif
