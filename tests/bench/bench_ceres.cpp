// The solver's problems in Ceres: the same residuals, kernels and start; DENSE_SCHUR, analytic Jacobians, one thread.
#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/solver_problems.hpp"
#include "sil/heap/counting_malloc.hpp"

namespace semtrack::bench {

namespace {

constexpr int kRuns = 5;
constexpr double kMinDepth_m = 0.1;

/// r and its derivative by the point in the camera, rows of three. false: behind the camera.
bool stereo_residual(const StereoCamera& c, const Observation& o, const double* x_c, double* r, double* J) {
    if (!(x_c[2] >= kMinDepth_m)) {
        return false;
    }
    const double inv_z = 1.0 / x_c[2];
    const double x = x_c[0] * inv_z;
    const double y = x_c[1] * inv_z;
    const double x_right = x - c.baseline_m * inv_z;
    r[0] = o.weight * (c.fx * x + c.cx - o.u);
    r[1] = o.weight * (c.fy * y + c.cy - o.v);
    r[2] = o.weight_right * (c.fx * x_right + c.cx_right - o.u_right);
    if (J != nullptr) {
        const double gx = o.weight * c.fx * inv_z;
        const double gy = o.weight * c.fy * inv_z;
        const double gr = o.weight_right * c.fx * inv_z;
        const std::array<double, 9> values{gx, 0.0, -gx * x, 0.0, gy, -gy * y, gr, 0.0, -gr * x_right};
        std::copy(values.begin(), values.end(), J);
    }
    return true;
}

/// out = J R, 3x3 each, row by row; rows of out lie stride apart.
void product(const double* J, const double* R, double* out, int stride) {
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            out[stride * r + c] = J[3 * r] * R[c] + J[3 * r + 1] * R[3 + c] + J[3 * r + 2] * R[6 + c];
        }
    }
}

class ObjectPoint final : public ceres::SizedCostFunction<3, 6, 3> {
public:
    ObjectPoint(const StereoCamera& camera, const Pose12& T_c_l, const Observation& o)
        : camera_(camera), T_(T_c_l), o_(o) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        const double* const state = x[0];
        const double* const f = x[1];
        const double c = std::cos(state[3]);
        const double s = std::sin(state[3]);
        const std::array<double, 3> turned{c * f[0] - s * f[1], s * f[0] + c * f[1], f[2]};
        std::array<double, 3> x_c{};
        for (std::size_t i = 0; i < 3; ++i) {
            x_c[i] = T_[9 + i];
            for (std::size_t k = 0; k < 3; ++k) {
                x_c[i] += T_[3 * i + k] * (state[k] + turned[k]);
            }
        }
        std::array<double, 9> J_x{};
        if (!stereo_residual(camera_, o_, x_c.data(), r, J != nullptr ? J_x.data() : nullptr)) {
            return false;
        }
        if (J == nullptr) {
            return true;
        }
        std::array<double, 9> J_l{};
        product(J_x.data(), T_.data(), J_l.data(), 3);
        for (std::size_t i = 0; i < 3; ++i) {
            if (J[0] != nullptr) {
                double* const row = J[0] + 6 * i;
                std::copy(&J_l[3 * i], &J_l[3 * i] + 3, row);
                row[3] = -J_l[3 * i] * turned[1] + J_l[3 * i + 1] * turned[0];
                row[4] = row[5] = 0.0;
            }
            if (J[1] != nullptr) {
                double* const row = J[1] + 3 * i;
                row[0] = c * J_l[3 * i] + s * J_l[3 * i + 1];
                row[1] = c * J_l[3 * i + 1] - s * J_l[3 * i];
                row[2] = J_l[3 * i + 2];
            }
        }
        return true;
    }

private:
    StereoCamera camera_;
    Pose12 T_;
    Observation o_;
};

class Motion final : public ceres::SizedCostFunction<6, 6, 6> {
public:
    Motion(const ObjectProblemData& data, int k) : data_(data), k_(k) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        data_.motion(k_, x[0], x[1], r, J != nullptr ? J[0] : nullptr, J != nullptr ? J[1] : nullptr);
        return true;
    }

private:
    const ObjectProblemData& data_;
    int k_;
};

