// Position error against true-positive rate: the paper's Sect. 6, Fig. "Average position error vs TP rate".
#ifndef SEMTRACK_SIL_METRICS_POSITION_CURVE_HPP
#define SEMTRACK_SIL_METRICS_POSITION_CURVE_HPP

#include <array>

#include "sil/metrics/average_precision.hpp"

namespace semtrack::sil {

inline constexpr std::size_t kPositionThresholds = 40;  ///< bird's-eye overlap 0, 1/40, .. 39/40

struct PositionCurve {
    struct Point {
        double overlap{0};
        std::int64_t hits{0};
        std::optional<double> rate{};           ///< hits / labels
        std::optional<double> error_percent{};  ///< mean over the hits of |position error| / distance
    };
    std::int64_t labels{0};
    std::array<Point, kPositionThresholds> points{};
};

/// Mean position error of all pairs, whatever their overlap.
struct PositionMean {
    std::int64_t labels{0};
    std::int64_t hits{0};
    std::optional<double> error_percent{};
};

/// Cars of the paper's regimes, over one or more drives. Pairs are made by the 2D boxes (track_matching.hpp); a pair is
/// a true positive at a threshold when its oriented boxes overlap by that or more, seen from above. The point at 0 has
/// every pair: the paper's "for all the estimated results".
class PositionEvaluation {
public:
    void add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames, const ObjectTruthSet& truth);
    /// Index of kDifficultyNames.
    [[nodiscard]] PositionCurve curve(std::size_t difficulty) const;
    /// Of cars under KITTI's limits (with truncation). Index of kDifficultyNames.
    [[nodiscard]] PositionMean kitti(std::size_t difficulty) const { return kitti_[difficulty].mean_of(); }
    /// Of pedestrians 25 px high or more, occluded 1 or less, truncated 0.5 or less (as pedestrian_* of
    /// object_errors.hpp).
    [[nodiscard]] PositionMean pedestrians() const { return pedestrians_.mean_of(); }

private:
    struct Sample {
        double overlap{0};
        double error_percent{0};
    };
    struct Errors {
        std::int64_t labels{0};
        std::vector<double> percent;

        [[nodiscard]] PositionMean mean_of() const {
            return {labels, static_cast<std::int64_t>(percent.size()), mean(percent)};
        }
    };
    std::array<Errors, kDifficulties> kitti_{};
    Errors pedestrians_{};
    std::array<std::vector<Sample>, kDifficulties> samples_{};
    std::array<std::int64_t, kDifficulties> labels_{};
};

}  // namespace semtrack::sil

#endif
