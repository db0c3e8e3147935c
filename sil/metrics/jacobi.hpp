// Eigenvalues and vectors of small symmetric matrices by cyclic Jacobi rotations.
#ifndef SEMTRACK_SIL_METRICS_JACOBI_HPP
#define SEMTRACK_SIL_METRICS_JACOBI_HPP

#include <array>
#include <cmath>
#include <cstddef>

namespace semtrack::sil {

template <std::size_t N>
struct SymmetricEigen {
    std::array<double, N> values{};                  ///< not sorted
    std::array<std::array<double, N>, N> vectors{};  ///< vectors[k] belongs to values[k]; unit length
};

/// Turns a[p][q] to zero and the basis with it.
template <std::size_t N>
void jacobi_rotate(std::array<std::array<double, N>, N>& a, SymmetricEigen<N>& e, std::size_t p, std::size_t q) {
    if (a[p][q] == 0.0) {
        return;
    }
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double sign = theta < 0.0 ? -1.0 : 1.0;
    const double t = sign / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0);
    const double s = t * c;
    for (std::size_t k = 0; k < N; ++k) {
        const double kp = a[k][p];
        const double kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (std::size_t k = 0; k < N; ++k) {
        const double pk = a[p][k];
        const double qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const double vp = e.vectors[p][k];
        const double vq = e.vectors[q][k];
        e.vectors[p][k] = c * vp - s * vq;
        e.vectors[q][k] = s * vp + c * vq;
    }
    a[p][q] = a[q][p] = 0.0;
}

/// 30 sweeps are far beyond what 4x4 needs (about 6). a must be finite and symmetric.
template <std::size_t N>
SymmetricEigen<N> symmetric_eigen(std::array<std::array<double, N>, N> a) {
    SymmetricEigen<N> e;
    for (std::size_t i = 0; i < N; ++i) {
        e.vectors[i][i] = 1.0;
    }
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (std::size_t p = 0; p + 1 < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) {
                jacobi_rotate(a, e, p, q);
            }
        }
    }
    for (std::size_t i = 0; i < N; ++i) {
        e.values[i] = a[i][i];
    }
    return e;
}

}  // namespace semtrack::sil

#endif
