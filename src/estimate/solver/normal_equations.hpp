// Normal equations of a window with frames, an optional shared block and points, solved by eliminating the points:
//   [ B   E ] [ y ]     [ v ]     S = B - E C^-1 E^T,   S y = -(v - E C^-1 w),   z = -C^-1 (w + E^T y)
//   [ E^T C ] [ z ] = - [ w ]
// B: frames (6 each) and the shared block (3); C: points (3x3 each); H = J^T J, (v, w) = J^T r.
// Used by ego-motion (frame = camera pose) and by objects (frame = p, theta, v, delta; shared = size).
#ifndef SEMTRACK_ESTIMATE_SOLVER_NORMAL_EQUATIONS_HPP
#define SEMTRACK_ESTIMATE_SOLVER_NORMAL_EQUATIONS_HPP

#include <array>
#include <cstdint>

#include "math/eigen.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

inline constexpr int kFrameBlock = 6;
inline constexpr int kSharedBlock = 3;
inline constexpr int kPointBlock = 3;
inline constexpr int kSolverFrames = kObjectWindow > kEgoWindow + 1 ? kObjectWindow : kEgoWindow + 1;
inline constexpr int kSolverPoints = kMaxBackgroundFeatures;
inline constexpr int kReducedSize = kFrameBlock * kSolverFrames + kSharedBlock;
static_assert(kMaxObjectFeatures <= kSolverPoints, "one workspace serves both problems");

/// Update of every block, in the order of the problem's indices.
struct SolverStep {
    std::array<Vec6, kSolverFrames> frame{};
    Vec3 shared{Vec3::Zero()};
    std::array<Vec3, kSolverPoints> point{};
};

class NormalEquations {
public:
    /// Empties the system. Counts within the capacities are the caller's contract.
    void clear(int frames, int points, bool shared);

    void add_frame(int i, const Mat6& H, const Vec6& g);
    void add_frame_pair(int i, int j, const Mat6& H_ij);  ///< i < j
    void add_shared(const Mat3& H, const Vec3& g);
    void add_frame_shared(int i, const Mat6x3& H_is);
    void add_point(int p, const Mat3& H, const Vec3& g);
    void add_frame_point(int i, int p, const Mat6x3& H_ip);  ///< at most once per (i, p) is cheapest; adds up

    /// One damped step: (H + lambda diag(H)) step = -g. kNotObservable: the reduced matrix is not positive definite
    /// (raise lambda), or an entry is not finite; step is then untouched. A point whose C is singular is damped on its
    /// own, so that it does not pass for a known one; a point without measurements gets a zero step.
    /// Cost O(points frames^2 + (6 frames)^3), no allocation.
    Status solve(double lambda, SolverStep& step);

    /// Covariance of frame i (the 6x6 block of S^-1 without damping). kNotObservable as above.
    Status covariance(int i, Mat6& out);
    /// The same for the shared block.
    Status shared_covariance(Mat3& out);

private:
    /// Three rows (one per coordinate of the point) of six columns: transposed, so that the inner loops run along it.
    using PoseBlock = std::array<double, static_cast<std::size_t>(kPointBlock) * kFrameBlock>;

    void reduce(double lambda);
    void reduce_point(int p);
    [[nodiscard]] bool invert_point(int p, double lambda);
    [[nodiscard]] bool factor();
    [[nodiscard]] bool factor_undamped();
    void covariance_column(int at, int c);
    void substitute_point(int p, SolverStep& step) const;
    void substitute(std::array<double, kReducedSize>& x);
    [[nodiscard]] double& B(int r, int c) { return B_[static_cast<std::size_t>(r * kReducedSize + c)]; }
    [[nodiscard]] double& S(int r, int c) { return S_[static_cast<std::size_t>(r * kReducedSize + c)]; }
    [[nodiscard]] PoseBlock& Et(int p, int i) { return Et_[static_cast<std::size_t>(p * kSolverFrames + i)]; }
    [[nodiscard]] const PoseBlock& Et(int p, int i) const {
        return Et_[static_cast<std::size_t>(p * kSolverFrames + i)];
    }
    [[nodiscard]] bool sees(int p, int i) const {
        return ((static_cast<unsigned>(seen_[static_cast<std::size_t>(p)]) >> static_cast<unsigned>(i)) & 1U) != 0U;
    }

    int frames_{0};
    int points_{0};
    bool shared_{false};
    int size_{0};                                          // 6 frames + 3 shared
    std::array<double, kReducedSize * kReducedSize> B_{};  // upper triangle, row by row
    std::array<double, kReducedSize * kReducedSize> S_{};  // reduced matrix, then its factor
    std::array<double, kReducedSize> v_{};
    std::array<double, kReducedSize> s_{};  // reduced right-hand side
    std::array<double, kReducedSize> x_{};
    std::array<Mat3, kSolverPoints> C_{};
    std::array<Mat3, kSolverPoints> C_inv_{};
    std::array<Vec3, kSolverPoints> w_{};
    std::array<bool, kSolverPoints> usable_{};
    std::array<std::uint16_t, kSolverPoints> seen_{};  // bit i: frame i saw the point
    std::array<PoseBlock, static_cast<std::size_t>(kSolverPoints) * kSolverFrames> Et_{};  // E^T
    bool factored_{false};  // S holds the factor of the undamped system
};

}  // namespace semtrack

#endif
