// Who solves the objects: one worker with its own scratch per thread that the executor lends, or the caller alone.
#ifndef SEMTRACK_PIPELINE_OBJECT_TEAM_HPP
#define SEMTRACK_PIPELINE_OBJECT_TEAM_HPP

#include <array>

#include "estimate/object/object_estimator.hpp"
#include "estimate/object/solve_budget.hpp"
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

/// Job i: the window of the track in slots[i], with the slot's share; its report goes to the slot's place.
class SolveJobs final : public Jobs {
public:
    struct Parts {
        const ObjectTeam& team;
        ObjectWorker& first;
        const StaticVector<int, kMaxObjects>& slots;
        const SolveShares& shares;
        TrackTable& tracks;
        std::array<ObjectSolveReport, kMaxObjects>& reports;
    };
    explicit SolveJobs(const Parts& parts) : parts_(parts) {}

    /// Sets the floating-point environment of the worker's thread for the job.
    void run(int job, int worker) noexcept override;

private:
    Parts parts_;
};

}  // namespace semtrack

#endif
