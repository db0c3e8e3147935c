// Time, allocations and final cost of the solver on 200 seeded problems, beside Ceres where it is installed: one object
// (10 frames with 100 stereo features each) and the ego window with 500 points. A problem's time is the shortest of
// five runs. All in one run, so that the ratios hold on a noisy machine.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "bench/solver_problems.hpp"
#include "estimate/ego/ego_problem.hpp"
#include "estimate/object/object_problem.hpp"

namespace semtrack::bench {
namespace {

struct Series {
    std::vector<SolveOutcome> outcomes;

    /// quantile 0..1 of a member over the problems.
    [[nodiscard]] double quantile(double SolveOutcome::*member, double q) const {
        std::vector<double> x;
        for (const SolveOutcome& o : outcomes) {
            x.push_back(o.*member);
        }
        std::sort(x.begin(), x.end());
        return x[static_cast<std::size_t>(q * static_cast<double>(x.size() - 1) + 0.5)];
    }
    void print(const char* who) const {
        const double median = quantile(&SolveOutcome::ms, 0.5);
        const double longest = quantile(&SolveOutcome::ms, 1.0);
        long allocations = 0;
        for (const SolveOutcome& o : outcomes) {
            allocations = std::max(allocations, o.allocations);
        }
        std::printf("  %-6s %8.3f %8.3f %8.3f   max/median %5.2f   begin %6.3f   iterations %4.1f   allocations %6ld\n",
                    who, median, quantile(&SolveOutcome::ms, 0.95), longest, longest / median,
                    quantile(&SolveOutcome::begin_ms, 0.5), quantile(&SolveOutcome::iterations, 0.5), allocations);
    }
};

template <class Data>
void compare(const char* what, std::vector<std::unique_ptr<Data>>& problems, const SolveLimits& limits,
             [[maybe_unused]] bool with_peer) {
    std::printf("%s: ms median, p95, max of %zu problems\n", what, problems.size());
    Series ours;
    Series peer;
    std::vector<double> ratio;
    for (const std::unique_ptr<Data>& data : problems) {
        ours.outcomes.push_back(data->solve(limits));
#ifdef SEMTRACK_BENCH_CERES
        if (!with_peer) {
            continue;
        }
        peer.outcomes.push_back(ceres_solve(*data, limits));
        ratio.push_back(ours.outcomes.back().cost / peer.outcomes.back().cost);
        const double start = ours.outcomes.back().cost_start / peer.outcomes.back().cost_start;
        if (start < 1.0 - 1e-9 || start > 1.0 + 1e-9) {
            std::printf("  the problems differ: cost at the start %.12f\n", start);
        }
#endif
    }
    ours.print("ours");
    if (!ratio.empty()) {
        peer.print("Ceres");
        std::sort(ratio.begin(), ratio.end());
        std::printf("  Ceres / ours: %.1f (median time); cost ours / Ceres: median %.5f, min %.5f, max %.5f\n",
                    peer.quantile(&SolveOutcome::ms, 0.5) / ours.quantile(&SolveOutcome::ms, 0.5),
                    ratio[ratio.size() / 2], ratio.front(), ratio.back());
    }
}

template <class Data>
std::vector<std::unique_ptr<Data>> make(int count) {
    std::vector<std::unique_ptr<Data>> out;
    for (int seed = 1; seed <= count; ++seed) {
        out.push_back(std::make_unique<Data>(seed));
    }
    return out;
}

void run(bool object, bool ego, int count, bool with_peer) {
    const SolveLimits five{5, 0.0};
    const SolveLimits converged{50, 1e-6};
    if (object) {
        auto problems = make<ObjectProblemData>(count);
        std::printf("object: %zu frames, %zu points, %zu observations\n", problems[0]->states.size(),
                    problems[0]->points.size(), problems[0]->observations.size());
        compare("object, 5 iterations", problems, five, with_peer);
        compare("object, converged to 1e-6", problems, converged, with_peer);
    }
    if (ego) {
        auto problems = make<EgoProblemData>(count);
        std::printf("ego: %zu frames, %zu points, %zu observations\n", problems[0]->T_c_w.size(),
                    problems[0]->points.size(), problems[0]->observations.size());
        compare("ego window, 5 iterations", problems, five, with_peer);
        compare("ego window, converged to 1e-6", problems, converged, with_peer);
    }
    std::printf("scratch: normal equations %zu KiB, step %zu KiB, object problem %zu KiB, ego problem %zu KiB\n",
                sizeof(NormalEquations) / 1024, sizeof(SolverStep) / 1024, sizeof(ObjectProblem) / 1024,
                sizeof(EgoProblem) / 1024);
}

}  // namespace
}  // namespace semtrack::bench

/// Arguments: object, ego or all; number of problems; alone: without Ceres.
int main(int argc, char** argv) {
    const bool object = argc < 2 || std::strcmp(argv[1], "ego") != 0;
    const bool ego = argc < 2 || std::strcmp(argv[1], "object") != 0;
    const int count = argc > 2 ? std::atoi(argv[2]) : 200;
    if (count < 1) {
        return 1;
    }
    semtrack::bench::run(object, ego, count, argc < 4 || std::strcmp(argv[3], "alone") != 0);
    return 0;
}
