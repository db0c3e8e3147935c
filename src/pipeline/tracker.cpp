#include "semtrack/tracker.hpp"

#include <new>

#include "pipeline/tracker_core.hpp"

namespace semtrack {

static_assert(sizeof(TrackerCore) <= kTrackerBytes, "raise kTrackerBytes: the caller places all of the state");
static_assert(alignof(TrackerCore) <= 64, "the storage of Tracker is aligned to 64 bytes");

namespace {

TrackerCore& core_of(std::byte* storage) {
    // MISRA deviation D-01 (C++:2023 8.2.5): the opaque storage keeps Eigen out of the public header.
    return *std::launder(reinterpret_cast<TrackerCore*>(storage));
}

}  // namespace

Tracker::Tracker() noexcept {
    // MISRA deviation D-02 (C++:2023 21.6.3): placement new, into the caller's own storage; no heap.
    ::new (static_cast<void*>(storage_)) TrackerCore();
}

Tracker::~Tracker() noexcept {
    core_of(storage_).~TrackerCore();
}

Status Tracker::init(const Config& config, const Calibration& calibration, FeatureExtractor* extractor,
                     StageObserver* observer) noexcept {
    return core_of(storage_).init(config, calibration, extractor, observer);
}

Status Tracker::process(const Input& input, Output& output) noexcept {
    return core_of(storage_).process(input, output);
}

}  // namespace semtrack
