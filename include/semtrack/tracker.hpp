// The tracker: one object that the caller places, one call per stereo pair.
#ifndef SEMTRACK_TRACKER_HPP
#define SEMTRACK_TRACKER_HPP

#include <cstddef>

#include "semtrack/calibration.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/config.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/hal/stage_observer.hpp"
#include "semtrack/parallel_objects.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// Capacities are part of the Tracker's name: a program and an archive of different ones do not link.
inline namespace SEMTRACK_CAPACITIES {

/// Bytes of a Tracker: all of its state. src/pipeline/tracker.cpp asserts at compile time that it fits;
/// docs/budgets.md has the parts.
inline constexpr std::size_t kTrackerBytes = kTrackerMebibytes * 1024U * 1024U;

/// Ego-motion and object tracking, Li, Qin, Shen (ECCV 2018). No heap, no exception, no clock, no global state:
/// the same calls give the same bytes, whatever the caller's
/// floating-point environment (set and restored). Not thread safe; different Trackers are independent. Place it in static
/// storage: it is too large for a stack.
class Tracker {
public:
    Tracker() noexcept;
    ~Tracker() noexcept;
    Tracker(const Tracker&) = delete;
    Tracker& operator=(const Tracker&) = delete;

    /// (Re)starts from nothing. extractor: used by the orb matcher instead of the native one; observer: told when a
    /// stage begins and ends, on the caller's thread. Both may be null and must outlive the tracker, as what `parallel` names.
    /// kInvalidArgument: a calibration that is not finite, has no focal length, no baseline or an image beyond
    /// capacity.hpp, a configuration out of range, or an executor with more workers than kMaxWorkers or than there is memory for;
    /// process() then refuses to run.
    Status init(const Config& config, const Calibration& calibration, FeatureExtractor* extractor = nullptr,
                StageObserver* observer = nullptr, const ParallelObjects& parallel = {}) noexcept;

    /// One frame. Work is bounded by the capacities; a full one drops and counts (Output::health).
    /// kInvalidArgument: init() has not succeeded, time does not grow, an image whose size is not the calibration's,
    /// a vehicle motion or pose that is not finite; output and state are then untouched.
    Status process(const Input& input, Output& output) noexcept;

private:
    alignas(64) std::byte storage_[kTrackerBytes];
};

}  // namespace SEMTRACK_CAPACITIES
}  // namespace semtrack

#endif
