// The linear assignment problem: which row takes which column so that the sum of the chosen values is largest.
#ifndef SEMTRACK_SIL_METRICS_ASSIGNMENT_HPP
#define SEMTRACK_SIL_METRICS_ASSIGNMENT_HPP

#include <cstddef>
#include <vector>

namespace semtrack::sil {

inline constexpr std::size_t kNotAssigned = static_cast<std::size_t>(-1);

/// values: rows x columns, row by row, not negative. Returns the column of each row, or kNotAssigned when there are
/// more rows than columns. Hungarian method with potentials (Kuhn 1955, Munkres 1957); O(n^3) in the larger side.
[[nodiscard]] std::vector<std::size_t> best_assignment(const std::vector<double>& values, std::size_t rows,
                                                       std::size_t columns);

}  // namespace semtrack::sil

#endif
