// Elimination of the points, factorisation of what is left, back substitution.
#include <cmath>

#include "estimate/solver/normal_equations.hpp"

namespace semtrack {

namespace {

// Pivots of the reduced matrix are relative to the diagonal before elimination: below, the system is singular.
constexpr double kMinPivotRatio = 1e-13;
// A point is singular by itself below this determinant, relative to the product of its diagonal.
constexpr double kMinDeterminantRatio = 1e-14;
// Damping of a point that is singular by itself (seen once by one camera): it must not hold its frame.
constexpr double kPointDamping = 1e-7;

/// out = E C^-1, both as three rows of kCoupled columns (one row per coordinate of the point).
template <std::size_t kCoupled>
inline void times_inverse(const double* __restrict e, const std::array<double, 6>& c, double* __restrict out) {
    for (std::size_t r = 0; r < kCoupled; ++r) {
        out[r] = e[r] * c[0] + e[kCoupled + r] * c[1] + e[2 * kCoupled + r] * c[2];
    }
    for (std::size_t r = 0; r < kCoupled; ++r) {
        out[kCoupled + r] = e[r] * c[1] + e[kCoupled + r] * c[3] + e[2 * kCoupled + r] * c[4];
    }
    for (std::size_t r = 0; r < kCoupled; ++r) {
        out[2 * kCoupled + r] = e[r] * c[2] + e[kCoupled + r] * c[4] + e[2 * kCoupled + r] * c[5];
    }
}

/// S -= Y^T E of three rows each; rows of S lie stride apart. kDiagonal: only the upper triangle is wanted.
template <std::size_t kCoupled, std::size_t kStride, bool kDiagonal>
inline void subtract_product(const double* __restrict y, const double* __restrict e, double* __restrict S) {
    for (std::size_t r = 0; r < kCoupled; ++r) {
        double* __restrict const row = S + r * kStride;
        // Pairs of columns stay whole, for the two lanes of a vector.
        for (std::size_t c = kDiagonal ? r / 2 * 2 : 0; c < kCoupled; ++c) {
            row[c] -= y[r] * e[c] + y[kCoupled + r] * e[kCoupled + c] + y[2 * kCoupled + r] * e[2 * kCoupled + c];
        }
    }
}

/// Four sums side by side: the same order everywhere, and no chain of additions.
inline double dot(const double* a, const double* b, std::size_t n) {
    std::array<double, 4> s{};
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4) {
        for (std::size_t l = 0; l < 4; ++l) {
            s[l] += a[k + l] * b[k + l];
        }
    }
    for (; k < n; ++k) {
        s[0] += a[k] * b[k];
    }
    return (s[0] + s[1]) + (s[2] + s[3]);
}

}  // namespace

bool NormalEquations::invert_point_damped(std::size_t p, double damping) {
    const double d = 1.0 + damping;
    const double c00 = d * C_[0][p];
    const double c01 = C_[1][p];
    const double c02 = C_[2][p];
    const double c11 = d * C_[3][p];
    const double c12 = C_[4][p];
    const double c22 = d * C_[5][p];
    const double a = c11 * c22 - c12 * c12;
    const double b = c02 * c12 - c01 * c22;
    const double c = c01 * c12 - c02 * c11;
    const double determinant = c00 * a + c01 * b + c02 * c;
    const double s = 1.0 / determinant;
    C_inv_[0][p] = s * a;
    C_inv_[1][p] = s * b;
    C_inv_[2][p] = s * c;
    C_inv_[3][p] = s * (c00 * c22 - c02 * c02);
    C_inv_[4][p] = s * (c01 * c02 - c00 * c12);
    C_inv_[5][p] = s * (c00 * c11 - c01 * c01);
    return c00 > 0.0 && c11 > 0.0 && c22 > 0.0 && determinant > kMinDeterminantRatio * (c00 * c11 * c22);
}

void NormalEquations::invert_points(double lambda) {
    for (std::size_t p = 0; p < static_cast<std::size_t>(points_); ++p) {
        usable_[p] = invert_point_damped(p, lambda) || invert_point_damped(p, kPointDamping);
    }
}