class Edge final : public ceres::SizedCostFunction<1, 6, 3> {
public:
    Edge(const ObjectProblemData& data, int k, int edge) : data_(data), k_(k), edge_(edge) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        return data_.edge(k_, edge_, x[0], x[1], r, J != nullptr ? J[0] : nullptr, J != nullptr ? J[1] : nullptr);
    }

private:
    const ObjectProblemData& data_;
    int k_;
    int edge_;
};

class SizePriorCost final : public ceres::SizedCostFunction<3, 3> {
public:
    explicit SizePriorCost(const ObjectProblemData& data) : data_(data) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        data_.size_prior(x[0], r, J != nullptr ? J[0] : nullptr);
        return true;
    }

private:
    const ObjectProblemData& data_;
};

/// weight times one entry of a state.
class StatePrior final : public ceres::SizedCostFunction<1, 6> {
public:
    StatePrior(int entry, double weight) : entry_(entry), weight_(weight) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        r[0] = weight_ * x[0][entry_];
        if (J != nullptr && J[0] != nullptr) {
            std::fill(J[0], J[0] + 6, 0.0);
            J[0][entry_] = weight_;
        }
        return true;
    }

private:
    int entry_;
    double weight_;
};

/// pose: (R, t); the derivative by its tangent stands in the first six columns, as EgoManifold has it.
class EgoPoint final : public ceres::SizedCostFunction<3, 12, 3> {
public:
    EgoPoint(const StereoCamera& camera, const Observation& o) : camera_(camera), o_(o) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        const double* const T = x[0];
        std::array<double, 3> x_c{};
        for (std::size_t i = 0; i < 3; ++i) {
            x_c[i] = T[9 + i] + T[3 * i] * x[1][0] + T[3 * i + 1] * x[1][1] + T[3 * i + 2] * x[1][2];
        }
        std::array<double, 9> J_x{};
        if (!stereo_residual(camera_, o_, x_c.data(), r, J != nullptr ? J_x.data() : nullptr)) {
            return false;
        }
        for (std::size_t i = 0; J != nullptr && J[0] != nullptr && i < 3; ++i) {
            const double* const a = &J_x[3 * i];
            const std::array<double, 12> row{a[0],
                                             a[1],
                                             a[2],
                                             x_c[1] * a[2] - x_c[2] * a[1],
                                             x_c[2] * a[0] - x_c[0] * a[2],
                                             x_c[0] * a[1] - x_c[1] * a[0]};
            std::copy(row.begin(), row.end(), J[0] + 12 * i);
        }
        if (J != nullptr && J[1] != nullptr) {
            product(J_x.data(), T, J[1], 3);
        }
        return true;
    }

private:
    StereoCamera camera_;
    Observation o_;
};

/// A point seen from a pose that is held.
class HeldPoint final : public ceres::SizedCostFunction<3, 3> {
public:
    HeldPoint(const StereoCamera& camera, const Pose12& T, const Observation& o) : inner_(camera, o), T_(T) {}
    bool Evaluate(const double* const* x, double* r, double** J) const override {
        const std::array<const double*, 2> both{T_.data(), x[0]};
        std::array<double*, 2> derivatives{nullptr, J != nullptr ? J[0] : nullptr};
        return inner_.Evaluate(both.data(), r, J != nullptr ? derivatives.data() : nullptr);
    }

private:
    EgoPoint inner_;
    Pose12 T_;
};

class EgoManifold final : public ceres::Manifold {
public:
    [[nodiscard]] int AmbientSize() const override { return 12; }
    [[nodiscard]] int TangentSize() const override { return 6; }
    bool Plus(const double* x, const double* d, double* out) const override {
        EgoProblemData::perturb(x, d, out);
        return true;
    }
    bool PlusJacobian(const double* /*x*/, double* J) const override {
        std::fill(J, J + 72, 0.0);
        for (int i = 0; i < 6; ++i) {
            J[7 * i] = 1.0;
        }
        return true;
    }
    bool Minus(const double* /*y*/, const double* /*x*/, double* /*out*/) const override { return false; }
    bool MinusJacobian(const double* /*x*/, double* /*J*/) const override { return false; }
};

ceres::Solver::Options options_of(const SolveLimits& limits, ceres::ParameterBlockOrdering* ordering) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.num_threads = 1;
    options.max_num_iterations = limits.iterations;
    options.function_tolerance = limits.tolerance;
    options.gradient_tolerance = 0.0;
    options.parameter_tolerance = 0.0;
    options.logging_type = ceres::SILENT;
    options.linear_solver_ordering.reset(ordering);
    return options;
}

