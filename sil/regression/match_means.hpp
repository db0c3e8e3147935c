// What a table may show beyond metrics.json: means of what every row of a replay's ego.csv says.
#ifndef SEMTRACK_SIL_REGRESSION_MATCH_MEANS_HPP
#define SEMTRACK_SIL_REGRESSION_MATCH_MEANS_HPP

#include <filesystem>
#include <nlohmann/json.hpp>

namespace semtrack::sil {

/// `features_mean`, `inliers_mean` over the frames but the first, and `inlier_share`, their ratio; null without such
/// frames or features.
[[nodiscard]] nlohmann::ordered_json match_means(const std::filesystem::path& ego_csv);

}  // namespace semtrack::sil

#endif