// S -= E C^-1 E^T, s -= E C^-1 w of one point. Below the diagonal blocks' diagonals S is written but never read.
template <std::size_t kCoupled>
void NormalEquations::reduce_point(int p) {
    const auto ip = static_cast<std::size_t>(p);
    const auto begin = static_cast<std::size_t>(coupled_begin_);
    const std::array<double, 6> c{C_inv_[0][ip], C_inv_[1][ip], C_inv_[2][ip],
                                  C_inv_[3][ip], C_inv_[4][ip], C_inv_[5][ip]};
    const double t0 = c[0] * w_[0][ip] + c[1] * w_[1][ip] + c[2] * w_[2][ip];  // C^-1 w
    const double t1 = c[1] * w_[0][ip] + c[3] * w_[1][ip] + c[4] * w_[2][ip];
    const double t2 = c[2] * w_[0][ip] + c[4] * w_[1][ip] + c[5] * w_[2][ip];
    const auto seen = static_cast<unsigned>(seen_[ip]);
    const double* const Et = &Et_[coupling_at(p, 0)];
    constexpr std::size_t kBlock = kPointBlock * kCoupled;
    for (std::size_t i = 0; i < static_cast<std::size_t>(frames_); ++i) {
        if (((seen >> i) & 1U) == 0U) {
            continue;
        }
        const double* __restrict const e = Et + kBlock * i;
        double* __restrict const s = &s_[begin + kCoupled * i];
        for (std::size_t r = 0; r < kCoupled; ++r) {
            s[r] -= e[r] * t0 + e[kCoupled + r] * t1 + e[2 * kCoupled + r] * t2;
        }
        std::array<double, kBlock> y{};  // E C^-1
        times_inverse<kCoupled>(e, c, y.data());
        double* const rows = &S_[(begin + kCoupled * i) * kStride + begin];
        subtract_product<kCoupled, kStride, true>(y.data(), e, rows + kCoupled * i);
        for (std::size_t j = i + 1; j < static_cast<std::size_t>(frames_); ++j) {
            if (((seen >> j) & 1U) != 0U) {
                subtract_product<kCoupled, kStride, false>(y.data(), Et + kBlock * j, rows + kCoupled * j);
            }
        }
    }
}

template <std::size_t kCoupled>
void NormalEquations::reduce_points() {
    for (int p = 0; p < points_; ++p) {
        if (usable_[static_cast<std::size_t>(p)]) {
            reduce_point<kCoupled>(p);
        }
    }
}

// S = B + lambda diag(B) - sum over points of E C^-1 E^T, s = v - sum of E C^-1 w.
void NormalEquations::reduce(double lambda) {
    for (int r = 0; r < size_; ++r) {
        for (int c = r; c < size_; ++c) {
            S(r, c) = B(r, c);
        }
        S(r, r) += lambda * B(r, r);
        s_[static_cast<std::size_t>(r)] = v_[static_cast<std::size_t>(r)];
    }
    invert_points(lambda);
    if (coupled_ == static_cast<int>(Coupling::kPlanar)) {
        reduce_points<static_cast<std::size_t>(Coupling::kPlanar)>();
    } else {
        reduce_points<static_cast<std::size_t>(Coupling::kPose)>();
    }
}

// Row k of the factor from row k of S, whose earlier rows are subtracted. false: no positive pivot.
bool NormalEquations::factor_row(int k) {
    const double scale = std::fabs(B(k, k)) > 0.0 ? std::fabs(B(k, k)) : 1.0;
    const double pivot = S(k, k);
    if (!(pivot > kMinPivotRatio * scale) || !std::isfinite(pivot)) {
        return false;
    }
    double* const row = &S(k, 0);
    row[k] = std::sqrt(pivot);
    const double inverse = 1.0 / row[k];
    int end = size_;
    while (end > k + 1 && row[end - 1] == 0.0) {
        --end;
    }
    for (int c = k + 1; c < end; ++c) {
        row[c] *= inverse;
    }
    row_end_[static_cast<std::size_t>(k)] = end;
    diagonal_inverse_[static_cast<std::size_t>(k)] = inverse;
    return true;
}

// Row r minus the shares of rows k and k + 1, which end at or before end.
void NormalEquations::subtract_rows(int k, int r, int end) {
    const double* __restrict const first = &S(k, 0);
    const double* __restrict const second = &S(k + 1, 0);
    double* __restrict const row = &S(r, 0);
    const double f = first[r];
    const double g = second[r];
    for (int c = r; c < end; ++c) {
        row[c] = row[c] - f * first[c] - g * second[c];
    }
}

// Cholesky S = U^T U in the upper triangle, two rows at a time, fixed order; what is zero at a row's end is left out.
bool NormalEquations::factor() {
    for (int k = 0; k < size_; k += 2) {
        if (!factor_row(k)) {
            return false;
        }
        if (k + 1 == size_) {
            break;
        }
        const int first_end = row_end_[static_cast<std::size_t>(k)];
        const double f = S(k, k + 1);
        for (int c = k + 1; c < first_end; ++c) {
            S(k + 1, c) -= f * S(k, c);
        }
        if (!factor_row(k + 1)) {
            return false;
        }
        const int second_end = row_end_[static_cast<std::size_t>(k + 1)];
        const int end = first_end > second_end ? first_end : second_end;
        for (int r = k + 2; r < end; ++r) {
            if (S(k, r) != 0.0 || S(k + 1, r) != 0.0) {
                subtract_rows(k, r, end);
            }
        }
    }
    return true;
}

