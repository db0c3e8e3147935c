#include "sil/regression/table_metrics.hpp"

#include <optional>
#include <string>
#include <vector>

#include "sil/kitti/text_file.hpp"
#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

using Json = nlohmann::ordered_json;

void add_timing(const std::filesystem::path& timing_csv, Json& metrics) {
    const TextFile file(timing_csv, false, ',');
    Json timing = Json::object();
    for (std::size_t column = 1; !file.rows().empty() && column < file.rows()[0].words.size(); ++column) {
        const std::string name(file.rows()[0].words[column]);
        if (name.size() < 4U || name.substr(name.size() - 3U) != "_us") {
            continue;
        }
        std::vector<double> values;
        for (std::size_t i = 1; i < file.rows().size(); ++i) {
            values.push_back(1e-3 * file.number(file.rows()[i], column));
        }
        const std::string stage = name.substr(0, name.size() - 3U);
        timing[stage + "_ms"] = median(values).value_or(0.0);
        timing[stage + "_max_ms"] = quantile(values, 1.0).value_or(0.0);
    }
    metrics["timing"] = timing;
}

void add_matches(const std::filesystem::path& ego_csv, Json& metrics) {
    const TextFile file(ego_csv, false, ',');
    Json matches{{"features_mean", nullptr}, {"inliers_mean", nullptr}, {"inlier_share", nullptr}};
    const auto mean_of = [&](const std::string& name) -> std::optional<double> {
        std::vector<double> values;
        for (std::size_t column = 0; !file.rows().empty() && column < file.rows()[0].words.size(); ++column) {
            for (std::size_t i = 2; file.rows()[0].words[column] == name && i < file.rows().size(); ++i) {
                values.push_back(file.number(file.rows()[i], column));
            }
        }
        return mean(values);
    };
    const std::optional<double> features = mean_of("features");
    const std::optional<double> inliers = mean_of("inliers");
    if (features && inliers && *features > 0.0) {
        matches =
            Json{{"features_mean", *features}, {"inliers_mean", *inliers}, {"inlier_share", *inliers / *features}};
    }
    metrics["matches"] = matches;
}

}  // namespace semtrack::sil
