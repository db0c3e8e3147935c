#include "sil/metrics/position_curve.hpp"

#include "sil/metrics/rotated_overlap.hpp"
#include "sil/metrics/track_matching.hpp"

namespace semtrack::sil {

namespace {

constexpr std::size_t kPaperRules = 1;  // of kRuleSets

}  // namespace

void PositionEvaluation::add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                             const ObjectTruthSet& truth) {
    const std::vector<EvaluatedFrame> frames = evaluated_frames(results, result_frames, truth);
    const auto matches = match_rows(frames, results, truth.labels);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        for (std::size_t d = 0; d < kDifficulties; ++d) {
            const Difficulty& difficulty = kRuleSets[kPaperRules].difficulties[d];
            for (const std::size_t l : frames[f].labels) {
                labels_[d] += counts_as_car(truth.labels[l], difficulty) ? 1 : 0;
            }
            for (const RowMatch& m : matches[f]) {
                const ObjectRow& label = truth.labels[m.label];
                const double distance = label.bottom_c0.norm();
                if (counts_as_car(label, difficulty) && distance > 0.0) {
                    const double error = (results[m.result].bottom_c0 - label.bottom_c0).norm();
                    samples_[d].push_back({birdseye_overlap(results[m.result], label), 100.0 * error / distance});
                }
            }
        }
    }
}

PositionCurve PositionEvaluation::curve(std::size_t difficulty) const {
    PositionCurve out;
    out.labels = labels_[difficulty];
    for (std::size_t k = 0; k < kPositionThresholds; ++k) {
        PositionCurve::Point& point = out.points[k];
        point.overlap = static_cast<double>(k) / static_cast<double>(kPositionThresholds);
        std::vector<double> errors;
        for (const Sample& s : samples_[difficulty]) {
            if (s.overlap >= point.overlap) {
                errors.push_back(s.error_percent);
            }
        }
        point.hits = static_cast<std::int64_t>(errors.size());
        point.error_percent = mean(errors);
        if (out.labels > 0) {
            point.rate = static_cast<double>(point.hits) / static_cast<double>(out.labels);
        }
    }
    return out;
}

}  // namespace semtrack::sil
