// Threads for the tracker's objects (replay --workers), with the memory that they work in.
#ifndef SEMTRACK_SIL_OBJECT_WORKERS_HPP
#define SEMTRACK_SIL_OBJECT_WORKERS_HPP

#include <memory>
#include <string>

#ifdef SEMTRACK_HAS_LINUX
#include "hal/linux/thread_executor.hpp"
#endif
#include "semtrack/parallel_objects.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

class ObjectWorkers {
public:
    /// 1: no thread. Throws InputError where there are no threads to be had.
    explicit ObjectWorkers(int workers) {
        if (workers == 1) {
            return;
        }
#ifdef SEMTRACK_HAS_LINUX
        executor_ = std::make_unique<hal::ThreadExecutor>();
        if (executor_->start(workers)) {
            memory_ = std::make_unique<WorkerMemory[]>(static_cast<std::size_t>(workers - 1));
            parallel_ = {executor_.get(), memory_.get(), workers - 1};
            return;
        }
#endif
        throw InputError("--workers " + std::to_string(workers) + ": no threads to be had");
    }
    [[nodiscard]] const ParallelObjects& parallel() const { return parallel_; }

private:
#ifdef SEMTRACK_HAS_LINUX
    std::unique_ptr<hal::ThreadExecutor> executor_;
#endif
    std::unique_ptr<WorkerMemory[]> memory_;
    ParallelObjects parallel_{};
};

}  // namespace semtrack::sil

#endif
