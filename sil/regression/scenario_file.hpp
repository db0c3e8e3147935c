// A scenario file: JSON that names cases (a replay each), their bounds and the table to print. docs/scenarios.md.
#ifndef SEMTRACK_SIL_REGRESSION_SCENARIO_FILE_HPP
#define SEMTRACK_SIL_REGRESSION_SCENARIO_FILE_HPP

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sil/options.hpp"

namespace semtrack::sil {

/// `metric` is a JSON pointer into metrics.json, e.g. /ate_rmse_m or /run/can_lists.
struct Bound {
    std::string metric;
    std::optional<double> least{};
    std::optional<double> most{};
};

/// What a user would accept and the product does not reach yet: stated, not a failure, and it must be short still.
struct Shortfall {
    Bound wanted;
    std::string why;
};

/// How much a metric may move against the baseline.
struct Tolerance {
    std::string metric;
    double most{0};
};

enum class Golden { kNone, kRows, kMetrics };

/// A detector's file that has to become the project's format first.
struct DetectionSource2d {
    std::string format;  ///< empty: none
    std::filesystem::path file;
    std::filesystem::path viewpoints;
    std::string object_class;  ///< of rows without class; empty: the format's own
};

struct ScenarioCase {
    std::string name;
    std::string group;                   ///< cases of one group are one row of the table
    std::vector<std::string> arguments;  ///< of replay, without --out
    DriveOptions drive{};
    DetectionSource2d convert{};
    std::vector<Bound> bounds;
    std::vector<Shortfall> shortfalls;
    std::vector<Tolerance> tolerances;
    Golden golden{Golden::kNone};
    int repeat{1};        ///< runs of the replay; /timing then has each frame's shortest time
    std::string missing;  ///< not empty: what is not there; the case is skipped
};

struct TableColumn {
    std::string name;
    std::string metric;
    int digits{2};
};
struct TableReference {
    std::string name;
    std::vector<std::optional<double>> values;
};
struct TableSpec {
    std::string title;
    std::string note;  ///< printed wherever the table is
    std::vector<TableColumn> columns;
    std::vector<TableReference> references;
};

struct ScenarioFile {
    std::vector<ScenarioCase> cases;
    TableSpec table;
};

/// Relative paths start at the file; $NAME at the start of a path is the environment's. InputError names file and case:
/// not JSON, an unknown key, a doubled name, replay options that replay refuses.
[[nodiscard]] ScenarioFile read_scenario_file(const std::filesystem::path& path);

}  // namespace semtrack::sil

#endif
