// 200 seeded problems for the solver and for a peer: plain numbers, so that a peer with its own Eigen can read them.
#ifndef SEMTRACK_TESTS_BENCH_SOLVER_PROBLEMS_HPP
#define SEMTRACK_TESTS_BENCH_SOLVER_PROBLEMS_HPP

#include <array>
#include <memory>
#include <vector>

namespace semtrack::bench {

/// One iteration limit and one tolerance for both solvers; tolerance 0: all iterations.
struct SolveLimits {
    int iterations{5};
    double tolerance{0};
};

struct SolveOutcome {
    double ms{0};        ///< shortest run
    double begin_ms{0};  ///< of it: setting the problem up from the window, not in ms
    double iterations{0};
    double cost_start{0};  ///< both solvers' by the same function
    double cost{0};
    long allocations{0};
};

/// A stereo observation: left column and row, right column, 1 / sigma of the left and the right.
struct Observation {
    int frame{0};
    int point{0};
    double u{0}, v{0}, u_right{0}, weight{0}, weight_right{0};
};

struct StereoCamera {
    double fx{0}, fy{0}, cx{0}, cy{0}, cx_right{0}, baseline_m{0};
};

using State6 = std::array<double, 6>;  // p, theta, v, delta
using Point3 = std::array<double, 3>;
/// Rotation row by row, then translation.
using Pose12 = std::array<double, 12>;

/// A car's window: 10 frames with 100 stereo features, boxes, motion, size prior.
class ObjectProblemData {
public:
    explicit ObjectProblemData(int seed);
    ~ObjectProblemData();
    [[nodiscard]] SolveOutcome solve(const SolveLimits& limits);

    // What a peer needs. Residuals beside the features are the library's own; rows of J follow the parameters.
    StereoCamera camera;
    double feature_huber{0}, edge_huber{0};
    std::vector<State6> states;
    Point3 size{};
    std::vector<Point3> points;
    std::vector<Pose12> T_c_l;
    std::vector<Observation> observations;
    /// r 6, J_before and J_after 6x6 (row by row; null: not wanted); k >= 1.
    void motion(int k, const double* before, const double* after, double* r, double* J_before, double* J_after) const;
    /// false: the edge is not there. J_state 6, J_size 3.
    [[nodiscard]] bool edge(int k, int edge, const double* state, const double* size, double* r, double* J_state,
                            double* J_size) const;
    /// Square roots of the priors' information: r 3 of the size, r 1 of speed (oldest) and steering.
    void size_prior(const double* size, double* r, double* J) const;
    [[nodiscard]] double speed_weight() const;
    [[nodiscard]] double steering_weight() const;
    /// The library's cost at a peer's solution.
    [[nodiscard]] double cost_at(const std::vector<State6>& x, const Point3& d, const std::vector<Point3>& f) const;

private:
    struct Inner;
    std::unique_ptr<Inner> inner_;
};

/// The ego window with 500 points.
class EgoProblemData {
public:
    explicit EgoProblemData(int seed);
    ~EgoProblemData();
    [[nodiscard]] SolveOutcome solve(const SolveLimits& limits);

    StereoCamera camera;
    double tukey{0};
    std::vector<Pose12> T_c_w;
    std::vector<bool> held;
    std::vector<Point3> points;
    std::vector<Observation> observations;
    /// T moved by (t, w) as the library does.
    static void perturb(const double* T, const double* xi, double* out);
    [[nodiscard]] double cost_at(const std::vector<Pose12>& T, const std::vector<Point3>& x) const;

private:
    struct Inner;
    std::unique_ptr<Inner> inner_;
};

/// Ceres on the same problems; built only where it is installed.
[[nodiscard]] SolveOutcome ceres_solve(const ObjectProblemData& data, const SolveLimits& limits);
[[nodiscard]] SolveOutcome ceres_solve(const EgoProblemData& data, const SolveLimits& limits);

}  // namespace semtrack::bench

#endif
