// What a table may show beyond metrics.json, taken from a replay's other files. Not part of metrics.json: times differ
// from run to run, and the rest is a mean of what every row of a file says.
#ifndef SEMTRACK_SIL_REGRESSION_TABLE_METRICS_HPP
#define SEMTRACK_SIL_REGRESSION_TABLE_METRICS_HPP

#include <filesystem>
#include <nlohmann/json.hpp>

namespace semtrack::sil {

/// /timing: median (`STAGE_ms`) and maximum (`STAGE_max_ms`) of each stage's time over the frames of timing.csv.
void add_timing(const std::filesystem::path& timing_csv, nlohmann::ordered_json& metrics);

/// /matches: `features_mean`, `inliers_mean` over the frames of ego.csv but the first, and `inlier_share`, their ratio;
/// null without such frames or features.
void add_matches(const std::filesystem::path& ego_csv, nlohmann::ordered_json& metrics);

}  // namespace semtrack::sil

#endif
