// Sliding-window bundle adjustment of the background, paper Eq. (3)-(5) [eq:ego-motion2], for levenberg_marquardt():
//   sum over landmarks and frames of rho(|r_Z|^2), Tukey; landmarks are eliminated. Where the vehicle says how it moved
// between two frames that follow each other, that is a further factor (vehicle_factor.hpp).
// The newest kFreeFrames poses move, the older ones are held: with more of them free the chain of re-estimated motions
// changes its length by 0.1 % from frame to frame, which the newest pose shows as jumps of centimetres.
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_PROBLEM_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_PROBLEM_HPP

#include <array>
#include <cstdint>

#include "estimate/ego/ego_window.hpp"
#include "estimate/solver/normal_equations.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

inline constexpr int kFreeFrames = kPoseFrames;

class EgoProblem {
public:
    /// Landmarks seen in two frames or more, one of them free, take part: at most kSolverPoints, those that the newest
    /// frame sees first. Frames that see too few of them are held as well.
    void begin(const EgoWindow& window, const Calibration& calibration);
    void store(EgoWindow& window) const;

    double linearise(NormalEquations& system) { return evaluate(current_, &system); }
    double try_step(const SolverStep& step);
    void accept() { current_ = candidate_; }

    [[nodiscard]] int free_frames() const { return free_; }
    [[nodiscard]] int landmarks() const { return points_; }
    /// Block of the newest frame in the normal equations; -1: it is held.
    [[nodiscard]] int newest_block() const { return block_[static_cast<std::size_t>(frames_ - 1)]; }

private:
    struct Variables {
        std::array<Pose, kEgoFrames> T_c_w{};
        std::array<Vec3, static_cast<std::size_t>(kSolverPoints)> x_w{};  // by point
    };
    void take_landmarks(bool seen_now, int first_free, std::array<int, kEgoFrames>& seen_by_frame);
    double evaluate(const Variables& x, NormalEquations* system) const;
    double add_vehicle_step(const Variables& x, int k, NormalEquations* system) const;
    double add_observation(const Variables& x, int p, int k, NormalEquations* system) const;
    [[nodiscard]] const EgoObservation& observation(int p, int k) const {
        return window_->seen(landmark_of_point_[static_cast<std::size_t>(p)], window_->frames[k]);
    }

    const EgoWindow* window_{nullptr};
    const Calibration* calibration_{nullptr};
    int frames_{0};
    int free_{0};
    int points_{0};
    std::array<int, kEgoFrames> block_{};  // by frame; -1: held
    std::array<std::int16_t, static_cast<std::size_t>(kSolverPoints)> landmark_of_point_{};
    Variables current_{};
    Variables candidate_{};
};

}  // namespace semtrack

#endif
