#include "sil/regression/match_means.hpp"

#include <optional>
#include <string>
#include <vector>

#include "sil/kitti/text_file.hpp"
#include "sil/metrics/object_rows.hpp"
#include "sil/regression/json.hpp"

namespace semtrack::sil {

Json match_means(const std::filesystem::path& ego_csv) {
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
    return matches;
}

}  // namespace semtrack::sil
