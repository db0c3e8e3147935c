// `semtrack-sil run`: every case of a scenario file as a replay in a process of its own, several at a time.
#ifndef SEMTRACK_SIL_REGRESSION_RUN_SCENARIOS_HPP
#define SEMTRACK_SIL_REGRESSION_RUN_SCENARIOS_HPP

#include "sil/options.hpp"

namespace semtrack::sil {

/// Writes OUT/NAME/ (the replay's results), OUT/logs/NAME.txt (what it printed), OUT/metrics.json, OUT/junit.xml,
/// OUT/table.txt, and prints the verdicts and the table. false: a bound or the baseline is broken, or a replay failed.
/// InputError: a scenario file that cannot be used, an output folder that cannot be written.
[[nodiscard]] bool run_scenarios(const RunOptions& options);

}  // namespace semtrack::sil

#endif
