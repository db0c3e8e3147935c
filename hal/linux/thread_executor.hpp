// An Executor on POSIX threads: a fixed set, started once, asleep between two runs.
#ifndef SEMTRACK_HAL_LINUX_THREAD_EXECUTOR_HPP
#define SEMTRACK_HAL_LINUX_THREAD_EXECUTOR_HPP

#include <pthread.h>

#include <array>
#include <cstdint>

#include "semtrack/hal/executor.hpp"
#include "semtrack/parallel_objects.hpp"

namespace semtrack::hal {

/// Worker 0 is the caller of run(). A worker takes the next job that nobody has taken: long jobs do not hold up short
/// ones. No heap of its own; the threads' stacks are made by start(). run() is for one caller at a time.
class ThreadExecutor final : public Executor {
public:
    ThreadExecutor() noexcept;
    ~ThreadExecutor() noexcept;  ///< ends the threads
    ThreadExecutor(const ThreadExecutor&) = delete;
    ThreadExecutor& operator=(const ThreadExecutor&) = delete;

    /// Once, before the tracker's init(): workers - 1 threads of the caller's priority and mask of cores. False:
    /// workers is not in 1 ... kMaxWorkers, the system gave no thread (the object then has one worker, and works), or
    /// it was started before.
    [[nodiscard]] bool start(int workers) noexcept;
    [[nodiscard]] int workers() const noexcept override { return workers_; }
    void run(Jobs& jobs, int count) noexcept override;

private:
    struct Seat {
        ThreadExecutor* owner{nullptr};
        int worker{0};
        pthread_t thread{};
    };
    static void* entry(void* seat) noexcept;
    void work(int worker) noexcept;
    void take_jobs(int worker) noexcept;
    void stop() noexcept;

    std::array<Seat, kMaxWorkers> seats_{};  // seat 0 stays empty
    int workers_{1};
    pthread_mutex_t mutex_{};
    pthread_cond_t begun_{};
    pthread_cond_t ended_{};
    // All below: under mutex_.
    Jobs* jobs_{nullptr};
    int count_{0};
    int next_{0};            // job that nobody has taken
    int busy_{0};            // threads that have not ended this run
    std::uint64_t round_{0};  // of run()
    bool stopping_{false};
};

}  // namespace semtrack::hal

#endif
