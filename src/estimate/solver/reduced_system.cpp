// Elimination of the points, factorisation of what is left, back substitution.
#include <cmath>
#include <cstring>

#include "estimate/solver/normal_equations.hpp"
#include "math/double2.hpp"

namespace semtrack {

namespace {

// Pivots of the reduced matrix are relative to the diagonal before elimination: below, the system is singular.
constexpr double kMinPivotRatio = 1e-13;
// A point is singular by itself below this determinant, relative to the product of its diagonal.
constexpr double kMinDeterminantRatio = 1e-14;
// Damping of a point that is singular by itself (seen once by one camera): it must not hold its frame.
constexpr double kPointDamping = 1e-7;

/// S -= Y E^T of two rows of Y and kColumns of E, summed over the lanes; rows of S lie s_stride apart.
template <std::size_t kColumns, std::size_t kCoupledRows, std::size_t kLaneStride>
inline void subtract_tile(const double* Yt, const double* Et, std::size_t lanes, std::size_t s_stride, double* S) {
    std::array<Double2, kColumns> first{};
    std::array<Double2, kColumns> second{};
    for (std::size_t p = 0; p < lanes; p += kDouble2) {
        for (std::size_t k = 0; k < kPointBlock; ++k) {
            const double* const y = Yt + k * kCoupledRows * kLaneStride + p;
            const double* const e = Et + k * kCoupledRows * kLaneStride + p;
            const Double2 y_first = load2(y);
            const Double2 y_second = load2(y + kLaneStride);
            for (std::size_t c = 0; c < kColumns; ++c) {
                const Double2 column = load2(e + c * kLaneStride);
                first[c] += y_first * column;
                second[c] += y_second * column;
            }
        }
    }
    for (std::size_t c = 0; c < kColumns; ++c) {
        S[c] -= sum2(first[c]);
        S[s_stride + c] -= sum2(second[c]);
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

bool NormalEquations::invert_point(std::size_t p, double damping) {
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
    const bool positive = c00 > 0.0 && c11 > 0.0 && c22 > 0.0 && determinant > kMinDeterminantRatio * (c00 * c11 * c22);
    const double s = positive ? 1.0 / determinant : 0.0;
    C_inv_[0][p] = s * a;
    C_inv_[1][p] = s * b;
    C_inv_[2][p] = s * c;
    C_inv_[3][p] = s * (c00 * c22 - c02 * c02);
    C_inv_[4][p] = s * (c01 * c02 - c00 * c12);
    C_inv_[5][p] = s * (c00 * c11 - c01 * c01);
    return positive;
}

void NormalEquations::invert_points(double lambda) {
    for (std::size_t p = 0; p < lanes_; ++p) {
        if (!invert_point(p, lambda) && !invert_point(p, kPointDamping)) {
            for (PointRow& row : C_inv_) {
                row[p] = 0.0;
            }
        }
    }
    for (std::size_t p = 0; p < lanes_; ++p) {
        const double w0 = w_[0][p];
        const double w1 = w_[1][p];
        const double w2 = w_[2][p];
        z_[0][p] = C_inv_[0][p] * w0 + C_inv_[1][p] * w1 + C_inv_[2][p] * w2;
        z_[1][p] = C_inv_[1][p] * w0 + C_inv_[3][p] * w1 + C_inv_[4][p] * w2;
        z_[2][p] = C_inv_[2][p] * w0 + C_inv_[4][p] * w1 + C_inv_[5][p] * w2;
    }
}

// Y = E C^-1 of frame i, and its share of s -= E C^-1 w.
template <Coupling kCoupling>
void NormalEquations::weigh_couplings(int i) {
    constexpr std::size_t kRows = kCoupled<kCoupling>;
    constexpr std::size_t kLaneStride = kCouplingStride<kCoupling>;
    const double* const Et = &Et_[coupling_at(i, 0, 0)];
    double* const Yt = Y_[0].data();
    std::array<Double2, kRows> sums{};
    for (std::size_t p = 0; p < lanes_; p += kDouble2) {
        const Double2 c00 = load2(&C_inv_[0][p]);
        const Double2 c01 = load2(&C_inv_[1][p]);
        const Double2 c02 = load2(&C_inv_[2][p]);
        const Double2 c11 = load2(&C_inv_[3][p]);
        const Double2 c12 = load2(&C_inv_[4][p]);
        const Double2 c22 = load2(&C_inv_[5][p]);
        for (std::size_t r = 0; r < kRows; ++r) {
            const Double2 e0 = load2(Et + r * kLaneStride + p);
            const Double2 e1 = load2(Et + (kRows + r) * kLaneStride + p);
            const Double2 e2 = load2(Et + (2 * kRows + r) * kLaneStride + p);
            store2(Yt + r * kLaneStride + p, e0 * c00 + e1 * c01 + e2 * c02);
            store2(Yt + (kRows + r) * kLaneStride + p, e0 * c01 + e1 * c11 + e2 * c12);
            store2(Yt + (2 * kRows + r) * kLaneStride + p, e0 * c02 + e1 * c12 + e2 * c22);
            sums[r] += e0 * load2(&z_[0][p]) + e1 * load2(&z_[1][p]) + e2 * load2(&z_[2][p]);
        }
    }
    for (std::size_t r = 0; r < kRows; ++r) {
        s_[static_cast<std::size_t>(coupled_begin_ + coupled_ * i) + r] -= sum2(sums[r]);
    }
}

// Block (i, j) of S -= E C^-1 E^T, tile by tile. Below the diagonal S is written but never read.
template <Coupling kCoupling>
void NormalEquations::subtract_block(int i, int j) {
    constexpr std::size_t kRows = kCoupled<kCoupling>;
    constexpr std::size_t kLaneStride = kCouplingStride<kCoupling>;
    constexpr std::size_t kTile = kCoupling == Coupling::kPose ? 3 : 4;  // what registers hold
    const double* const Et = &Et_[coupling_at(j, 0, 0)];
    double* const block = &S(row_of(i, 0), row_of(j, 0));
    for (std::size_t r = 0; r < kRows; r += 2) {
        if (i == j && r + 2 == kRows) {  // the last two rows of a diagonal block need but two columns
            subtract_tile<2, kRows, kLaneStride>(Y_[0].data() + r * kLaneStride, Et + r * kLaneStride, lanes_, kStride,
                                                 block + r * kStride + r);
            continue;
        }
        for (std::size_t c = 0; c < kRows; c += kTile) {
            if (i != j || c + kTile > r) {
                subtract_tile<kTile, kRows, kLaneStride>(Y_[0].data() + r * kLaneStride, Et + c * kLaneStride, lanes_,
                                                         kStride, block + r * kStride + c);
            }
        }
    }
}

template <Coupling kCoupling>
void NormalEquations::eliminate_points() {
    for (int i = 0; i < frames_; ++i) {
        if (!sees_points(i)) {
            continue;
        }
        weigh_couplings<kCoupling>(i);
        for (int j = i; j < frames_; ++j) {
            if (sees_points(j)) {
                subtract_block<kCoupling>(i, j);
            }
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
        eliminate_points<Coupling::kPlanar>();
    } else {
        eliminate_points<Coupling::kPose>();
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
        substitute_points<Coupling::kPlanar>();
    } else {
        substitute_points<Coupling::kPose>();
    }
    for (int p = 0; p < points_; ++p) {
        const auto ip = static_cast<std::size_t>(p);
        step.point[ip] = Vec3(z_[0][ip], z_[1][ip], z_[2][ip]);
    }
    return Status::kOk;
}

// z = -C^-1 (w + E^T y)
template <Coupling kCoupling>
void NormalEquations::substitute_points() {
    constexpr std::size_t kColumns = kCoupled<kCoupling>;
    constexpr std::size_t kLaneStride = kCouplingStride<kCoupling>;
    for (std::size_t k = 0; k < kPointBlock; ++k) {
        std::memcpy(z_[k].data(), w_[k].data(), lanes_ * sizeof(double));
    }
    for (int i = 0; i < frames_; ++i) {
        if (!sees_points(i)) {
            continue;
        }
        const double* const Et = &Et_[coupling_at(i, 0, 0)];
        const double* const y = &x_[static_cast<std::size_t>(coupled_begin_ + coupled_ * i)];
        for (std::size_t k = 0; k < kPointBlock; ++k) {
            for (std::size_t p = 0; p < lanes_; p += kDouble2) {
                Double2 sum = load2(&z_[k][p]);
                for (std::size_t c = 0; c < kColumns; ++c) {
                    sum += load2(Et + (k * kColumns + c) * kLaneStride + p) * y[c];
                }
                store2(&z_[k][p], sum);
            }
        }
    }
    for (std::size_t p = 0; p < lanes_; ++p) {
        const double r0 = z_[0][p];
        const double r1 = z_[1][p];
        const double r2 = z_[2][p];
        z_[0][p] = -(C_inv_[0][p] * r0 + C_inv_[1][p] * r1 + C_inv_[2][p] * r2);
        z_[1][p] = -(C_inv_[1][p] * r0 + C_inv_[3][p] * r1 + C_inv_[4][p] * r2);
        z_[2][p] = -(C_inv_[2][p] * r0 + C_inv_[4][p] * r1 + C_inv_[5][p] * r2);
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
