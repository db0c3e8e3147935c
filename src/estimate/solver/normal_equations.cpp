#include "estimate/solver/normal_equations.hpp"

namespace semtrack {

void NormalEquations::clear(int frames, int points, bool shared, Coupling coupling) {
    frames_ = frames < kSolverFrames ? frames : kSolverFrames;
    points_ = points < kSolverPoints ? points : kSolverPoints;
    shared_ = shared;
    coupled_ = static_cast<int>(coupling);
    coupled_begin_ = (kFrameBlock - coupled_) * frames_;
    size_ = kFrameBlock * frames_ + (shared ? kSharedBlock : 0);
    factored_ = false;
    for (int r = 0; r < size_; ++r) {
        for (int c = r; c < size_; ++c) {
            B(r, c) = 0.0;
        }
        v_[static_cast<std::size_t>(r)] = 0.0;
    }
    for (PointColumn& column : C_) {
        for (int p = 0; p < points_; ++p) {
            column[static_cast<std::size_t>(p)] = 0.0;
        }
    }
    for (PointColumn& column : w_) {
        for (int p = 0; p < points_; ++p) {
            column[static_cast<std::size_t>(p)] = 0.0;
        }
    }
    for (int p = 0; p < points_; ++p) {
        seen_[static_cast<std::size_t>(p)] = 0;
    }
}

void NormalEquations::add_frame(int i, const Mat6& H, const Vec6& g) {
    factored_ = false;
    for (int r = 0; r < kFrameBlock; ++r) {
        const int row = row_of(i, r);
        for (int c = r; c < kFrameBlock; ++c) {
            B_upper(row, row_of(i, c)) += H(r, c);
        }
        v_[static_cast<std::size_t>(row)] += g(r);
    }
}

void NormalEquations::add_frame_pair(int i, int j, const Mat6& H_ij) {
    factored_ = false;
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kFrameBlock; ++c) {
            B_upper(row_of(i, r), row_of(j, c)) += H_ij(r, c);
        }
    }
}

void NormalEquations::add_shared(const Mat3& H, const Vec3& g) {
    factored_ = false;
    const int at = shared_row();
    for (int r = 0; r < kSharedBlock; ++r) {
        for (int c = r; c < kSharedBlock; ++c) {
            B(at + r, at + c) += H(r, c);
        }
        v_[static_cast<std::size_t>(at + r)] += g(r);
    }
}

void NormalEquations::add_frame_shared(int i, const Mat6x3& H_is) {
    factored_ = false;
    const int at = shared_row();
    for (int r = 0; r < kFrameBlock; ++r) {
        for (int c = 0; c < kSharedBlock; ++c) {
            B(row_of(i, r), at + c) += H_is(r, c);
        }
    }
}

void NormalEquations::add_point(int p, const Mat3& H, const Vec3& g) {
    factored_ = false;
    const auto ip = static_cast<std::size_t>(p);
    std::size_t at = 0;
    for (int r = 0; r < kPointBlock; ++r) {
        for (int c = r; c < kPointBlock; ++c) {
            C_[at++][ip] += H(r, c);
        }
        w_[static_cast<std::size_t>(r)][ip] += g(r);
    }
}

void NormalEquations::add_frame_point(int i, int p, const Mat6x3& H_ip) {
    factored_ = false;
    const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(i));
    std::uint16_t& seen = seen_[static_cast<std::size_t>(p)];
    const bool first = (seen & bit) == 0U;
    seen = static_cast<std::uint16_t>(seen | bit);
    std::size_t at = coupling_at(p, i);
    for (int k = 0; k < kPointBlock; ++k) {
        for (int c = 0; c < coupled_; ++c, ++at) {
            Et_[at] = first ? H_ip(c, k) : Et_[at] + H_ip(c, k);
        }
    }
}

template <std::size_t kCoupled>
void NormalEquations::add_couplings(int i, int first, int count, const PointLanes& lanes) {
    const auto bit = static_cast<std::uint16_t>(1U << static_cast<unsigned>(i));
    for (int l = 0; l < count; ++l) {
        const auto lane = static_cast<std::size_t>(l);
        if (!lanes.seen[lane]) {
            continue;
        }
        std::uint16_t& seen = seen_[static_cast<std::size_t>(first + l)];
        seen = static_cast<std::uint16_t>(seen | bit);
        double* const out = &Et_[coupling_at(first + l, i)];
        for (std::size_t k = 0; k < kPointBlock * kCoupled; ++k) {
            out[k] = lanes.Et[k][lane];
        }
    }
}

void NormalEquations::add_points(int i, int first, int count, const PointLanes& lanes) {
    factored_ = false;
    const auto at = static_cast<std::size_t>(first);
    const auto lane_count = static_cast<std::size_t>(count);
    for (std::size_t k = 0; k < lanes.C.size(); ++k) {
        for (std::size_t l = 0; l < lane_count; ++l) {
            C_[k][at + l] += lanes.C[k][l];
        }
    }
    for (std::size_t k = 0; k < lanes.w.size(); ++k) {
        for (std::size_t l = 0; l < lane_count; ++l) {
            w_[k][at + l] += lanes.w[k][l];
        }
    }
    if (i < 0) {
        return;
    }
    if (coupled_ == static_cast<int>(Coupling::kPlanar)) {
        add_couplings<static_cast<std::size_t>(Coupling::kPlanar)>(i, first, count, lanes);
    } else {
        add_couplings<static_cast<std::size_t>(Coupling::kPose)>(i, first, count, lanes);
    }
}

}  // namespace semtrack
