// Two-view geometry without depth: fundamental matrices from seven pairs, from many, and the test of a pair
// ("RANSAC with local fundamental matrix test", paper Sect. 4).
#ifndef SEMTRACK_FRONT_RANSAC_FUNDAMENTAL_HPP
#define SEMTRACK_FRONT_RANSAC_FUNDAMENTAL_HPP

#include <array>

#include "front/ransac/point_pairs.hpp"

namespace semtrack {

/// q^T F p = 0 for the pair (p before, q now), row by row, in the units of ImagePairs; unit norm, rank 2.
using Fundamental = std::array<double, 9>;

struct SevenPointSolutions {
    int count{0};
    std::array<Fundamental, 3> f{};
};

/// Every fundamental matrix through seven pairs. No solution: the pairs are degenerate (fewer than seven independent
/// equations), or the cubic's matrices are not finite. Constant cost: about 1 us.
void solve_seven_points(const ImagePairs& pairs, const std::array<int, 7>& sample, SevenPointSolutions& out);

/// Least-squares fit to the pairs with flag 1, weighted by the Sampson denominator of the start f; then rank 2.
/// false: fewer than 8 pairs or a singular system; f is untouched.
[[nodiscard]] bool refit_fundamental(const ImagePairs& pairs, const PairFlags& use, Fundamental& f);

/// Flags pairs whose Sampson distance is below threshold_px; returns how many. Pairs at an epipole, where the distance
/// is not defined, do not agree.
int test_fundamental(const ImagePairs& pairs, const Fundamental& f, double threshold_px, PairFlags& agrees);

}  // namespace semtrack

#endif
