// Sliding-window bundle adjustment of the background, paper Eq. (3)-(5) [eq:ego-motion2], for levenberg_marquardt():
//   sum over landmarks and frames of rho(|r_Z|^2); the oldest frames are held, landmarks are eliminated.
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_PROBLEM_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_PROBLEM_HPP

#include <array>

#include "estimate/ego/ego_window.hpp"
#include "estimate/solver/normal_equations.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

class EgoProblem {
public:
    /// Landmarks seen in two frames or more take part.
    void begin(const EgoWindow& window, const Calibration& calibration);
    void store(EgoWindow& window) const;

    double linearise(NormalEquations& system) { return evaluate(current_, &system); }
    double try_step(const SolverStep& step);
    void accept() { current_ = candidate_; }

    [[nodiscard]] int free_frames() const { return frames_ - fixed_; }
    [[nodiscard]] int landmarks() const { return points_; }

private:
    struct Variables {
        std::array<Pose, kEgoFrames> T_c_w{};
        std::array<Vec3, kMaxBackgroundFeatures> x_w{};  // by point
    };
    double evaluate(const Variables& x, NormalEquations* system) const;

    const EgoWindow* window_{nullptr};
    const Calibration* calibration_{nullptr};
    int frames_{0};
    int fixed_{0};
    int points_{0};
    std::array<std::int16_t, kMaxBackgroundFeatures> slot_of_point_{};
    Variables current_{};
    Variables candidate_{};
};

}  // namespace semtrack

#endif