void keep_shortest(const ceres::Solver::Summary& summary, double ms, long allocations, SolveOutcome& out) {
    out.ms = std::min(out.ms, ms);
    out.iterations = static_cast<double>(summary.iterations.size()) - 1.0;
    out.cost_start = summary.initial_cost;
    out.allocations = allocations;
}

}  // namespace

SolveOutcome ceres_solve(const ObjectProblemData& data, const SolveLimits& limits) {
    SolveOutcome out;
    out.ms = 1e9;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<State6> states = data.states;
        std::vector<Point3> points = data.points;
        Point3 size = data.size;
        ceres::Problem problem;
        for (const Observation& o : data.observations) {
            const auto k = static_cast<std::size_t>(o.frame);
            problem.AddResidualBlock(new ObjectPoint(data.camera, data.T_c_l[k], o),
                                     new ceres::HuberLoss(data.feature_huber), states[k].data(),
                                     points[static_cast<std::size_t>(o.point)].data());
        }
        for (int k = 0; k < static_cast<int>(states.size()); ++k) {
            double* const state = states[static_cast<std::size_t>(k)].data();
            for (int e = 0; e < 4; ++e) {
                double r = 0.0;
                if (data.edge(k, e, state, size.data(), &r, nullptr, nullptr)) {
                    problem.AddResidualBlock(new Edge(data, k, e), new ceres::HuberLoss(data.edge_huber), state,
                                             size.data());
                }
            }
            if (k > 0) {
                problem.AddResidualBlock(new Motion(data, k), nullptr, states[static_cast<std::size_t>(k - 1)].data(),
                                         state);
            } else {
                problem.AddResidualBlock(new StatePrior(4, data.speed_weight()), nullptr, state);
            }
            problem.AddResidualBlock(new StatePrior(5, data.steering_weight()), nullptr, state);
        }
        problem.AddResidualBlock(new SizePriorCost(data), nullptr, size.data());
        auto* const ordering = new ceres::ParameterBlockOrdering;
        for (Point3& p : points) {
            ordering->AddElementToGroup(p.data(), 0);
        }
        for (State6& x : states) {
            ordering->AddElementToGroup(x.data(), 1);
        }
        ordering->AddElementToGroup(size.data(), 1);
        const ceres::Solver::Options options = options_of(limits, ordering);
        ceres::Solver::Summary summary;
        const AllocationCounter counter;
        ceres::Solve(options, &problem, &summary);
        keep_shortest(summary, 1e3 * summary.total_time_in_seconds, counter.count(), out);
        out.cost = data.cost_at(states, size, points);
    }
    return out;
}

SolveOutcome ceres_solve(const EgoProblemData& data, const SolveLimits& limits) {
    SolveOutcome out;
    out.ms = 1e9;
    EgoManifold manifold;
    ceres::Problem::Options ownership;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<Pose12> T = data.T_c_w;
        std::vector<Point3> points = data.points;
        ceres::Problem problem(ownership);
        auto* const ordering = new ceres::ParameterBlockOrdering;
        for (std::size_t k = 0; k < T.size(); ++k) {
            if (!data.held[k]) {
                problem.AddParameterBlock(T[k].data(), 12, &manifold);
                ordering->AddElementToGroup(T[k].data(), 1);
            }
        }
        for (const Observation& o : data.observations) {
            const auto k = static_cast<std::size_t>(o.frame);
            double* const x = points[static_cast<std::size_t>(o.point)].data();
            auto* const loss = new ceres::TukeyLoss(data.tukey);
            if (data.held[k]) {
                problem.AddResidualBlock(new HeldPoint(data.camera, data.T_c_w[k], o), loss, x);
            } else {
                problem.AddResidualBlock(new EgoPoint(data.camera, o), loss, T[k].data(), x);
            }
        }
        for (Point3& p : points) {
            ordering->AddElementToGroup(p.data(), 0);
        }
        const ceres::Solver::Options options = options_of(limits, ordering);
        ceres::Solver::Summary summary;
        const AllocationCounter counter;
        ceres::Solve(options, &problem, &summary);
        keep_shortest(summary, 1e3 * summary.total_time_in_seconds, counter.count(), out);
        out.cost = data.cost_at(T, points);
    }
    return out;
}

}  // namespace semtrack::bench
