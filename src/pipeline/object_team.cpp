#include "pipeline/object_team.hpp"

#include "math/float_env.hpp"

namespace semtrack {

void ObjectTeam::run(Jobs& jobs, int count) const {
    if (executor != nullptr) {
        executor->run(jobs, count);
        return;
    }
    for (int job = 0; job < count; ++job) {
        jobs.run(job, 0);
    }
}

void SolveJobs::run(int job, int worker) noexcept {
    const FloatEnvironment environment;
    ObjectWorker& w = worker == 0 ? first_ : *team_.more[static_cast<std::size_t>(worker - 1)];
    const int slot = slots_[job];
    reports_[static_cast<std::size_t>(slot)] = w.estimator.solve(tracks_[slot].window, w.system, w.step);
}

}  // namespace semtrack
