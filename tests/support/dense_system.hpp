// Dense symmetric systems in long double: the reference for everything that is solved block by block.
#ifndef SEMTRACK_TESTS_SUPPORT_DENSE_SYSTEM_HPP
#define SEMTRACK_TESTS_SUPPORT_DENSE_SYSTEM_HPP

#include <cmath>
#include <cstddef>
#include <vector>

namespace semtrack::test {

class DenseSystem {
public:
    explicit DenseSystem(int n) : n_(n), a_(static_cast<std::size_t>(n * n), 0.0L), b_(static_cast<std::size_t>(n)) {}
    [[nodiscard]] int size() const { return n_; }
    [[nodiscard]] long double& A(int r, int c) { return a_[static_cast<std::size_t>(r * n_ + c)]; }
    [[nodiscard]] long double& b(int r) { return b_[static_cast<std::size_t>(r)]; }

    /// x of (A + lambda diag A) x = -b by Cholesky; empty: not positive definite.
    [[nodiscard]] std::vector<long double> solve(long double lambda) {
        if (!factor(lambda)) {
            return {};
        }
        std::vector<long double> x(b_);
        for (long double& value : x) {
            value = -value;
        }
        return substitute(x);
    }
    /// Largest entry of (A + lambda diag A) x + b: for systems that are too large to be solved again here.
    [[nodiscard]] long double residual(long double lambda, const std::vector<long double>& x) {
        long double worst = 0.0L;
        for (int r = 0; r < n_; ++r) {
            long double sum = b(r) + lambda * A(r, r) * x[static_cast<std::size_t>(r)];
            for (int c = 0; c < n_; ++c) {
                sum += A(r, c) * x[static_cast<std::size_t>(c)];
            }
            worst = std::fabs(sum) > worst ? std::fabs(sum) : worst;
        }
        return worst;
    }
    /// Column c of A^-1; empty: not positive definite.
    [[nodiscard]] std::vector<long double> inverse_column(int c) {
        if (!factor(0.0L)) {
            return {};
        }
        std::vector<long double> x(static_cast<std::size_t>(n_), 0.0L);
        x[static_cast<std::size_t>(c)] = 1.0L;
        return substitute(x);
    }

private:
    [[nodiscard]] long double& L(int r, int c) { return l_[static_cast<std::size_t>(r * n_ + c)]; }
    [[nodiscard]] bool factor(long double lambda) {
        l_ = a_;
        for (int c = 0; c < n_; ++c) {
            long double d = A(c, c) * (1.0L + lambda);
            for (int k = 0; k < c; ++k) {
                d -= L(c, k) * L(c, k);
            }
            if (!(d > 0.0L)) {
                return false;
            }
            L(c, c) = std::sqrt(d);
            for (int r = c + 1; r < n_; ++r) {
                long double s = A(r, c);
                for (int k = 0; k < c; ++k) {
                    s -= L(r, k) * L(c, k);
                }
                L(r, c) = s / L(c, c);
            }
        }
        return true;
    }
    [[nodiscard]] std::vector<long double> substitute(std::vector<long double> x) {
        for (int r = 0; r < n_; ++r) {
            for (int k = 0; k < r; ++k) {
                x[static_cast<std::size_t>(r)] -= L(r, k) * x[static_cast<std::size_t>(k)];
            }
            x[static_cast<std::size_t>(r)] /= L(r, r);
        }
        for (int r = n_ - 1; r >= 0; --r) {
            for (int k = r + 1; k < n_; ++k) {
                x[static_cast<std::size_t>(r)] -= L(k, r) * x[static_cast<std::size_t>(k)];
            }
            x[static_cast<std::size_t>(r)] /= L(r, r);
        }
        return x;
    }

    int n_;
    std::vector<long double> a_;
    std::vector<long double> b_;
    std::vector<long double> l_;
};

}  // namespace semtrack::test

#endif
