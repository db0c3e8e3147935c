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
    const auto slot = static_cast<std::size_t>(parts_.slots[job]);
    ObjectWorker& w = worker == 0 ? parts_.first : *parts_.team.more[static_cast<std::size_t>(worker - 1)];
    ObjectWindow& window = parts_.tracks[parts_.slots[job]].window;
    parts_.reports[slot] = w.estimator.solve(window, w.system, w.step, parts_.shares[slot]);
}

}  // namespace semtrack
