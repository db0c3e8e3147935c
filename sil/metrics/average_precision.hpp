// Average precision of cars: KITTI's object benchmark, seen from above and in 3D, with oriented boxes.
#ifndef SEMTRACK_SIL_METRICS_AVERAGE_PRECISION_HPP
#define SEMTRACK_SIL_METRICS_AVERAGE_PRECISION_HPP

#include <array>

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

/// Which labels count. Vans, other labels and DontCare areas are neither hits nor misses.
struct Difficulty {
    double least_height_px;
    int most_occluded;
    double most_truncated;
};
inline constexpr std::size_t kDifficulties = 3;
inline constexpr std::array<const char*, kDifficulties> kDifficultyNames{"easy", "moderate", "hard"};

/// KITTI's, and the paper's: "according to occlusion level and 2D box height", so without truncation.
struct RuleSet {
    const char* name;
    std::array<Difficulty, kDifficulties> difficulties;
};
inline constexpr std::array<RuleSet, 2> kRuleSets{{
    {"kitti", {{{40.0, 0, 0.15}, {25.0, 1, 0.30}, {25.0, 2, 0.50}}}},
    {"paper", {{{40.0, 0, 1e9}, {25.0, 1, 1e9}, {25.0, 2, 1e9}}}},
}};
inline constexpr std::array<const char*, 2> kOverlapNames{"birdseye", "3d"};
inline constexpr std::array<double, 3> kOverlapThresholds{0.25, 0.5, 0.7};
inline constexpr std::array<const char*, 3> kThresholdNames{"0.25", "0.5", "0.7"};

/// A car label that counts under a difficulty.
[[nodiscard]] bool counts_as_car(const ObjectRow& label, const Difficulty& difficulty);

struct PrecisionCurve {
    struct Scored {
        double score{0};
        bool hit{false};
    };
    std::vector<Scored> scored;  ///< results that are a hit or a false alarm
    std::int64_t labels{0};      ///< labels that count

    /// Mean over recall 0, 0.1, .. 1 of the best precision at that or higher recall, %. Empty without labels.
    [[nodiscard]] std::optional<double> ap11() const;
    /// The same over recall 1/40, 2/40, .. 1 (KITTI since 2019).
    [[nodiscard]] std::optional<double> ap40() const;
    [[nodiscard]] std::int64_t hits() const;
    [[nodiscard]] std::int64_t false_alarms() const;
};

/// Results of one or more drives together.
///
/// Within a frame results are taken by falling score; each takes the label of largest overlap among those free that
/// reach the threshold, one that counts before one that does not. Neither hit nor false alarm: a result on a label that
/// does not count (Van, too small, hidden, cut), one lower than the difficulty's height, one without label that lies in
/// a DontCare area by half or more. Only results of type Car are looked at, on evaluated
/// frames.
class AveragePrecision {
public:
    void add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames, const ObjectTruthSet& truth);
    /// Indices of kRuleSets, kOverlapNames, kOverlapThresholds, kDifficultyNames.
    [[nodiscard]] const PrecisionCurve& curve(std::size_t rules, std::size_t overlap, std::size_t threshold,
                                              std::size_t difficulty) const {
        return curves_[index(rules, overlap, threshold, difficulty)];
    }

private:
    static constexpr std::size_t kCurves =
        kRuleSets.size() * kOverlapNames.size() * kOverlapThresholds.size() * kDifficulties;
    [[nodiscard]] static constexpr std::size_t index(std::size_t r, std::size_t o, std::size_t t, std::size_t d) {
        return ((r * kOverlapNames.size() + o) * kOverlapThresholds.size() + t) * kDifficulties + d;
    }
    std::array<PrecisionCurve, kCurves> curves_{};
};

}  // namespace semtrack::sil

#endif
