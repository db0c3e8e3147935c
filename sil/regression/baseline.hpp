// Baselines: what a run gave before, row by row as hashes, and its metrics. Small enough for git, exact to the bit, and
// without the data itself (a real drive's licence).
#ifndef SEMTRACK_SIL_REGRESSION_BASELINE_HPP
#define SEMTRACK_SIL_REGRESSION_BASELINE_HPP

#include <filesystem>
#include <string>
#include <vector>

#include "sil/regression/scenario_file.hpp"

namespace semtrack::sil {

/// BASELINE/NAME/rows.txt: `file frame object hash` for every row of ego.txt, ego.csv, objects.txt, states.csv,
/// list.csv and can.log (object -1: the frame's own row; hash: FNV-1a, 64 bits, rows of one frame and object together);
/// beside it metrics.json.
void write_baseline(const std::filesystem::path& results, const std::filesystem::path& baseline);

/// Complaints, empty when all is as before: the first row that differs, by file, frame and object; metrics that moved
/// beyond their tolerance (0 where none is given; run counts too; the first eight by name). Golden::kMetrics looks at
/// the metrics only. Without a baseline: one complaint.
[[nodiscard]] std::vector<std::string> compare_with_baseline(const std::filesystem::path& results,
                                                             const std::filesystem::path& baseline, Golden golden,
                                                             const std::vector<Tolerance>& tolerances);

}  // namespace semtrack::sil

#endif
