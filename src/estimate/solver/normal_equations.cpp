#include "estimate/solver/normal_equations.hpp"

#include <cstring>

namespace semtrack {

void NormalEquations::clear(int frames, int points, bool shared, Coupling coupling) {
    const bool planar = coupling == Coupling::kPlanar;
    const int most_frames = planar ? kSolverFrames : kPoseFrames;
    frames_ = frames < most_frames ? frames : most_frames;
    const int most_points = planar ? kMaxObjectFeatures : kSolverPoints;
    points_ = points < most_points ? points : most_points;
    lanes_ = padded_lanes(points_);
    shared_ = shared;
    coupled_ = static_cast<int>(coupling);
    coupled_begin_ = (kFrameBlock - coupled_) * frames_;
    coupling_stride_ = planar ? kCouplingStride<Coupling::kPlanar> : kCouplingStride<Coupling::kPose>;
    seeing_ = 0;
    size_ = kFrameBlock * frames_ + (shared ? kSharedBlock : 0);
    factored_ = false;
    for (int r = 0; r < size_; ++r) {
        for (int c = r; c < size_; ++c) {
            B(r, c) = 0.0;
        }
        v_[static_cast<std::size_t>(r)] = 0.0;
    }
    for (PointRow& row : C_) {
        std::memset(row.data(), 0, lanes_ * sizeof(double));
    }
    for (PointRow& row : w_) {
        std::memset(row.data(), 0, lanes_ * sizeof(double));
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
    if (!sees_points(i)) {
        double* const Et = open_frame(i).Et;
        for (std::size_t k = 0; k < static_cast<std::size_t>(kPointBlock * coupled_) * coupling_stride_; ++k) {
            Et[k] = 0.0;
        }
    }
    factored_ = false;
    for (int k = 0; k < kPointBlock; ++k) {
        for (int c = 0; c < coupled_; ++c) {
            Et_[coupling_at(i, k, c) + static_cast<std::size_t>(p)] += H_ip(c, k);
        }
    }
}

FramePoints NormalEquations::open_frame(int i) {
    factored_ = false;
    seeing_ = static_cast<std::uint16_t>(static_cast<unsigned>(seeing_) | (1U << static_cast<unsigned>(i)));
    return {C_, w_, &Et_[coupling_at(i, 0, 0)]};
}

FramePoints NormalEquations::open_held_frame() {
    factored_ = false;
    return {C_, w_, nullptr};
}

}  // namespace semtrack
