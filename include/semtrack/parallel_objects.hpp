// Optional: objects solved side by side. Given the camera's pose they are independent of each other (paper Sect. 5), so
// the results are the same bytes whatever the number of workers.
#ifndef SEMTRACK_PARALLEL_OBJECTS_HPP
#define SEMTRACK_PARALLEL_OBJECTS_HPP

#include <cstddef>

#include "semtrack/capacity.hpp"
#include "semtrack/hal/executor.hpp"

namespace semtrack {

inline constexpr int kMaxWorkers = 8;

inline namespace SEMTRACK_CAPACITIES {

/// Scratch of one worker beyond the first, whose scratch is in the Tracker. The caller places it; no heap.
/// src/pipeline/tracker.cpp asserts at compile time that it fits.
class WorkerMemory {
public:
    WorkerMemory() noexcept;
    ~WorkerMemory() noexcept;
    WorkerMemory(const WorkerMemory&) = delete;
    WorkerMemory& operator=(const WorkerMemory&) = delete;

private:
    friend class Tracker;
    alignas(64) std::byte storage_[kWorkerKibibytes * 1024U];
};

/// executor null: one after the other, on the caller's thread. Otherwise worker w > 0 works in memory[w - 1], and
/// memory_count is at least executor->workers() - 1. All of it must outlive the tracker.
struct ParallelObjects {
    Executor* executor{nullptr};
    WorkerMemory* memory{nullptr};
    int memory_count{0};
};

}  // namespace SEMTRACK_CAPACITIES
}  // namespace semtrack

#endif
