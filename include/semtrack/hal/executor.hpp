// Spreads independent jobs over worker threads. The core starts no thread: whoever has some lends them.
#ifndef SEMTRACK_HAL_EXECUTOR_HPP
#define SEMTRACK_HAL_EXECUTOR_HPP

namespace semtrack {

class Jobs {
public:
    /// The job's result does not depend on the worker, on its thread or on the order of the jobs.
    virtual void run(int job, int worker) noexcept = 0;

protected:
    ~Jobs() = default;
};

class Executor {
public:
    /// At least 1, the same at every call. The caller's own thread may be one of them.
    [[nodiscard]] virtual int workers() const noexcept = 0;
    /// Calls jobs.run(job, worker) once for each job of 0 ... count - 1, worker in 0 ... workers() - 1, and returns after
    /// the last has ended; what the jobs wrote is then seen by the caller. Two jobs never run on one worker at a time.
    virtual void run(Jobs& jobs, int count) noexcept = 0;

protected:
    ~Executor() = default;
};

}  // namespace semtrack

#endif
