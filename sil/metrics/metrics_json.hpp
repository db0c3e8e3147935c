// metrics.json: counts, and errors where truth is there. Strict JSON (what is not known is null), one fixed order of
// keys, no clock values and no paths: two runs give the same bytes.
#ifndef SEMTRACK_SIL_METRICS_METRICS_JSON_HPP
#define SEMTRACK_SIL_METRICS_METRICS_JSON_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sil/metrics/agreement.hpp"
#include "sil/metrics/consistency.hpp"
#include "sil/metrics/feature_statistics.hpp"
#include "sil/metrics/object_errors.hpp"
#include "sil/metrics/object_scores.hpp"
#include "sil/metrics/stereo_checks.hpp"
#include "sil/metrics/trajectory.hpp"

namespace semtrack::sil {

/// Counts of a results folder, whoever made it.
struct ResultCounts {
    int frames{0};
    int first_frame{0};
    int last_frame{0};
    double path_length_m{0};  ///< of ego.txt, over all of its rows
    int objects{0};           ///< ids in objects.txt
    int object_rows{0};
};

/// Counts that only the run itself knows; by name, in the order of the file.
using RunCounts = std::vector<std::pair<std::string, std::int64_t>>;

struct Metrics {
    ResultCounts counts{};
    std::optional<TrajectoryErrors> ego{};        ///< empty: no truth
    std::optional<Agreement> agreement{};         ///< empty: no other trajectories
    std::optional<ObjectErrors> objects{};        ///< empty: no labels
    std::optional<ObjectScores> object_scores{};  ///< empty: no labels
    std::optional<Consistency> consistency{};     ///< empty: no standard deviations in the folder
    std::optional<FeatureStatistics> features{};  ///< empty: not a run's own, or no features
    std::optional<StereoScores> stereo{};         ///< empty: not a run's own
    RunCounts run{};                              ///< empty: not known
};

[[nodiscard]] std::string to_json(const Metrics& metrics);

}  // namespace semtrack::sil

#endif
