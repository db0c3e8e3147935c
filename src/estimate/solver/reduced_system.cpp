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

/// S -= Y b: Y has kCoupled rows of E C^-1, b three rows of kCoupled columns; rows of S lie stride apart.
template <std::size_t kCoupled, std::size_t kStride>
inline void subtract_product(const std::array<double, 3 * kCoupled>& y, const double* __restrict b,
                             double* __restrict S) {
    for (std::size_t r = 0; r < kCoupled; ++r) {
        double* __restrict const row = S + r * kStride;
        for (std::size_t c = 0; c < kCoupled; ++c) {
            row[c] -= y[3 * r] * b[c] + y[3 * r + 1] * b[kCoupled + c] + y[3 * r + 2] * b[2 * kCoupled + c];
        }
    }
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
    const double c00 = C_inv_[0][ip];
    const double c01 = C_inv_[1][ip];
    const double c02 = C_inv_[2][ip];
    const double c11 = C_inv_[3][ip];
    const double c12 = C_inv_[4][ip];
    const double c22 = C_inv_[5][ip];
    const auto seen = static_cast<unsigned>(seen_[ip]);
    const double* const Et = &Et_[coupling_at(p, 0)];
    const auto begin = static_cast<std::size_t>(coupled_begin_);
    constexpr std::size_t kBlock = kPointBlock * kCoupled;
    for (std::size_t i = 0; i < static_cast<std::size_t>(frames_); ++i) {
        if (((seen >> i) & 1U) == 0U) {
            continue;
        }
        const double* const a = Et + kBlock * i;
        std::array<double, kBlock> y{};  // E C^-1
        double* const s = &s_[begin + kCoupled * i];
        for (std::size_t r = 0; r < kCoupled; ++r) {
            const double e0 = a[r];
            const double e1 = a[kCoupled + r];
            const double e2 = a[2 * kCoupled + r];
            y[3 * r] = e0 * c00 + e1 * c01 + e2 * c02;
            y[3 * r + 1] = e0 * c01 + e1 * c11 + e2 * c12;
            y[3 * r + 2] = e0 * c02 + e1 * c12 + e2 * c22;
            s[r] -= y[3 * r] * w_[0][ip] + y[3 * r + 1] * w_[1][ip] + y[3 * r + 2] * w_[2][ip];
        }
        double* const rows = &S_[(begin + kCoupled * i) * kStride + begin];
        for (std::size_t j = i; j < static_cast<std::size_t>(frames_); ++j) {
            if (((seen >> j) & 1U) != 0U) {
                subtract_product<kCoupled, kStride>(y, Et + kBlock * j, rows + kCoupled * j);
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

// Cholesky S = U^T U in the upper triangle, row by row, fixed order; zeros of a row are passed over.
bool NormalEquations::factor() {
    for (int k = 0; k < size_; ++k) {
        const double scale = std::fabs(B(k, k)) > 0.0 ? std::fabs(B(k, k)) : 1.0;
        const double pivot = S(k, k);
        if (!(pivot > kMinPivotRatio * scale) || !std::isfinite(pivot)) {
            return false;
        }
        const double root = std::sqrt(pivot);
        const double inverse = 1.0 / root;
        double* __restrict const row = &S(k, 0);
        row[k] = root;
        int end = size_;
        while (end > k + 1 && row[end - 1] == 0.0) {
            --end;
        }
        row_end_[static_cast<std::size_t>(k)] = end;
        for (int c = k + 1; c < end; ++c) {
            row[c] *= inverse;
        }
        for (int r = k + 1; r < end; ++r) {
            const double f = row[r];
            if (f == 0.0) {
                continue;
            }
            double* __restrict const below = &S(r, 0);
            for (int c = r; c < end; ++c) {
                below[c] -= f * row[c];
            }
        }
    }
    return true;
}

// Solves U^T U x = x in place.
void NormalEquations::substitute(std::array<double, kReducedSize>& x) {
    for (int r = 0; r < size_; ++r) {
        const auto ir = static_cast<std::size_t>(r);
        const double y = x[ir] / S(r, r);
        x[ir] = y;
        const double* const row = &S(r, 0);
        for (int c = r + 1; c < row_end_[ir]; ++c) {
            x[static_cast<std::size_t>(c)] -= row[c] * y;
        }
    }
    for (int r = size_ - 1; r >= 0; --r) {
        const auto ir = static_cast<std::size_t>(r);
        double y = x[ir];
        const double* const row = &S(r, 0);
        for (int c = r + 1; c < row_end_[ir]; ++c) {
            y -= row[c] * x[static_cast<std::size_t>(c)];
        }
        x[ir] = y / row[r];
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
        std::array<double, kPointBlock> rhs{w_[0][ip], w_[1][ip], w_[2][ip]};
        for (int i = 0; i < frames_; ++i) {
            if (((static_cast<unsigned>(seen_[ip]) >> static_cast<unsigned>(i)) & 1U) == 0U) {
                continue;
            }
            const double* const a = &Et_[coupling_at(p, i)];
            const double* const y = &x_[static_cast<std::size_t>(coupled_begin_ + coupled_ * i)];
            for (std::size_t k = 0; k < kPointBlock; ++k) {
                for (std::size_t c = 0; c < kCoupled; ++c) {
                    rhs[k] += a[kCoupled * k + c] * y[c];
                }
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
