// One numeric check for every Jacobian: central differences, perturbed the way the solver perturbs.
#ifndef SEMTRACK_TESTS_SUPPORT_JACOBIAN_CHECK_HPP
#define SEMTRACK_TESTS_SUPPORT_JACOBIAN_CHECK_HPP

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "math/eigen.hpp"

namespace semtrack::test {

/// evaluate(xi) -> std::optional<Eigen::Matrix<double, kRows, 1>>: the residual after the perturbation xi on the
/// manifold (perturbed_left for poses, plus for vectors); nullopt: not defined there.
/// True: every entry of J agrees to tolerance x max(1, largest entry of its row). False and a test failure: it does
/// not. False without failure: the residual is not defined here, the case was not checked (count the checked ones).
template <int kRows, int kColumns, class Evaluate>
[[nodiscard]] bool expect_jacobian(const Eigen::Matrix<double, kRows, kColumns>& J, Evaluate&& evaluate,
                                   double step = 1e-6, double tolerance = 1e-6) {
    using Xi = Eigen::Matrix<double, kColumns, 1>;
    bool good = true;
    for (int c = 0; c < kColumns; ++c) {
        Xi xi = Xi::Zero();
        xi(c) = step;
        const auto plus = evaluate(xi);
        const auto minus = evaluate(Xi(-xi));
        if (!plus.has_value() || !minus.has_value()) {
            return false;
        }
        for (int r = 0; r < kRows; ++r) {
            const double numeric = ((*plus)(r) - (*minus)(r)) / (2.0 * step);
            const double scale = std::fmax(1.0, J.row(r).cwiseAbs().maxCoeff());
            const bool agrees = std::fabs(numeric - J(r, c)) <= tolerance * scale;
            EXPECT_TRUE(agrees) << "row " << r << " column " << c << ": J " << J(r, c) << ", numeric " << numeric;
            good = good && agrees;
        }
    }
    return good;
}

}  // namespace semtrack::test

#endif
