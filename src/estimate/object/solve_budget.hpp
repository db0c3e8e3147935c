// Bounded work of the objects' solves. What a frame may spend on them is a number of operations, not a time, so that
// every target decides alike. Up to six full objects nothing is cut; beyond, solves get fewer iterations (they are
// warm-started, so the next frames go on where this one stopped), and trials of other hypotheses take turns.
#ifndef SEMTRACK_ESTIMATE_OBJECT_SOLVE_BUDGET_HPP
#define SEMTRACK_ESTIMATE_OBJECT_SOLVE_BUDGET_HPP

#include <array>
#include <cstdint>

#include "model/object_window.hpp"
#include "semtrack/capacity.hpp"

namespace semtrack {

inline constexpr int kObjectIterations = 5;       // converging further was no more accurate on 200 random problems
inline constexpr int kLeastObjectIterations = 2;  // of a warm-started solve

/// What one object's solve may spend.
struct SolveShare {
    int iterations{kObjectIterations};
    bool trials{true};  ///< of other hypotheses: standing or moving, other starts
};
using SolveShares = std::array<SolveShare, static_cast<std::size_t>(kMaxObjects)>;

/// One iteration of the window's solve, in observations of one point; 0: nothing to solve.
[[nodiscard]] int iteration_work(const ObjectWindow& window);

using SolveWork = std::array<int, static_cast<std::size_t>(kMaxObjects)>;
/// Shares of all slots, by their iteration_work(). Who may try first moves on with the frame. Returns how many objects
/// got less than a full share.
[[nodiscard]] int share_out(const SolveWork& work, std::uint32_t frame, SolveShares& out);

}  // namespace semtrack

#endif
