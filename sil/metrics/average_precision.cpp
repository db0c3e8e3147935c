#include "sil/metrics/average_precision.hpp"

#include <algorithm>

#include "sil/metrics/rotated_overlap.hpp"

namespace semtrack::sil {

namespace {

bool is_car_or_van(const ObjectRow& label) {
    return label.type == "Car" || label.type == "Van";
}

/// One frame's cars: results by falling score, labels, and how they overlap.
struct FrameOverlaps {
    std::vector<const ObjectRow*> results;
    std::vector<const ObjectRow*> labels;
    std::array<std::vector<double>, kOverlapNames.size()> overlaps;  // result x label
    std::vector<bool> in_area;                                       // by result

    [[nodiscard]] double at(std::size_t kind, std::size_t result, std::size_t label) const {
        return overlaps[kind][result * labels.size() + label];
    }
};

FrameOverlaps overlaps_of(const EvaluatedFrame& frame, const std::vector<ObjectRow>& results,
                          const std::vector<ObjectRow>& labels) {
    FrameOverlaps out;
    for (const std::size_t r : frame.results) {
        if (results[r].type == "Car") {
            out.results.push_back(&results[r]);
        }
    }
    std::sort(out.results.begin(), out.results.end(), [](const ObjectRow* a, const ObjectRow* b) {
        return a->score != b->score ? a->score > b->score : a->id < b->id;
    });
    for (const std::size_t l : frame.labels) {
        if (is_car_or_van(labels[l])) {
            out.labels.push_back(&labels[l]);
        }
    }
    for (const ObjectRow* r : out.results) {
        out.in_area.push_back(in_an_area(r->box, frame.areas));
        for (const ObjectRow* l : out.labels) {
            out.overlaps[0].push_back(birdseye_overlap(*r, *l));
            out.overlaps[1].push_back(box3d_overlap(*r, *l));
        }
    }
    return out;
}

constexpr std::size_t kNoLabel = static_cast<std::size_t>(-1);

/// Of the free labels that result r reaches: the counting one of largest overlap, else the other one.
std::size_t best_label(const FrameOverlaps& f, std::size_t kind, std::size_t r, double threshold,
                       const std::vector<bool>& counting, const std::vector<bool>& taken) {
    std::size_t best = kNoLabel;
    for (std::size_t l = 0; l < f.labels.size(); ++l) {
        if (taken[l] || !(f.at(kind, r, l) >= threshold)) {
            continue;
        }
        const bool better = best == kNoLabel || (counting[l] && !counting[best]) ||
                            (counting[l] == counting[best] && f.at(kind, r, l) > f.at(kind, r, best));
        best = better ? l : best;
    }
    return best;
}

void score_frame(const FrameOverlaps& f, std::size_t kind, double threshold, const Difficulty& difficulty,
                 PrecisionCurve& curve) {
    std::vector<bool> counting;
    for (const ObjectRow* l : f.labels) {
        counting.push_back(counts_as_car(*l, difficulty));
        curve.labels += counting.back() ? 1 : 0;
    }
    std::vector<bool> taken(f.labels.size(), false);
    for (std::size_t r = 0; r < f.results.size(); ++r) {
        const std::size_t label = best_label(f, kind, r, threshold, counting, taken);
        const bool small = box_height(*f.results[r]) < difficulty.least_height_px;
        if (label != kNoLabel) {
            taken[label] = true;
            if (counting[label] && !small) {
                curve.scored.push_back({f.results[r]->score, true});
            }
        } else if (!small && !f.in_area[r]) {
            curve.scored.push_back({f.results[r]->score, false});
        }
    }
}

/// Mean over recall (from + i) / steps, i = 0..count-1, of the best precision at that or higher recall, %.
std::optional<double> mean_precision(const PrecisionCurve& curve, int from, int count, int steps) {
    if (curve.labels == 0) {
        return std::nullopt;
    }
    std::vector<PrecisionCurve::Scored> sorted = curve.scored;
    std::sort(sorted.begin(), sorted.end(),
              [](const PrecisionCurve::Scored& a, const PrecisionCurve::Scored& b) { return a.score > b.score; });
    struct Point {
        std::int64_t hits;
        double precision;
    };
    std::vector<Point> points;
    std::int64_t hits = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        hits += sorted[i].hit ? 1 : 0;
        if (i + 1U == sorted.size() || sorted[i + 1U].score < sorted[i].score) {  // equal scores stand together
            points.push_back({hits, static_cast<double>(hits) / static_cast<double>(i + 1U)});
        }
    }
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        double best = 0.0;
        for (const Point& p : points) {
            if (p.hits * steps >= (from + i) * curve.labels) {
                best = std::max(best, p.precision);
            }
        }
        sum += best;
    }
    return 100.0 * sum / count;
}

}  // namespace

bool counts_as_car(const ObjectRow& label, const Difficulty& difficulty) {
    return label.type == "Car" && box_height(label) >= difficulty.least_height_px &&
           label.occluded <= difficulty.most_occluded && label.truncated <= difficulty.most_truncated;
}

std::optional<double> PrecisionCurve::ap11() const {
    return mean_precision(*this, 0, 11, 10);
}

std::optional<double> PrecisionCurve::ap40() const {
    return mean_precision(*this, 1, 40, 40);
}

std::int64_t PrecisionCurve::hits() const {
    return std::count_if(scored.begin(), scored.end(), [](const Scored& s) { return s.hit; });
}

std::int64_t PrecisionCurve::false_alarms() const {
    return static_cast<std::int64_t>(scored.size()) - hits();
}

void AveragePrecision::add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                           const ObjectTruthSet& truth) {
    for (const EvaluatedFrame& frame : evaluated_frames(results, result_frames, truth)) {
        const FrameOverlaps overlaps = overlaps_of(frame, results, truth.labels);
        for (std::size_t r = 0; r < kRuleSets.size(); ++r) {
            for (std::size_t o = 0; o < kOverlapNames.size(); ++o) {
                for (std::size_t t = 0; t < kOverlapThresholds.size(); ++t) {
                    for (std::size_t d = 0; d < kDifficulties; ++d) {
                        score_frame(overlaps, o, kOverlapThresholds[t], kRuleSets[r].difficulties[d],
                                    curves_[index(r, o, t, d)]);
                    }
                }
            }
        }
    }
}

}  // namespace semtrack::sil
