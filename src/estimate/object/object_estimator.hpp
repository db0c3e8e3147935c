// Solves the window of one object: moving and standing hypothesis, the better one stays; covariance of the newest
// state; landmarks born from stereo and culled by their residual.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_ESTIMATOR_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_ESTIMATOR_HPP

#include "estimate/object/object_problem.hpp"
#include "estimate/object/solve_budget.hpp"
#include "estimate/solver/levenberg_marquardt.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

struct ObjectSolveReport {
    bool solved{false};  ///< false: the window was left as it was
    LmReason reason{LmReason::kNoProgress};
    double cost{0};                                           ///< of the chosen hypothesis
    double standing_gain{0};                                  ///< |r|^2 standing minus moving
    StaticVector<std::int16_t, kMaxObjectFeatures> culled{};  ///< slots whose feature is not on the object
};

class ObjectEstimator {
public:
    void init(const Calibration& calibration, const Config& config);

    /// The window's newest frame holds a prediction and the new measurements. After the call: states, size, covariance
    /// and landmarks are updated. Scratch is passed in: one workspace serves ego-motion and all objects.
    /// Cost: two solves of share.iterations, a third one when the heading is in doubt; without trials one, and what
    /// stood goes on standing. An empty window is not solved.
    ObjectSolveReport solve(ObjectWindow& window, NormalEquations& system, SolverStep& step,
                            const SolveShare& share = SolveShare{});

private:
    [[nodiscard]] bool choose_hypothesis(ObjectWindow& window, ObjectSolveReport& report, NormalEquations& system,
                                         SolverStep& step);
    void run(ObjectWindow& window, bool standing, NormalEquations& system, SolverStep& step);
    void try_other_starts(const ObjectWindow& window, bool standing, NormalEquations& system, SolverStep& step);
    void keep_better(const ObjectWindow& window, bool standing, NormalEquations& system, SolverStep& step);
    static void carry_size(ObjectWindow& window);
    static void carry_heading(ObjectWindow& window);
    void cull(const ObjectWindow& window, ObjectSolveReport& report) const;
    void give_birth(ObjectWindow& window) const;

    Calibration calibration_{};
    ObjectProblemOptions options_{};
    ObjectProblem problem_{};
    LmOptions lm_options_{};
    LmReport lm_{};
    ObjectVariables moving_{};  // result of the moving hypothesis, while standing is tried
    ObjectVariables chosen_{};  // the best so far, while another start is tried
    ObjectVariables other_{};   // that start
};

}  // namespace semtrack

#endif
