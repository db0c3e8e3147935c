// Robust kernels on a squared residual: rho(r^2) and the weight rho'(r^2) that scales J^T J and J^T r.
#ifndef SEMTRACK_MATH_ROBUST_HPP
#define SEMTRACK_MATH_ROBUST_HPP

#include <cmath>

#include "math/trig.hpp"

namespace semtrack {

/// Cost is 0.5 rho.
struct Robust {
    double rho{0};
    double weight{1};
};

/// r^2 up to k^2, then 2 k |r| - k^2.
[[nodiscard]] inline Robust huber(double r2, double k) {
    if (r2 <= k * k) {
        return {r2, 1.0};
    }
    const double r = std::sqrt(r2);
    return {2.0 * k * r - k * k, k / r};
}
/// k^2 log(1 + r^2 / k^2).
[[nodiscard]] inline Robust cauchy(double r2, double k) {
    const double s = 1.0 + r2 / (k * k);
    return {k * k * log_real(s), 1.0 / s};
}
/// k^2 / 3 (1 - (1 - r^2 / k^2)^3) up to k, then constant.
[[nodiscard]] inline Robust tukey(double r2, double k) {
    const double k2 = k * k;
    if (!(r2 < k2)) {
        return {k2 / 3.0, 0.0};
    }
    const double s = 1.0 - r2 / k2;
    return {k2 / 3.0 * (1.0 - s * s * s), s * s};
}

}  // namespace semtrack

#endif
