#include "estimate/solver/normal_equations.hpp"

#include <cmath>

#include "estimate/solver/symmetric3.hpp"

namespace semtrack {

namespace {

// Pivots of the reduced matrix are relative to the diagonal before elimination: below, the system is singular.
constexpr double kMinPivotRatio = 1e-13;
// Damping of a point that is singular by itself (seen once by one camera): it must not hold its frame.
constexpr double kPointDamping = 1e-7;

}  // namespace

void NormalEquations::clear(int frames, int points, bool shared) {
    frames_ = frames < kSolverFrames ? frames : kSolverFrames;
    points_ = points < kSolverPoints ? points : kSolverPoints;
    shared_ = shared;
    size_ = kFrameBlock * frames_ + (shared ? kSharedBlock : 0);
    factored_ = false;
    for (int r = 0; r < size_; ++r) {
        for (int c = 0; c < size_; ++c) {
            B(r, c) = 0.0;
        }
        v_[static_cast<std::size_t>(r)] = 0.0;
    }
    for (int p = 0; p < points_; ++p) {
        const auto i = static_cast<std::size_t>(p);
        C_[i].setZero();
        w_[i].setZero();
        seen_[i] = 0;
    }
}

void NormalEquations::add_frame(int i, const Mat6& H, const Vec6& g) {
    factored_ = false;
    const int at = kFrameBlock * i;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = r; c < kFrameBlock; ++c) {
            B(at + r, at + c) += H(r, c);
        }
        v_[static_cast<std::size_t>(at + r)] += g(r);
    }
}

void NormalEquations::add_frame_pair(int i, int j, const Mat6& H_ij) {
    factored_ = false;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kFrameBlock; ++c) {
            B(kFrameBlock * i + r, kFrameBlock * j + c) += H_ij(r, c);
        }
    }
}

void NormalEquations::add_shared(const Mat3& H, const Vec3& g) {
    factored_ = false;
    const int at = kFrameBlock * frames_;
    for (int r = 0; r < kSharedBlock; ++r) {
        for (int c = r; c < kSharedBlock; ++c) {
            B(at + r, at + c) += H(r, c);
        }
        v_[static_cast<std::size_t>(at + r)] += g(r);
    }
}

void NormalEquations::add_frame_shared(int i, const Mat6x3& H_is) {
    factored_ = false;
    const int at = kFrameBlock * frames_;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kSharedBlock; ++c) {
            B(kFrameBlock * i + r, at + c) += H_is(r, c);
        }
    }
}

void NormalEquations::add_point(int p, const Mat3& H, const Vec3& g) {
    factored_ = false;
    C_[static_cast<std::size_t>(p)] += H;
    w_[static_cast<std::size_t>(p)] += g;
}

void NormalEquations::add_frame_point(int i, int p, const Mat6x3& H_ip) {
    factored_ = false;
    const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(i));
    std::uint16_t& seen = seen_[static_cast<std::size_t>(p)];
    PoseBlock& block = Et(p, i);
    if ((seen & bit) == 0U) {
        block.fill(0.0);
        seen = static_cast<std::uint16_t>(seen | bit);
    }
    for (int k = 0; k < kPointBlock; ++k) {
        for (int c = 0; c < kFrameBlock; ++c) {
            block[static_cast<std::size_t>(kFrameBlock * k + c)] += H_ip(c, k);
        }
    }
}

bool NormalEquations::invert_point(int p, double lambda) {
    const auto ip = static_cast<std::size_t>(p);
    for (const double damping : {lambda, kPointDamping}) {
        Mat3 C = C_[ip];
        for (int k = 0; k < kPointBlock; ++k) {
            C(k, k) += damping * C(k, k);
        }
        if (inverse_symmetric3(C, C_inv_[ip])) {
            return true;
        }
    }
    return false;
}

