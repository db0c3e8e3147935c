// Levenberg-Marquardt with a fixed number of iterations. The problem keeps its current and its candidate state.
#ifndef SEMTRACK_ESTIMATE_SOLVER_LEVENBERG_MARQUARDT_HPP
#define SEMTRACK_ESTIMATE_SOLVER_LEVENBERG_MARQUARDT_HPP

#include <cstdint>

#include "estimate/solver/normal_equations.hpp"

namespace semtrack {

struct LmOptions {
    int iterations{5};  ///< linearisations and solves, together with rejected steps
    double initial_lambda{1e-4};
    double lambda_up{10.0};
    double lambda_down{0.1};
    double min_lambda{1e-10};
    double max_lambda{1e8};
    double relative_decrease{1e-6};  ///< stop when a step lowers the cost by less
};

enum class LmReason : std::uint8_t {
    kConverged = 0,  ///< the last accepted step lowered the cost by less than relative_decrease
    kIterations,     ///< all iterations used; the best state is held
    kNoProgress,     ///< no step lowered the cost; the start is held
    kNotObservable,  ///< no lambda up to max_lambda made the system positive definite
    kInvalidCost     ///< the cost at the start is not finite
};

struct LmReport {
    LmReason reason{LmReason::kNoProgress};
    int iterations{0};
    int accepted{0};
    double initial_cost{0};
    double final_cost{0};
};

/// Problem needs:
///   double linearise(NormalEquations& system);   clears and fills the system at the current state; returns the cost
///   double try_step(const SolverStep& step);     builds the candidate; returns its cost (not finite: refused)
///   void accept();                               the candidate becomes the current state
/// The cost is 0.5 sum of robustified squares; the state held at return is the best one seen.
template <class Problem>
[[nodiscard]] LmReport levenberg_marquardt(Problem& problem, const LmOptions& options, NormalEquations& system,
                                           SolverStep& step) {
    LmReport report;
    double lambda = options.initial_lambda;
    double cost = problem.linearise(system);
    report.initial_cost = cost;
    report.final_cost = cost;
    if (!(cost < 1e300)) {
        report.reason = LmReason::kInvalidCost;
        return report;
    }
    bool solved = false;
    report.reason = LmReason::kNoProgress;
    for (int k = 0; k < options.iterations; ++k) {
        ++report.iterations;
        if (system.solve(lambda, step) != Status::kOk) {
            lambda = lambda * options.lambda_up > options.max_lambda ? options.max_lambda : lambda * options.lambda_up;
            continue;
        }
        solved = true;
        const double candidate = problem.try_step(step);
        if (!(candidate < cost)) {
            lambda = lambda * options.lambda_up > options.max_lambda ? options.max_lambda : lambda * options.lambda_up;
            continue;
        }
        problem.accept();
        ++report.accepted;
        const double decrease = cost - candidate;
        const bool small = decrease < options.relative_decrease * cost;
        cost = candidate;
        report.final_cost = cost;
        report.reason = LmReason::kIterations;
        lambda = lambda * options.lambda_down < options.min_lambda ? options.min_lambda : lambda * options.lambda_down;
        if (small) {
            report.reason = LmReason::kConverged;
            break;
        }
        if (k + 1 < options.iterations) {
            (void)problem.linearise(system);
        }
    }
    if (!solved) {
        report.reason = LmReason::kNotObservable;
    }
    return report;
}

}  // namespace semtrack

#endif
