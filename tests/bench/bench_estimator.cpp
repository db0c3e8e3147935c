// Time of the solver on problems of a fixed size: one object, 10 frames with 100 stereo features each, and the ego
// window, its frames with 500 points. 200 seeded problems each; a problem's time is the shortest of five runs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

#include "estimate/ego/ego_problem.hpp"
#include "estimate/object/object_estimator.hpp"
#include "estimate/object/object_problem.hpp"
#include "tests/estimate/ego/drive_scene.hpp"
#include "tests/estimate/object/object_scene.hpp"

namespace semtrack::bench {
namespace {

constexpr int kProblems = 200;
constexpr int kRuns = 5;
constexpr int kIterations = 5;

using Clock = std::chrono::steady_clock;

/// Milliseconds of problems and what the solver made of them.
struct Times {
    std::vector<double> ms;
    double iterations{0};
    double points{0};

    void report(benchmark::State& state) {
        std::sort(ms.begin(), ms.end());
        state.counters["median_ms"] = ms[ms.size() / 2];
        state.counters["longest_ms"] = ms.back();
        state.counters["iterations"] = iterations / static_cast<double>(ms.size());
        state.counters["points"] = points / static_cast<double>(ms.size());
        state.counters["scratch_KiB"] = static_cast<double>(sizeof(NormalEquations) + sizeof(SolverStep)) / 1024.0;
    }
};

/// Solves from the same start five times. reset: brings the problem there.
template <class Problem, class Reset>
void time_problem(Problem& problem, Reset reset, NormalEquations& system, SolverStep& step, Times& out) {
    LmOptions options;
    options.iterations = kIterations;
    options.relative_decrease = 0.0;  // all of them
    double shortest = 1e9;
    for (int run = 0; run < kRuns; ++run) {
        reset(problem);
        const Clock::time_point begin = Clock::now();
        const LmReport report = levenberg_marquardt(problem, options, system, step);
        shortest = std::min(shortest, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
        out.iterations += run == 0 ? report.iterations : 0;
    }
    out.ms.push_back(shortest);
    out.points += problem.landmarks();
}

/// A car that drives ahead, 25 frames on: the window then has ten.
void object_window(benchmark::State& state) {
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto estimator = std::make_unique<ObjectEstimator>();
    const auto problem = std::make_unique<ObjectProblem>();
    for (auto _ : state) {
        Times times;
        for (int seed = 1; seed <= kProblems; ++seed) {
            ObjectSceneOptions options;
            options.features = 100;
            options.transparent = true;
            options.start.v = 4.0 + 0.02 * seed;
            options.start.p = Vec3(12.0 + 0.05 * seed, -4.0 + 0.04 * seed, -0.9);
            options.seed = static_cast<std::uint32_t>(seed);
            ObjectScene scene(options);
            Config config;
            config.cues.ground = false;
            estimator->init(scene.calibration(), config);
            for (int k = 0; k < 25; ++k) {
                scene.next();
                benchmark::DoNotOptimize(estimator->solve(scene.window(), *system, *step));
            }
            scene.next();
            ObjectProblemOptions what;
            what.cues = config.cues;
            time_problem(
                *problem, [&](ObjectProblem& p) { p.begin(scene.window(), scene.calibration(), what); }, *system, *step,
                times);
        }
        times.report(state);
    }
}
BENCHMARK(object_window)->Name("object, 10 frames x 100 stereo features, 5 iterations")->Iterations(1);

void ego_window(benchmark::State& state) {
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto window = std::make_unique<EgoWindow>();
    const auto problem = std::make_unique<EgoProblem>();
    const auto features = std::make_unique<FrameFeatures>();
    for (auto _ : state) {
        Times times;
        for (int seed = 1; seed <= kProblems; ++seed) {
            DriveOptions options;
            options.features = 500;
            options.seed = static_cast<std::uint32_t>(seed);
            DriveScene scene(options);
            window->clear();
            for (int k = 0; k < 14; ++k) {
                scene.next(*features);
                const int leaving = window->leaving();
                if (leaving >= 0) {
                    window->drop(leaving);
                }
                window->push(static_cast<std::uint32_t>(k + 1), scene.T_w_c().inverse());
                window->take(*features, scene.calibration());
                window->give_birth(scene.calibration());
                window->frames.back().keyframe = true;
            }
            time_problem(
                *problem, [&](EgoProblem& p) { p.begin(*window, scene.calibration()); }, *system, *step, times);
        }
        times.report(state);
    }
}
BENCHMARK(ego_window)->Name("ego window, 500 points, 5 iterations")->Iterations(1);

}  // namespace
}  // namespace semtrack::bench