// S -= E C^-1 E^T, s -= E C^-1 w of one point. Below the diagonal blocks' diagonals S is written but never read.
void NormalEquations::reduce_point(int p) {
    const auto ip = static_cast<std::size_t>(p);
    const Mat3& C_inv = C_inv_[ip];
    const Vec3& w = w_[ip];
    for (int i = 0; i < frames_; ++i) {
        if (!sees(p, i)) {
            continue;
        }
        const PoseBlock& a = Et(p, i);
        std::array<double, kFrameBlock> y0{};  // columns of E C^-1
        std::array<double, kFrameBlock> y1{};
        std::array<double, kFrameBlock> y2{};
        for (std::size_t r = 0; r < kFrameBlock; ++r) {
            const double e0 = a[r];
            const double e1 = a[kFrameBlock + r];
            const double e2 = a[2 * kFrameBlock + r];
            y0[r] = e0 * C_inv(0, 0) + e1 * C_inv(1, 0) + e2 * C_inv(2, 0);
            y1[r] = e0 * C_inv(0, 1) + e1 * C_inv(1, 1) + e2 * C_inv(2, 1);
            y2[r] = e0 * C_inv(0, 2) + e1 * C_inv(1, 2) + e2 * C_inv(2, 2);
            s_[static_cast<std::size_t>(kFrameBlock * i) + r] -= y0[r] * w(0) + y1[r] * w(1) + y2[r] * w(2);
        }
        for (int j = i; j < frames_; ++j) {
            if (!sees(p, j)) {
                continue;
            }
            const PoseBlock& b = Et(p, j);
            for (int r = 0; r < kFrameBlock; ++r) {
                const auto q = static_cast<std::size_t>(r);
                double* const row = &S(kFrameBlock * i + r, kFrameBlock * j);
                for (std::size_t c = 0; c < kFrameBlock; ++c) {
                    row[c] -= y0[q] * b[c] + y1[q] * b[kFrameBlock + c] + y2[q] * b[2 * kFrameBlock + c];
                }
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
    for (int p = 0; p < points_; ++p) {
        const auto ip = static_cast<std::size_t>(p);
        usable_[ip] = invert_point(p, lambda);
        if (usable_[ip]) {
            reduce_point(p);
        }
    }
}

// Cholesky S = U^T U in the upper triangle, row by row, fixed order.
bool NormalEquations::factor() {
    for (int k = 0; k < size_; ++k) {
        const double scale = std::fabs(B(k, k)) > 0.0 ? std::fabs(B(k, k)) : 1.0;
        const double pivot = S(k, k);
        if (!(pivot > kMinPivotRatio * scale) || !std::isfinite(pivot)) {
            return false;
        }
        const double root = std::sqrt(pivot);
        const double inverse = 1.0 / root;
        double* const row = &S(k, 0);
        row[k] = root;
        for (int c = k + 1; c < size_; ++c) {
            row[c] *= inverse;
        }
        for (int r = k + 1; r < size_; ++r) {
            const double f = row[r];
            double* const below = &S(r, 0);
            for (int c = r; c < size_; ++c) {
                below[c] -= f * row[c];
            }
        }
    }
    return true;
}

// Solves U^T U x = x in place.
void NormalEquations::substitute(std::array<double, kReducedSize>& x) {
    for (int r = 0; r < size_; ++r) {
        const double y = x[static_cast<std::size_t>(r)] / S(r, r);
        x[static_cast<std::size_t>(r)] = y;
        for (int c = r + 1; c < size_; ++c) {
            x[static_cast<std::size_t>(c)] -= S(r, c) * y;
        }
    }
    for (int r = size_ - 1; r >= 0; --r) {
        double y = x[static_cast<std::size_t>(r)];
        for (int c = r + 1; c < size_; ++c) {
            y -= S(r, c) * x[static_cast<std::size_t>(c)];
        }
        x[static_cast<std::size_t>(r)] = y / S(r, r);
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
        for (int r = 0; r < kFrameBlock; ++r) {
            step.frame[static_cast<std::size_t>(i)](r) = x_[static_cast<std::size_t>(kFrameBlock * i + r)];
        }
    }
    step.shared.setZero();
    for (int r = 0; shared_ && r < kSharedBlock; ++r) {
        step.shared(r) = x_[static_cast<std::size_t>(kFrameBlock * frames_ + r)];
    }
    for (int p = 0; p < points_; ++p) {
        substitute_point(p, step);
    }
    return Status::kOk;
}

// z = -C^-1 (w + E^T y)
void NormalEquations::substitute_point(int p, SolverStep& step) const {
    const auto ip = static_cast<std::size_t>(p);
    step.point[ip].setZero();
    if (!usable_[ip]) {
        return;
    }
    Vec3 rhs = w_[ip];
    for (int i = 0; i < frames_; ++i) {
        if (!sees(p, i)) {
            continue;
        }
        const PoseBlock& a = Et(p, i);
        const Vec6& y = step.frame[static_cast<std::size_t>(i)];
        for (int k = 0; k < kPointBlock; ++k) {
            for (int c = 0; c < kFrameBlock; ++c) {
                rhs(k) += a[static_cast<std::size_t>(kFrameBlock * k + c)] * y(c);
            }
        }
    }
    step.point[ip] = -(C_inv_[ip] * rhs);
}

bool NormalEquations::factor_undamped() {
    if (!factored_) {
        reduce(0.0);
        factored_ = factor();
    }
    return factored_;
}

// Column at + c of the inverse -> x_.
void NormalEquations::covariance_column(int at, int c) {
    for (int r = 0; r < size_; ++r) {
        x_[static_cast<std::size_t>(r)] = 0.0;
    }
    x_[static_cast<std::size_t>(at + c)] = 1.0;
    substitute(x_);
}

Status NormalEquations::covariance(int i, Mat6& out) {
    if (!factor_undamped()) {
        return Status::kNotObservable;
    }
    for (int c = 0; c < kFrameBlock; ++c) {
        covariance_column(kFrameBlock * i, c);
        for (int r = 0; r < kFrameBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(kFrameBlock * i + r)];
        }
    }
    return Status::kOk;
}

Status NormalEquations::shared_covariance(Mat3& out) {
    if (!shared_ || !factor_undamped()) {
        return Status::kNotObservable;
    }
    const int at = kFrameBlock * frames_;
    for (int c = 0; c < kSharedBlock; ++c) {
        covariance_column(at, c);
        for (int r = 0; r < kSharedBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(at + r)];
        }
    }
    return Status::kOk;
}

}  // namespace semtrack
