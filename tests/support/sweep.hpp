// How many cases of a sweep run: all on the host, a share where each costs 15 to 18 times as much (emulated
// targets, the debug build).
#ifndef SEMTRACK_TESTS_SUPPORT_SWEEP_HPP
#define SEMTRACK_TESTS_SUPPORT_SWEEP_HPP

namespace semtrack {

#ifndef SEMTRACK_SWEEP_SHARE
#define SEMTRACK_SWEEP_SHARE 1
#endif
/// One case in so many runs; bounds on how many cases there were are divided by it too.
inline constexpr int kSweepShare = SEMTRACK_SWEEP_SHARE;

}  // namespace semtrack

#endif
