// The benchmark scores of one drive, or of several together.
#ifndef SEMTRACK_SIL_METRICS_OBJECT_SCORES_HPP
#define SEMTRACK_SIL_METRICS_OBJECT_SCORES_HPP

#include "sil/metrics/average_precision.hpp"
#include "sil/metrics/position_curve.hpp"
#include "sil/metrics/tracking_scores.hpp"

namespace semtrack::sil {

struct ObjectScores {
    AveragePrecision precision{};
    PositionEvaluation position{};
    TrackingEvaluation tracking{};

    void add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
             const ObjectTruthSet& truth) {
        precision.add(results, result_frames, truth);
        position.add(results, result_frames, truth);
        tracking.add(results, result_frames, truth);
    }
};

}  // namespace semtrack::sil

#endif
