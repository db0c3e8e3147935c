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

inline constexpr int kSolverFrames = kObjectWindow > kEgoWindow + 1 ? kObjectWindow : kEgoWindow + 1;
inline constexpr int kReducedSize = kFrameBlock * kSolverFrames + kSharedBlock;
static_assert(kMaxObjectFeatures <= kSolverPoints, "one workspace serves both problems");
static_assert(kSolverFrames <= 16, "a bit per frame says whether it saw points");

/// Update of every block, in the order of the problem's indices.
struct SolverStep {
    std::array<Vec6, kSolverFrames> frame{};
    Vec3 shared{Vec3::Zero()};
    std::array<Vec3, kSolverPoints> point{};
};

static_assert(kPoseFrames <= kSolverFrames, "one workspace serves both problems");

template <Coupling kCoupling>
inline constexpr std::size_t kCouplingRoom =
    static_cast<std::size_t>(kPointBlock) * kCoupled<kCoupling>* kCouplingStride<kCoupling>* static_cast<std::size_t>(
                                                kCoupling == Coupling::kPose ? kPoseFrames : kSolverFrames);
/// Room for E^T of the larger problem.
inline constexpr std::size_t kCouplings = kCouplingRoom<Coupling::kPose> > kCouplingRoom<Coupling::kPlanar>
                                              ? kCouplingRoom<Coupling::kPose>
                                              : kCouplingRoom<Coupling::kPlanar>;

class NormalEquations {
public:
    /// Empties the system. Counts within the capacities are the caller's contract.
    void clear(int frames, int points, bool shared, Coupling coupling = Coupling::kPose);

    void add_frame(int i, const Mat6& H, const Vec6& g);
    void add_frame_pair(int i, int j, const Mat6& H_ij);  ///< i < j
    void add_shared(const Mat3& H, const Vec3& g);
    void add_frame_shared(int i, const Mat6x3& H_is);
    void add_point(int p, const Mat3& H, const Vec3& g);
    /// One observation; rows behind the coupled columns are not read. Adds up.
    void add_frame_point(int i, int p, const Mat6x3& H_ip);
    /// All points of a frame at once: where to write them. Frame i must not have couplings yet.
    [[nodiscard]] FramePoints open_frame(int i);
    /// The same for a frame that is held: Et is null.
    [[nodiscard]] FramePoints open_held_frame();

    /// One damped step: (H + lambda diag(H)) step = -g. kNotObservable: the reduced matrix is not positive definite
    /// (raise lambda), or an entry is not finite; step is then untouched. A point whose C is singular is damped on its
    /// own, so that it does not pass for a known one; a point without measurements gets a zero step.
    /// Cost O(points frames^2 + (6 frames)^3), whatever the frames saw; no allocation.
    Status solve(double lambda, SolverStep& step);

    /// Covariance of frame i (the 6x6 block of S^-1 without damping). kNotObservable as above.
    Status covariance(int i, Mat6& out);
    /// The same for the shared block.
    Status shared_covariance(Mat3& out);

private:
    static constexpr int kStride = kReducedSize + 1;  // even: rows start at an even address

    void reduce(double lambda);
    template <Coupling kCoupling>
    void eliminate_points();
    template <Coupling kCoupling>
    void weigh_couplings(int i);
    template <Coupling kCoupling>
    void subtract_block(int i, int j);
    template <Coupling kCoupling>
    void substitute_points();
    void invert_points(double lambda);
    [[nodiscard]] bool invert_point(std::size_t p, double damping);
    [[nodiscard]] bool factor();
    [[nodiscard]] bool factor_row(int k);
    void subtract_rows(int k, int r, int end);
    [[nodiscard]] bool factor_undamped();
    void covariance_column(int row);
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
    /// Row (k, c) of E^T of frame i: coordinate k of the point, column c of the frame.
    [[nodiscard]] std::size_t coupling_at(int i, int k, int c) const {
        return (static_cast<std::size_t>(i * kPointBlock + k) * static_cast<std::size_t>(coupled_) +
                static_cast<std::size_t>(c)) *
               coupling_stride_;
    }
    [[nodiscard]] bool sees_points(int i) const {
        return ((static_cast<unsigned>(seeing_) >> static_cast<unsigned>(i)) & 1U) != 0U;
    }

    int frames_{0};
    int points_{0};
    bool shared_{false};
    int coupled_{kFrameBlock};
    int coupled_begin_{0};
    std::size_t coupling_stride_{kPointStride};
    std::size_t lanes_{0};
    int size_{0};                                                         // 6 frames + 3 shared
    alignas(kLaneBytes) std::array<double, kReducedSize * kStride> B_{};  // upper triangle, row by row
    alignas(kLaneBytes) std::array<double, kReducedSize * kStride> S_{};  // reduced matrix, then its factor
    std::array<double, kReducedSize> v_{};
    std::array<double, kReducedSize> s_{};  // reduced right-hand side
    std::array<double, kReducedSize> x_{};
    std::array<double, kReducedSize> diagonal_inverse_{};  // of the factor
    std::array<int, kReducedSize> row_end_{};              // of the factor: behind it a row is zero
    alignas(kLaneBytes) std::array<PointRow, 6> C_{};      // 00 01 02 11 12 22
    alignas(kLaneBytes) std::array<PointRow, 6> C_inv_{};  // zero: the point keeps its place
    alignas(kLaneBytes) std::array<PointRow, 3> w_{};
    alignas(kLaneBytes) std::array<PointRow, 3> z_{};                // C^-1 w, then the points' steps
    alignas(kLaneBytes) std::array<PointRow, 3 * kFrameBlock> Y_{};  // E C^-1 of one frame, transposed as Et_
    alignas(kLaneBytes) std::array<double, kCouplings> Et_{};        // frame by frame
    std::uint16_t seeing_{0};                                        // bit i: frame i has couplings
    bool factored_{false};                                           // S holds the factor of the undamped system
};

}  // namespace semtrack

#endif
