// Normal equations of a window with frames, an optional shared block and points, solved by eliminating the points:
//   [ B   E ] [ y ]     [ v ]     S = B - E C^-1 E^T,   S y = -(v - E C^-1 w),   z = -C^-1 (w + E^T y)
//   [ E^T C ] [ z ] = - [ w ]
// B: frames (6 each) and the shared block (3); C: points (3x3 each); H = J^T J, (v, w) = J^T r.
// Used by ego-motion (frame = camera pose) and by objects (frame = p, theta, v, delta; shared = size).
// Points couple only to a frame's leading columns: all 6 of a camera pose, (p, theta) of an object. The other columns
// come first in B, so that their rows are sparse when it is factorised. docs/solver.md has the derivation.
#ifndef SEMTRACK_ESTIMATE_SOLVER_NORMAL_EQUATIONS_HPP
#define SEMTRACK_ESTIMATE_SOLVER_NORMAL_EQUATIONS_HPP

#include <array>
#include <cstdint>

#include "estimate/solver/point_lanes.hpp"
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
static_assert(kSolverFrames <= 16, "a bit per frame says which points it saw");

/// Columns of a frame that its points couple to.
enum class Coupling : std::uint8_t {
    kPose = 6,    ///< all
    kPlanar = 4,  ///< the leading four: (p, theta) of an object
};

/// Update of every block, in the order of the problem's indices.
struct SolverStep {
    std::array<Vec6, kSolverFrames> frame{};
    Vec3 shared{Vec3::Zero()};
    std::array<Vec3, kSolverPoints> point{};
};

class NormalEquations {
public:
    /// Empties the system. Counts within the capacities are the caller's contract.
    void clear(int frames, int points, bool shared, Coupling coupling = Coupling::kPose);

    void add_frame(int i, const Mat6& H, const Vec6& g);
    void add_frame_pair(int i, int j, const Mat6& H_ij);  ///< i < j
    void add_shared(const Mat3& H, const Vec3& g);
    void add_frame_shared(int i, const Mat6x3& H_is);
    void add_point(int p, const Mat3& H, const Vec3& g);
    /// Rows behind the coupled columns are not read. At most once per (i, p) is cheapest; adds up.
    void add_frame_point(int i, int p, const Mat6x3& H_ip);
    /// Points first .. first + count - 1 as frame i saw them; once per (i, p). i < 0: the frame is held, only C and w.
    void add_points(int i, int first, int count, const PointLanes& lanes);

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
    using PointColumn = std::array<double, static_cast<std::size_t>(kSolverPoints)>;
    static constexpr int kStride = kReducedSize + 1;  // even: rows start at an even address

    void reduce(double lambda);
    template <std::size_t kCoupled>
    void reduce_points();
    template <std::size_t kCoupled>
    void reduce_point(int p);
    template <std::size_t kCoupled>
    void add_couplings(int i, int first, int count, const PointLanes& lanes);
    void invert_points(double lambda);
    [[nodiscard]] bool invert_point_damped(std::size_t p, double damping);
    [[nodiscard]] bool factor();
    [[nodiscard]] bool factor_row(int k);
    void subtract_rows(int k, int r, int end);
    [[nodiscard]] bool factor_undamped();
    void covariance_column(int row);
    template <std::size_t kCoupled>
    void substitute_points(SolverStep& step) const;
    void substitute(std::array<double, kReducedSize>& x);
    /// Row of column c of frame i, and of the shared block.
    [[nodiscard]] int row_of(int i, int c) const {
        return c < coupled_ ? coupled_begin_ + coupled_ * i + c : (kFrameBlock - coupled_) * i + c - coupled_;
    }
    [[nodiscard]] int shared_row() const { return kFrameBlock * frames_; }
    [[nodiscard]] double& B(int r, int c) { return B_[static_cast<std::size_t>(r * kStride + c)]; }
    /// The upper triangle's entry of (r, c).
    [[nodiscard]] double& B_upper(int r, int c) { return r < c ? B(r, c) : B(c, r); }
    [[nodiscard]] double& S(int r, int c) { return S_[static_cast<std::size_t>(r * kStride + c)]; }
    [[nodiscard]] std::size_t coupling_at(int p, int i) const {
        return static_cast<std::size_t>((p * kSolverFrames + i) * kPointBlock * coupled_);
    }

    int frames_{0};
    int points_{0};
    bool shared_{false};
    int coupled_{kFrameBlock};
    int coupled_begin_{0};
    int size_{0};                                     // 6 frames + 3 shared
    std::array<double, kReducedSize * kStride> B_{};  // upper triangle, row by row
    std::array<double, kReducedSize * kStride> S_{};  // reduced matrix, then its factor
    std::array<double, kReducedSize> v_{};
    std::array<double, kReducedSize> s_{};  // reduced right-hand side
    std::array<double, kReducedSize> x_{};
    std::array<double, kReducedSize> diagonal_inverse_{};  // of the factor
    std::array<int, kReducedSize> row_end_{};              // of the factor: behind it a row is zero
    std::array<PointColumn, 6> C_{};                       // 00 01 02 11 12 22, as in PointLanes
    std::array<PointColumn, 6> C_inv_{};
    std::array<PointColumn, 3> w_{};
    std::array<bool, kSolverPoints> usable_{};
    std::array<std::uint16_t, kSolverPoints> seen_{};  // bit i: frame i saw the point
    // E^T: per (p, i) three rows (one per coordinate of the point) of the coupled columns.
    std::array<double, static_cast<std::size_t>(kSolverPoints) * kSolverFrames * kPointBlock * kFrameBlock> Et_{};
    bool factored_{false};  // S holds the factor of the undamped system
};

}  // namespace semtrack

#endif
