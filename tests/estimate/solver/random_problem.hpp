// The same random least-squares problem, block by block for NormalEquations and dense in long double.
#ifndef SEMTRACK_TESTS_ESTIMATE_SOLVER_RANDOM_PROBLEM_HPP
#define SEMTRACK_TESTS_ESTIMATE_SOLVER_RANDOM_PROBLEM_HPP

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "estimate/solver/normal_equations.hpp"
#include "math/rng.hpp"
#include "support/dense_system.hpp"

namespace semtrack::test {

inline double symmetric(Rng& rng) {
    return 2.0 * rng.uniform() - 1.0;
}

struct Shape {
    int frames{0};
    int points{0};
    bool shared{false};
    double seen{0.6};  ///< share of (frame, point) pairs that are measured
    Coupling coupling{Coupling::kPose};
};

/// The same random least-squares problem, block by block and dense. Dense order: frames, shared, points.
class RandomProblem {
public:
    RandomProblem(const Shape& shape, std::uint32_t seed)
        : RandomProblem(shape, seed, std::make_unique<NormalEquations>()) {}
    /// In the workspace of another problem, which is gone then.
    RandomProblem(const Shape& shape, std::uint32_t seed, RandomProblem& former)
        : RandomProblem(shape, seed, std::move(former.system_)) {}

private:
    RandomProblem(const Shape& shape, std::uint32_t seed, std::unique_ptr<NormalEquations> workspace)
        : shape_(shape),
          rng_(seed),
          system_(std::move(workspace)),
          dense_(6 * shape.frames + (shape.shared ? 3 : 0) + 3 * shape.points) {
        system_->clear(shape.frames, shape.points, shape.shared, shape.coupling);
        for (int i = 0; i < shape.frames; ++i) {
            add_prior(i);
        }
        for (int i = 0; i + 1 < shape.frames; ++i) {
            add_pair(i, i + 1);
        }
        for (int p = 0; p < shape.points; ++p) {
            for (int i = 0; i < shape.frames; ++i) {
                if (shape.seen > 0.0 && rng_.uniform() < shape.seen) {
                    add_observation(i, p);
                }
            }
        }
    }

public:
    NormalEquations& system() { return *system_; }
    DenseSystem& dense() { return dense_; }
    [[nodiscard]] int at_shared() const { return 6 * shape_.frames; }
    [[nodiscard]] int at_point(int p) const { return at_shared() + (shape_.shared ? 3 : 0) + 3 * p; }