// Solves U^T U x = x in place.
void NormalEquations::substitute(std::array<double, kReducedSize>& x) {
    for (int r = 0; r < size_; ++r) {
        const auto ir = static_cast<std::size_t>(r);
        const double y = x[ir] * diagonal_inverse_[ir];
        x[ir] = y;
        const double* __restrict const row = &S(r, 0);
        double* __restrict const rest = x.data();
        for (int c = r + 1; c < row_end_[ir]; ++c) {
            rest[c] -= row[c] * y;
        }
    }
    for (int r = size_ - 1; r >= 0; --r) {
        const auto ir = static_cast<std::size_t>(r);
        const std::size_t n = static_cast<std::size_t>(row_end_[ir] - r) - 1U;
        x[ir] = (x[ir] - dot(&S_[ir * kStride + ir + 1U], x.data() + ir + 1U, n)) * diagonal_inverse_[ir];
    }
}

Status NormalEquations::solve(double lambda, SolverStep& step) {
    factored_ = false;
    reduce(lambda);
    if (!factor()) {
        return Status::kNotObservable;
    }
    bool finite = true;
    for (int r = 0; r < size_; ++r) {
        x_[static_cast<std::size_t>(r)] = -s_[static_cast<std::size_t>(r)];
    }
    substitute(x_);
    for (int r = 0; r < size_; ++r) {
        finite = finite && std::isfinite(x_[static_cast<std::size_t>(r)]);
    }
    if (!finite) {
        return Status::kNotObservable;
    }
    for (int i = 0; i < frames_; ++i) {
        for (int c = 0; c < kFrameBlock; ++c) {
            step.frame[static_cast<std::size_t>(i)](c) = x_[static_cast<std::size_t>(row_of(i, c))];
        }
    }
    step.shared.setZero();
    for (int r = 0; shared_ && r < kSharedBlock; ++r) {
        step.shared(r) = x_[static_cast<std::size_t>(shared_row() + r)];
    }
    if (coupled_ == static_cast<int>(Coupling::kPlanar)) {
        substitute_points<static_cast<std::size_t>(Coupling::kPlanar)>(step);
    } else {
        substitute_points<static_cast<std::size_t>(Coupling::kPose)>(step);
    }
    return Status::kOk;
}

// z = -C^-1 (w + E^T y)
template <std::size_t kCoupled>
void NormalEquations::substitute_points(SolverStep& step) const {
    for (int p = 0; p < points_; ++p) {
        const auto ip = static_cast<std::size_t>(p);
        step.point[ip].setZero();
        if (!usable_[ip]) {
            continue;
        }
        // Every column is summed on its own, over the frames: no chain of additions.
        std::array<double, kPointBlock * kCoupled> sums{};
        for (int i = 0; i < frames_; ++i) {
            if (((static_cast<unsigned>(seen_[ip]) >> static_cast<unsigned>(i)) & 1U) == 0U) {
                continue;
            }
            const double* const e = &Et_[coupling_at(p, i)];
            const double* const y = &x_[static_cast<std::size_t>(coupled_begin_ + coupled_ * i)];
            for (std::size_t k = 0; k < kPointBlock; ++k) {
                for (std::size_t c = 0; c < kCoupled; ++c) {
                    sums[kCoupled * k + c] += e[kCoupled * k + c] * y[c];
                }
            }
        }
        std::array<double, kPointBlock> rhs{w_[0][ip], w_[1][ip], w_[2][ip]};
        for (std::size_t k = 0; k < kPointBlock; ++k) {
            for (std::size_t c = 0; c < kCoupled; ++c) {
                rhs[k] += sums[kCoupled * k + c];
            }
        }
        step.point[ip] = -Vec3(C_inv_[0][ip] * rhs[0] + C_inv_[1][ip] * rhs[1] + C_inv_[2][ip] * rhs[2],
                               C_inv_[1][ip] * rhs[0] + C_inv_[3][ip] * rhs[1] + C_inv_[4][ip] * rhs[2],
                               C_inv_[2][ip] * rhs[0] + C_inv_[4][ip] * rhs[1] + C_inv_[5][ip] * rhs[2]);
    }
}

bool NormalEquations::factor_undamped() {
    if (!factored_) {
        reduce(0.0);
        factored_ = factor();
    }
    return factored_;
}

// Column of the inverse -> x_.
void NormalEquations::covariance_column(int row) {
    for (int r = 0; r < size_; ++r) {
        x_[static_cast<std::size_t>(r)] = 0.0;
    }
    x_[static_cast<std::size_t>(row)] = 1.0;
    substitute(x_);
}

Status NormalEquations::covariance(int i, Mat6& out) {
    if (!factor_undamped()) {
        return Status::kNotObservable;
    }
    for (int c = 0; c < kFrameBlock; ++c) {
        covariance_column(row_of(i, c));
        for (int r = 0; r < kFrameBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(row_of(i, r))];
        }
    }
    return Status::kOk;
}

Status NormalEquations::shared_covariance(Mat3& out) {
    if (!shared_ || !factor_undamped()) {
        return Status::kNotObservable;
    }
    for (int c = 0; c < kSharedBlock; ++c) {
        covariance_column(shared_row() + c);
        for (int r = 0; r < kSharedBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(shared_row() + r)];
        }
    }
    return Status::kOk;
}

}  // namespace semtrack
