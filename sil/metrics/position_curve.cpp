#include "sil/metrics/position_curve.hpp"

#include "sil/metrics/rotated_overlap.hpp"
#include "sil/metrics/track_matching.hpp"

namespace semtrack::sil {

namespace {

constexpr std::size_t kKittiRules = 0;  // of kRuleSets
constexpr std::size_t kPaperRules = 1;
constexpr double kLeastPedestrian_px = 25.0;
constexpr int kMostOccluded = 1;
constexpr double kMostTruncated = 0.5;

bool counts_as_pedestrian(const ObjectRow& label) {
    return label.type == "Pedestrian" && box_height(label) >= kLeastPedestrian_px && label.occluded <= kMostOccluded &&
           label.truncated <= kMostTruncated;
}

}  // namespace

void PositionEvaluation::add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                             const ObjectTruthSet& truth) {
    const std::vector<EvaluatedFrame> frames = evaluated_frames(results, result_frames, truth);
    const auto matches = match_rows(frames, results, truth.labels);
    const auto add_to = [&](std::size_t f, Errors& errors, const auto& counts) {
        for (const std::size_t l : frames[f].labels) {
            errors.labels += counts(truth.labels[l]) ? 1 : 0;
        }
        for (const RowMatch& m : matches[f]) {
            const ObjectRow& label = truth.labels[m.label];
            const double distance = label.bottom_c0.norm();
            if (counts(label) && distance > 0.0) {
                errors.percent.push_back(100.0 * (results[m.result].bottom_c0 - label.bottom_c0).norm() / distance);
            }
        }
    };
    for (std::size_t f = 0; f < frames.size(); ++f) {
        add_to(f, pedestrians_, counts_as_pedestrian);
        for (std::size_t d = 0; d < kDifficulties; ++d) {
            const Difficulty& difficulty = kRuleSets[kKittiRules].difficulties[d];
            add_to(f, kitti_[d], [&](const ObjectRow& label) { return counts_as_car(label, difficulty); });
        }
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