    /// Three rows on frame i and point p.
    void add_observation(int i, int p) {
        Mat3x6 Jf = random<3, 6>();
        for (int c = static_cast<int>(shape_.coupling); c < 6; ++c) {
            Jf.col(c).setZero();
        }
        Mat3 Jp = random<3, 3>();
        const Vec3 r = random<3, 1>();
        system_->add_frame(i, Jf.transpose() * Jf, Jf.transpose() * r);
        system_->add_point(p, Jp.transpose() * Jp, Jp.transpose() * r);
        system_->add_frame_point(i, p, Jf.transpose() * Jp);
        put(6 * i, 6 * i, Mat6(Jf.transpose() * Jf));
        put(at_point(p), at_point(p), Mat3(Jp.transpose() * Jp));
        put_both(6 * i, at_point(p), Mat6x3(Jf.transpose() * Jp));
        put_gradient(6 * i, Vec6(Jf.transpose() * r));
        put_gradient(at_point(p), Vec3(Jp.transpose() * r));
    }
    void put_point_only(int p, const Mat3& H, const Vec3& g) {
        system_->add_point(p, H, g);
        put(at_point(p), at_point(p), H);
        put_gradient(at_point(p), g);
    }

private:
    template <int R, int C>
    Eigen::Matrix<double, R, C> random() {
        Eigen::Matrix<double, R, C> m;
        for (int r = 0; r < R; ++r) {
            for (int c = 0; c < C; ++c) {
                m(r, c) = symmetric(rng_);
            }
        }
        return m;
    }
    template <class M>
    void put(int r0, int c0, const M& m) {
        for (int r = 0; r < m.rows(); ++r) {
            for (int c = 0; c < m.cols(); ++c) {
                dense_.A(r0 + r, c0 + c) += static_cast<long double>(m(r, c));
            }
        }
    }
    template <class M>
    void put_both(int r0, int c0, const M& m) {
        put(r0, c0, m);
        put(c0, r0, m.transpose());
    }
    template <class V>
    void put_gradient(int at, const V& g) {
        for (int r = 0; r < g.size(); ++r) {
            dense_.b(at + r) += static_cast<long double>(g(r));
        }
    }
    void add_prior(int i) {
        const Mat6 J = random<6, 6>();
        const Vec6 r = random<6, 1>();
        system_->add_frame(i, J.transpose() * J, J.transpose() * r);
        put(6 * i, 6 * i, Mat6(J.transpose() * J));
        put_gradient(6 * i, Vec6(J.transpose() * r));
        if (!shape_.shared) {
            return;
        }
        const Mat3x6 Jf = random<3, 6>();
        const Mat3 Js = random<3, 3>();
        const Vec3 q = random<3, 1>();
        system_->add_frame(i, Jf.transpose() * Jf, Jf.transpose() * q);
        system_->add_shared(Js.transpose() * Js, Js.transpose() * q);
        system_->add_frame_shared(i, Jf.transpose() * Js);
        put(6 * i, 6 * i, Mat6(Jf.transpose() * Jf));
        put(at_shared(), at_shared(), Mat3(Js.transpose() * Js));
        put_both(6 * i, at_shared(), Mat6x3(Jf.transpose() * Js));
        put_gradient(6 * i, Vec6(Jf.transpose() * q));
        put_gradient(at_shared(), Vec3(Js.transpose() * q));
    }
    void add_pair(int i, int j) {
        const Mat6 Ji = random<6, 6>();
        const Mat6 Jj = random<6, 6>();
        const Vec6 r = random<6, 1>();
        system_->add_frame(i, Ji.transpose() * Ji, Ji.transpose() * r);
        system_->add_frame(j, Jj.transpose() * Jj, Jj.transpose() * r);
        system_->add_frame_pair(i, j, Ji.transpose() * Jj);
        put(6 * i, 6 * i, Mat6(Ji.transpose() * Ji));
        put(6 * j, 6 * j, Mat6(Jj.transpose() * Jj));
        put_both(6 * i, 6 * j, Mat6(Ji.transpose() * Jj));
        put_gradient(6 * i, Vec6(Ji.transpose() * r));
        put_gradient(6 * j, Vec6(Jj.transpose() * r));
    }

    Shape shape_;
    Rng rng_;
    std::unique_ptr<NormalEquations> system_;
    DenseSystem dense_;
};

/// The step in the dense order.
inline std::vector<long double> flat(const SolverStep& step, const Shape& shape) {
    std::vector<long double> x;
    for (int i = 0; i < shape.frames; ++i) {
        for (int r = 0; r < 6; ++r) {
            x.push_back(static_cast<long double>(step.frame[static_cast<std::size_t>(i)](r)));
        }
    }
    for (int r = 0; shape.shared && r < 3; ++r) {
        x.push_back(static_cast<long double>(step.shared(r)));
    }
    for (int p = 0; p < shape.points; ++p) {
        for (int r = 0; r < 3; ++r) {
            x.push_back(static_cast<long double>(step.point[static_cast<std::size_t>(p)](r)));
        }
    }
    return x;
}

/// Largest difference of the step from the dense solution, relative to the largest entry.
inline double relative_difference(const SolverStep& step, const Shape& shape, const std::vector<long double>& x) {
    const std::vector<long double> mine = flat(step, shape);
    long double worst = 0.0L;
    long double largest = 0.0L;
    for (std::size_t k = 0; k < x.size(); ++k) {
        worst = std::max(worst, std::fabs(mine[k] - x[k]));
        largest = std::max(largest, std::fabs(x[k]));
    }
    return static_cast<double>(worst / largest);
}

}  // namespace semtrack::test

#endif
