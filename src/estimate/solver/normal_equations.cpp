#include "estimate/solver/normal_equations.hpp"

#include <cmath>

#include "estimate/solver/symmetric3.hpp"

namespace semtrack {

namespace {

// Pivots of the reduced matrix are relative to the diagonal before elimination: below, the system is singular.
constexpr double kMinPivotRatio = 1e-13;

}  // namespace

void NormalEquations::clear(int frames, int points, bool shared) {
    frames_ = frames < kSolverFrames ? frames : kSolverFrames;
    points_ = points < kSolverPoints ? points : kSolverPoints;
    shared_ = shared;
    size_ = kFrameBlock * frames_ + (shared ? kSharedBlock : 0);
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
    const int at = kFrameBlock * i;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = r; c < kFrameBlock; ++c) {
            B(at + r, at + c) += H(r, c);
        }
        v_[static_cast<std::size_t>(at + r)] += g(r);
    }
}

void NormalEquations::add_frame_pair(int i, int j, const Mat6& H_ij) {
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kFrameBlock; ++c) {
            B(kFrameBlock * i + r, kFrameBlock * j + c) += H_ij(r, c);
        }
    }
}

void NormalEquations::add_shared(const Mat3& H, const Vec3& g) {
    const int at = kFrameBlock * frames_;
    for (int r = 0; r < kSharedBlock; ++r) {
        for (int c = r; c < kSharedBlock; ++c) {
            B(at + r, at + c) += H(r, c);
        }
        v_[static_cast<std::size_t>(at + r)] += g(r);
    }
}

void NormalEquations::add_frame_shared(int i, const Mat6x3& H_is) {
    const int at = kFrameBlock * frames_;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kSharedBlock; ++c) {
            B(kFrameBlock * i + r, at + c) += H_is(r, c);
        }
    }
}

void NormalEquations::add_point(int p, const Mat3& H, const Vec3& g) {
    C_[static_cast<std::size_t>(p)] += H;
    w_[static_cast<std::size_t>(p)] += g;
}

void NormalEquations::add_frame_point(int i, int p, const Mat6x3& H_ip) {
    const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(i));
    std::uint16_t& seen = seen_[static_cast<std::size_t>(p)];
    Mat6x3& block = E(p, i);
    if ((seen & bit) == 0U) {
        block = H_ip;
        seen = static_cast<std::uint16_t>(seen | bit);
    } else {
        block += H_ip;
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
        Mat3 C = C_[ip];
        for (int k = 0; k < 3; ++k) {
            C(k, k) += lambda * C(k, k);
        }
        usable_[ip] = inverse_symmetric3(C, C_inv_[ip]);
        if (!usable_[ip]) {
            continue;
        }
        for (int i = 0; i < frames_; ++i) {
            if (!sees(p, i)) {
                continue;
            }
            const Mat6x3 EC = E(p, i) * C_inv_[ip];
            const Vec6 g = EC * w_[ip];
            for (int r = 0; r < kFrameBlock; ++r) {
                s_[static_cast<std::size_t>(kFrameBlock * i + r)] -= g(r);
            }
            for (int j = i; j < frames_; ++j) {
                if (!sees(p, j)) {
                    continue;
                }
                const Mat6 block = EC * E(p, j).transpose();
                for (int r = 0; r < kFrameBlock; ++r) {
                    for (int c = 0; c < kFrameBlock; ++c) {
                        if (j > i || c >= r) {
                            S(kFrameBlock * i + r, kFrameBlock * j + c) -= block(r, c);
                        }
                    }
                }
            }
        }
    }
}

// Cholesky S = U^T U in the upper triangle, row by row, fixed order.
bool NormalEquations::factor() {
    for (int k = 0; k < size_; ++k) {
        const double scale = std::fabs(B(k, k)) > 0.0 ? std::fabs(B(k, k)) : 1.0;
        const double pivot = S(k, k);
        if (!(pivot > kMinPivotRatio * scale)) {
            return false;
        }
        const double root = std::sqrt(pivot);
        const double inverse = 1.0 / root;
        S(k, k) = root;
        for (int c = k + 1; c < size_; ++c) {
            S(k, c) *= inverse;
        }
        for (int r = k + 1; r < size_; ++r) {
            const double f = S(k, r);
            for (int c = r; c < size_; ++c) {
                S(r, c) -= f * S(k, c);
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
    reduce(lambda);
    if (!factor()) {
        return Status::kNotObservable;
    }
    for (int r = 0; r < size_; ++r) {
        x_[static_cast<std::size_t>(r)] = -s_[static_cast<std::size_t>(r)];
    }
    substitute(x_);
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
        const auto ip = static_cast<std::size_t>(p);
        step.point[ip].setZero();
        if (!usable_[ip]) {
            continue;
        }
        Vec3 rhs = w_[ip];
        for (int i = 0; i < frames_; ++i) {
            if (sees(p, i)) {
                rhs += E(p, i).transpose() * step.frame[static_cast<std::size_t>(i)];
            }
        }
        step.point[ip] = -(C_inv_[ip] * rhs);
    }
    return Status::kOk;
}

Status NormalEquations::covariance(int i, Mat6& out) {
    reduce(0.0);
    if (!factor()) {
        return Status::kNotObservable;
    }
    for (int c = 0; c < kFrameBlock; ++c) {
        for (int r = 0; r < size_; ++r) {
            x_[static_cast<std::size_t>(r)] = 0.0;
        }
        x_[static_cast<std::size_t>(kFrameBlock * i + c)] = 1.0;
        substitute(x_);
        for (int r = 0; r < kFrameBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(kFrameBlock * i + r)];
        }
    }
    return Status::kOk;
}

Status NormalEquations::shared_covariance(Mat3& out) {
    if (!shared_) {
        return Status::kNotObservable;
    }
    reduce(0.0);
    if (!factor()) {
        return Status::kNotObservable;
    }
    const int at = kFrameBlock * frames_;
    for (int c = 0; c < kSharedBlock; ++c) {
        for (int r = 0; r < size_; ++r) {
            x_[static_cast<std::size_t>(r)] = 0.0;
        }
        x_[static_cast<std::size_t>(at + c)] = 1.0;
        substitute(x_);
        for (int r = 0; r < kSharedBlock; ++r) {
            out(r, c) = x_[static_cast<std::size_t>(at + r)];
        }
    }
    return Status::kOk;
}

}  // namespace semtrack
