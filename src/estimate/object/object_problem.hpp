// Dynamic object bundle adjustment, paper Eq. (10) [eq:object-motion2], as a problem for levenberg_marquardt():
//   sum r_Z + r_P + sum r_M + sum r_S (+ ground contact)  over the states of the window, its size and its landmarks.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_PROBLEM_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_PROBLEM_HPP

#include <array>

#include "estimate/factor/box_edges.hpp"
#include "estimate/factor/ground.hpp"
#include "estimate/factor/motion.hpp"
#include "estimate/factor/size_prior.hpp"
#include "estimate/object/object_features.hpp"
#include "estimate/object/object_variables.hpp"
#include "estimate/solver/normal_equations.hpp"
#include "model/object_window.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/config.hpp"

namespace semtrack {

struct ObjectProblemOptions {
    Cues cues{};
    bool standing{false};
    bool hold_heading{false};  ///< what earlier frames said of the heading is a prior of the newest frame's
};

class ObjectProblem {
public:
    /// Looks at the window without changing it; landmarks seen in two frames or more take part.
    void begin(const ObjectWindow& window, const Calibration& calibration, const ObjectProblemOptions& options);
    /// Takes up other variables (of the same window).
    void set(const ObjectVariables& variables) {
        current_ = variables;
        features_current_ = false;
    }
    [[nodiscard]] const ObjectVariables& variables() const { return current_; }
    /// Whether the heading that the window came with is held; begin() says so at first.
    void hold_heading(bool hold) { options_.hold_heading = hold; }
    /// Copies the variables into the window they came from.
    void store(ObjectWindow& window) const;

    double linearise(NormalEquations& system);
    double try_step(const SolverStep& step);
    void accept() {
        current_ = candidate_;
        features_current_ = true;
    }

    /// Squared residual of one observation in sigmas; negative: behind the camera or not observed.
    [[nodiscard]] double feature_residual2(int frame, int slot) const;
    [[nodiscard]] int landmarks() const { return features_.points(); }

private:
    double evaluate(const ObjectVariables& x, NormalEquations* system);
    double add_boxes(const ObjectVariables& x, int k, NormalEquations* system);
    double add_view(const ObjectVariables& x, int k, NormalEquations* system) const;
    double add_ground(const ObjectVariables& x, int k, NormalEquations* system);
    double add_motion(const ObjectVariables& x, int k, NormalEquations* system);
    double add_held_heading(const ObjectVariables& x, NormalEquations* system) const;
    double add_priors(const ObjectVariables& x, NormalEquations* system);
    void choose_outlines();
    [[nodiscard]] Mat3 feature_rotation(const ObjectState& x) const;

    const ObjectWindow* window_{nullptr};
    const Calibration* calibration_{nullptr};
    ObjectProblemOptions options_{};
    MotionModelSpec motion_{};
    SizePrior size_prior_{};
    bool has_heading_{true};
    double held_theta_{0};  // the newest heading that the window came with
    int frames_{0};
    std::array<BoxOutline, kObjectWindow> outlines_{};
    std::array<DetectionView, kObjectWindow> views_{};
    ObjectVariables current_{};
    ObjectVariables candidate_{};
    EdgeResiduals edges_{};
    ObjectFeatures features_{};
    bool features_current_{false};  // features_ was evaluated last at current_
    double features_cost_{0};       // ... with this cost
};

}  // namespace semtrack

#endif
