// Who solves the objects: one worker with its own scratch per thread that the executor lends, or the caller alone.
#ifndef SEMTRACK_PIPELINE_OBJECT_TEAM_HPP
#define SEMTRACK_PIPELINE_OBJECT_TEAM_HPP

#include <array>

#include "estimate/object/object_estimator.hpp"
#include "semtrack/parallel_objects.hpp"
#include "semtrack/static_vector.hpp"
#include "track/track_table.hpp"

namespace semtrack {

/// Scratch only: what it holds between two objects changes nothing.
struct ObjectWorker {
    ObjectEstimator estimator{};
    NormalEquations system{};
    SolverStep step{};
};

struct ObjectTeam {
    Executor* executor{nullptr};
    std::array<ObjectWorker*, kMaxWorkers - 1> more{};  // worker w > 0 is more[w - 1]
    int workers{1};                                     // that have scratch

    [[nodiscard]] bool valid() const {
        return executor == nullptr || (executor->workers() >= 1 && executor->workers() <= workers);
    }
    /// The same jobs, the same results, with and without an executor.
    void run(Jobs& jobs, int count) const;
};

/// Job i: the window of the track in slots[i]; its report goes to the slot's place.
class SolveJobs final : public Jobs {
public:
    SolveJobs(const ObjectTeam& team, ObjectWorker& first, const StaticVector<int, kMaxObjects>& slots,
              TrackTable& tracks, std::array<ObjectSolveReport, kMaxObjects>& reports)
        : team_(team), first_(first), slots_(slots), tracks_(tracks), reports_(reports) {}

    /// Sets the floating-point environment of the worker's thread for the job.
    void run(int job, int worker) noexcept override;

private:
    const ObjectTeam& team_;
    ObjectWorker& first_;
    const StaticVector<int, kMaxObjects>& slots_;
    TrackTable& tracks_;
    std::array<ObjectSolveReport, kMaxObjects>& reports_;
};

}  // namespace semtrack

#endif
