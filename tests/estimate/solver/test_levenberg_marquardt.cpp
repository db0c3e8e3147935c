#include "estimate/solver/levenberg_marquardt.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

namespace semtrack {
namespace {

constexpr double kFloor = 0.01;  // cost that no step removes: without it no decrease is ever small

/// Rosenbrock's valley in the first two parameters of one frame, the others pulled to zero.
class Valley {
public:
    explicit Valley(double x, double y) {
        x_.setZero();
        x_(0) = x;
        x_(1) = y;
    }
    double linearise(NormalEquations& system) {
        ++linearised;
        system.clear(1, 0, false);
        Mat6 J = Mat6::Identity();
        J(0, 0) = -20.0 * x_(0);
        J(0, 1) = 10.0;
        J(1, 0) = -1.0;
        J(1, 1) = 0.0;
        const Vec6 r = residual(x_);
        system.add_frame(0, J.transpose() * J, J.transpose() * r);
        return kFloor + 0.5 * r.dot(r);
    }
    double try_step(const SolverStep& step) {
        candidate_ = x_ + step.frame[0];
        const Vec6 r = residual(candidate_);
        return kFloor + 0.5 * r.dot(r);
    }
    void accept() { x_ = candidate_; }

    int linearised{0};
    Vec6 x_;

private:
    static Vec6 residual(const Vec6& x) {
        Vec6 r = x;
        r(0) = 10.0 * (x(1) - x(0) * x(0));
        r(1) = 1.0 - x(0);
        return r;
    }
    Vec6 candidate_{Vec6::Zero()};
};

/// Says what it is told to: costs of the candidates, and whether its matrix can be factored.
struct Scripted {
    double start{1.0};
    double candidate{0.5};
    Mat6 H{Mat6::Identity()};
    int accepted{0};
    double linearise(NormalEquations& system) {
        system.clear(1, 0, false);
        system.add_frame(0, H, Vec6::Ones());
        return start;
    }
    [[nodiscard]] double try_step(const SolverStep&) const { return candidate; }
    void accept() { ++accepted; }
};

struct Workspace {
    std::unique_ptr<NormalEquations> system{std::make_unique<NormalEquations>()};
    std::unique_ptr<SolverStep> step{std::make_unique<SolverStep>()};
};

TEST(LevenbergMarquardt, FollowsACurvedValleyToItsMinimum) {
    Workspace w;
    Valley valley(-1.2, 1.0);
    LmOptions options;
    options.iterations = 60;
    const LmReport report = levenberg_marquardt(valley, options, *w.system, *w.step);
    EXPECT_EQ(report.reason, LmReason::kConverged);
    EXPECT_LT(report.final_cost, kFloor + 1e-9);
    EXPECT_NEAR(valley.x_(0), 1.0, 1e-5);
    EXPECT_NEAR(valley.x_(1), 1.0, 1e-5);
    EXPECT_NEAR(report.initial_cost, kFloor + 0.5 * (4.4 * 4.4 + 2.2 * 2.2), 1e-9);
}

TEST(LevenbergMarquardt, UsesNoMoreIterationsThanItMayAndHoldsTheBestState) {
    Workspace w;
    Valley valley(-1.2, 1.0);
    LmOptions options;
    options.iterations = 3;
    const LmReport report = levenberg_marquardt(valley, options, *w.system, *w.step);
    EXPECT_EQ(report.iterations, 3);
    EXPECT_LE(valley.linearised, 3);
    Valley at_end(valley.x_(0), valley.x_(1));
    EXPECT_EQ(at_end.linearise(*w.system), report.final_cost);
}

TEST(LevenbergMarquardt, AStepThatDoesNotLowerTheCostIsNotTaken) {
    Workspace w;
    for (const double cost : {1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
        Scripted problem;
        problem.candidate = cost;
        const LmReport report = levenberg_marquardt(problem, LmOptions{}, *w.system, *w.step);
        EXPECT_EQ(report.reason, LmReason::kNoProgress);
        EXPECT_EQ(problem.accepted, 0);
        EXPECT_EQ(report.final_cost, report.initial_cost);
    }
}

TEST(LevenbergMarquardt, AFailedFactorisationRaisesLambdaUntilTheMatrixIsPositiveDefinite) {
    Workspace w;
    Scripted problem;
    problem.H(0, 1) = problem.H(1, 0) = 1.05;  // needs lambda above 0.05
    LmOptions options;
    options.iterations = 6;
    const LmReport report = levenberg_marquardt(problem, options, *w.system, *w.step);
    EXPECT_GE(problem.accepted, 1);
    EXPECT_GE(report.iterations, 4) << "lambda starts at 1e-4";
}

/// Costs by script, one per candidate.
struct Sequence {
    std::vector<double> candidates;
    std::size_t at{0};
    double current{1.0};
    double best{1.0};
    int linearised{0};
    std::vector<double> steps;  // of the first parameter: smaller as lambda grows
    double linearise(NormalEquations& system) {
        ++linearised;
        system.clear(1, 0, false);
        system.add_frame(0, Mat6::Identity(), Vec6::Ones());
        return current;
    }
    double try_step(const SolverStep& step) {
        steps.push_back(step.frame[0](0));
        return candidates[at++];
    }
    void accept() {
        current = candidates[at - 1];
        best = current < best ? current : best;
    }
};

TEST(LevenbergMarquardt, ARefusedStepRaisesLambdaWithoutAnotherLinearisationAndTheBestStateIsHeld) {
    Workspace w;
    Sequence problem;
    problem.candidates = {0.5, 0.9, 0.8, 0.4, 0.6};
    LmOptions options;
    options.initial_lambda = 0.1;
    const LmReport report = levenberg_marquardt(problem, options, *w.system, *w.step);
    EXPECT_EQ(report.reason, LmReason::kIterations);
    EXPECT_EQ(report.accepted, 2);
    EXPECT_EQ(report.iterations, 5);
    EXPECT_EQ(report.final_cost, 0.4);
    EXPECT_EQ(problem.current, 0.4);
    EXPECT_EQ(problem.best, 0.4);
    EXPECT_EQ(problem.linearised, 3) << "at the start and after each accepted step";
    ASSERT_EQ(problem.steps.size(), 5U);
    const std::vector<double> lambda{0.1, 0.01, 0.1, 1.0, 0.1};  // down when accepted, up when refused
    for (std::size_t k = 0; k < lambda.size(); ++k) {
        EXPECT_NEAR(problem.steps[k], -1.0 / (1.0 + lambda[k]), 1e-12) << k;
    }
}

TEST(LevenbergMarquardt, EveryReasonIsReachedAndThereIsNoOther) {
    Workspace w;
    std::vector<int> reached(5, 0);
    const auto note = [&](const LmReport& report) {
        ASSERT_LT(static_cast<std::size_t>(report.reason), reached.size());
        ++reached[static_cast<std::size_t>(report.reason)];
    };
    Sequence converging;
    converging.candidates = {0.5, 0.5 - 1e-9};
    note(levenberg_marquardt(converging, LmOptions{}, *w.system, *w.step));
    Sequence running;
    running.candidates = {0.5, 0.4, 0.3, 0.2, 0.1};
    note(levenberg_marquardt(running, LmOptions{}, *w.system, *w.step));
    Sequence stuck;
    stuck.candidates = {2.0, 2.0, 2.0, 2.0, 2.0};
    note(levenberg_marquardt(stuck, LmOptions{}, *w.system, *w.step));
    Scripted singular;
    singular.H.setZero();
    note(levenberg_marquardt(singular, LmOptions{}, *w.system, *w.step));
    Scripted invalid;
    invalid.start = std::numeric_limits<double>::quiet_NaN();
    note(levenberg_marquardt(invalid, LmOptions{}, *w.system, *w.step));
    EXPECT_EQ(reached, std::vector<int>(5, 1));
    EXPECT_EQ(static_cast<int>(LmReason::kInvalidCost), 4) << "the last one";
}

TEST(LevenbergMarquardt, AMatrixThatNoLambdaMendsIsNotObservable) {
    Workspace w;
    Scripted problem;
    problem.H.setZero();
    const LmReport report = levenberg_marquardt(problem, LmOptions{}, *w.system, *w.step);
    EXPECT_EQ(report.reason, LmReason::kNotObservable);
    EXPECT_EQ(problem.accepted, 0);
}

TEST(LevenbergMarquardt, ACostThatIsNotFiniteEndsItBeforeTheFirstStep) {
    Workspace w;
    for (const double cost : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Scripted problem;
        problem.start = cost;
        const LmReport report = levenberg_marquardt(problem, LmOptions{}, *w.system, *w.step);
        EXPECT_EQ(report.reason, LmReason::kInvalidCost);
        EXPECT_EQ(report.iterations, 0);
        EXPECT_EQ(problem.accepted, 0);
    }
}

}  // namespace
}  // namespace semtrack
