#include "semtrack/tracker.hpp"

#include <new>

#include "math/float_env.hpp"
#include "pipeline/tracker_core.hpp"

namespace semtrack {

static_assert(sizeof(TrackerCore) <= kTrackerBytes, "raise kTrackerBytes: the caller places all of the state");
static_assert(alignof(TrackerCore) <= 64, "the storage of Tracker is aligned to 64 bytes");
static_assert(sizeof(ObjectWorker) <= kWorkerKibibytes * 1024U, "raise kWorkerKibibytes");
static_assert(alignof(ObjectWorker) <= 64, "the storage of WorkerMemory is aligned to 64 bytes");

namespace {

TrackerCore& core_of(std::byte* storage) {
    // MISRA deviation D-01 (C++:2023 8.2.5): the opaque storage keeps Eigen out of the public header.
    return *std::launder(reinterpret_cast<TrackerCore*>(storage));
}

ObjectWorker& worker_of(std::byte* storage) {
    return *std::launder(reinterpret_cast<ObjectWorker*>(storage));  // D-01
}

}  // namespace

WorkerMemory::WorkerMemory() noexcept {
    ::new (static_cast<void*>(storage_)) ObjectWorker();  // D-02
}

WorkerMemory::~WorkerMemory() noexcept {
    worker_of(storage_).~ObjectWorker();
}

Tracker::Tracker() noexcept {
    // MISRA deviation D-02 (C++:2023 21.6.3): placement new, into the caller's own storage; no heap.
    ::new (static_cast<void*>(storage_)) TrackerCore();
}

Tracker::~Tracker() noexcept {
    core_of(storage_).~TrackerCore();
}

Status Tracker::init(const Config& config, const Calibration& calibration, FeatureExtractor* extractor,
                     StageObserver* observer, const ParallelObjects& parallel) noexcept {
    const FloatEnvironment environment;
    ObjectTeam team;
    team.executor = parallel.executor;
    const int more = parallel.memory == nullptr ? 0 : parallel.memory_count;
    for (int i = 0; i < more && i + 1 < kMaxWorkers; ++i) {
        team.more[static_cast<std::size_t>(i)] = &worker_of(parallel.memory[i].storage_);
        team.workers = i + 2;
    }
    return core_of(storage_).init(config, calibration, extractor, observer, team);
}

Status Tracker::process(const Input& input, Output& output) noexcept {
    const FloatEnvironment environment;
    return core_of(storage_).process(input, output);
}

}  // namespace semtrack
