// What came of each case, and how it is told: JUnit XML, metrics.json of all cases, a table for people.
#ifndef SEMTRACK_SIL_REGRESSION_VERDICT_HPP
#define SEMTRACK_SIL_REGRESSION_VERDICT_HPP

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sil/regression/scenario_file.hpp"

namespace semtrack::sil {

enum class CaseStatus { kPassed, kFailed, kSkipped };

struct CaseResult {
    std::string name;
    std::string group;
    CaseStatus status{CaseStatus::kPassed};
    std::vector<std::string> failures;  ///< one line each
    std::vector<std::string> shorts;    ///< shortfalls: today's figure, the wanted one, why
    std::string skipped;                ///< what is missing
    nlohmann::ordered_json metrics;     ///< of the case; null when it did not run
    double seconds{0};                  ///< by the host's clock: for JUnit and people only
};

/// One line for each bound that `metrics` breaks; a metric that is not there or null breaks every bound.
[[nodiscard]] std::vector<std::string> broken_bounds(const nlohmann::ordered_json& metrics,
                                                     const std::vector<Bound>& bounds);
/// One line for each shortfall, also for one that is met by now ("no longer short").
[[nodiscard]] std::vector<std::string> shortfall_lines(const nlohmann::ordered_json& metrics,
                                                       const std::vector<Shortfall>& shortfalls);

[[nodiscard]] std::string junit_xml(const std::string& suite, const std::vector<CaseResult>& results);
/// By case: status, failures, shortfalls, metrics. No clock values.
[[nodiscard]] std::string results_json(const std::vector<CaseResult>& results);
/// Cases with their status, what failed, what is short; last line: counts.
[[nodiscard]] std::string results_text(const std::vector<CaseResult>& results);

/// The table of a scenario file: one row a group (`groups`: name and its pooled metrics), references below.
using GroupMetrics = std::vector<std::pair<std::string, nlohmann::ordered_json>>;
[[nodiscard]] std::string table_text(const TableSpec& table, const GroupMetrics& groups);

}  // namespace semtrack::sil

#endif
