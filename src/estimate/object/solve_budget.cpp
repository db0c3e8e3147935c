#include "estimate/object/solve_budget.hpp"

namespace semtrack {

namespace {

constexpr int kBesidePoints = 48;  // boxes, motion and the reduced system of one frame cost as much as so many points
constexpr int kBudget = 229000;    // of a frame, all objects
constexpr int kTrialReserve = 26000;  // of it: two full objects' trials, so that everybody's turn comes
constexpr int kBesideIterations = 1;  // the covariance costs as much as one
constexpr int kTrialSolves = 2;       // standing, and one other start
constexpr int kTurn = 2;              // slots that the turn moves on a frame

}  // namespace

int iteration_work(const ObjectWindow& window) {
    int points = 0;
    for (const ObjectLandmark& landmark : window.landmarks) {
        points += landmark.valid ? 1 : 0;
    }
    return window.frames.size() * (points + kBesidePoints);
}

int share_out(const SolveWork& work, std::uint32_t frame, SolveShares& out) {
    int one_iteration = 0;
    for (const int w : work) {
        one_iteration += w;
    }
    int iterations =
        one_iteration > 0 ? (kBudget - kTrialReserve) / one_iteration - kBesideIterations : kObjectIterations;
    iterations = iterations < kLeastObjectIterations ? kLeastObjectIterations : iterations;
    iterations = iterations > kObjectIterations ? kObjectIterations : iterations;
    int left = kBudget - (iterations + kBesideIterations) * one_iteration;
    int cut = 0;
    const int first = static_cast<int>(frame % static_cast<std::uint32_t>(kMaxObjects)) * kTurn % kMaxObjects;
    for (int n = 0; n < kMaxObjects; ++n) {
        const auto slot = static_cast<std::size_t>((first + n) % kMaxObjects);
        const int trials = kTrialSolves * iterations * work[slot];
        out[slot].iterations = iterations;
        out[slot].trials = trials <= left;
        left -= out[slot].trials ? trials : 0;
        cut += work[slot] > 0 && (iterations < kObjectIterations || !out[slot].trials) ? 1 : 0;
    }
    return cut;
}

}  // namespace semtrack
