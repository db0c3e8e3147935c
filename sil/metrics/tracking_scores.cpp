#include "sil/metrics/tracking_scores.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "model/box_geometry.hpp"
#include "sil/metrics/assignment.hpp"

namespace semtrack::sil {

/// What is left of a frame after KITTI's rules: ids, and overlaps label x result.
struct TrackingEvaluation::Frame {
    std::vector<int> labels;
    std::vector<int> results;
    std::vector<double> overlaps;

    [[nodiscard]] double at(std::size_t label, std::size_t result) const {
        return overlaps[label * results.size() + result];
    }
};

namespace {

constexpr double kClearOverlap = 0.5;
constexpr double kLeastHeight_px = 25.0;
constexpr int kMostOccluded = 2;
constexpr double kMostTruncated = 0.5;
constexpr double kRounding = 1e-12;
constexpr double kKeepPair = 1000.0;  // above any sum of overlaps in a frame

bool counts(const ObjectRow& label) {
    return label.type == "Car" && label.occluded <= kMostOccluded && label.truncated <= kMostTruncated;
}

/// Results that KITTI's rules leave in.
RowIndices kept_results(const EvaluatedFrame& frame, const std::vector<ObjectRow>& results,
                        const std::vector<ObjectRow>& labels) {
    RowIndices cars;
    std::copy_if(frame.results.begin(), frame.results.end(), std::back_inserter(cars),
                 [&](std::size_t r) { return results[r].type == "Car"; });
    RowIndices all;
    std::copy_if(frame.labels.begin(), frame.labels.end(), std::back_inserter(all),
                 [&](std::size_t l) { return labels[l].type == "Car" || labels[l].type == "Van"; });
    std::vector<double> overlaps;
    for (const std::size_t r : cars) {
        for (const std::size_t l : all) {
            const double overlap = box_overlap(labels[l].box, results[r].box);
            overlaps.push_back(overlap >= kClearOverlap - kRounding ? overlap : 0.0);
        }
    }
    const std::vector<std::size_t> taken = best_assignment(overlaps, cars.size(), all.size());
    RowIndices kept;
    for (std::size_t i = 0; i < cars.size(); ++i) {
        const ObjectRow& result = results[cars[i]];
        const bool met = taken[i] != kNotAssigned && overlaps[i * all.size() + taken[i]] > 0.0;
        const bool stays = met ? counts(labels[all[taken[i]]])
                               : box_height(result) > kLeastHeight_px && !in_an_area(result.box, frame.areas);
        if (stays) {
            kept.push_back(cars[i]);
        }
    }
    return kept;
}

double share(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace

std::vector<TrackingEvaluation::Frame> TrackingEvaluation::frames_of(const std::vector<ObjectRow>& results,
                                                                     const std::vector<int>& result_frames,
                                                                     const ObjectTruthSet& truth) {
    std::vector<Frame> out;
    for (const EvaluatedFrame& evaluated : evaluated_frames(results, result_frames, truth)) {
        Frame frame;
        const RowIndices kept = kept_results(evaluated, results, truth.labels);
        for (const std::size_t r : kept) {
            frame.results.push_back(results[r].id);
        }
        for (const std::size_t l : evaluated.labels) {
            if (!counts(truth.labels[l])) {
                continue;
            }
            frame.labels.push_back(truth.labels[l].id);
            for (const std::size_t r : kept) {
                frame.overlaps.push_back(box_overlap(truth.labels[l].box, results[r].box));
            }
        }
        out.push_back(std::move(frame));
    }
    return out;
}

void TrackingEvaluation::add_clear(const std::vector<Frame>& frames) {
    std::map<int, int> frame_before;  // label id -> result id
    std::map<int, int> ever;
    std::set<int> was_found;
    for (const Frame& f : frames) {
        std::vector<double> values;
        for (std::size_t l = 0; l < f.labels.size(); ++l) {
            const auto last = frame_before.find(f.labels[l]);
            for (std::size_t r = 0; r < f.results.size(); ++r) {
                const bool keep = last != frame_before.end() && last->second == f.results[r];
                values.push_back(f.at(l, r) < kClearOverlap - kRounding ? 0.0 : f.at(l, r) + (keep ? kKeepPair : 0.0));
            }
        }
        const std::vector<std::size_t> taken = best_assignment(values, f.labels.size(), f.results.size());
        frame_before.clear();
        std::int64_t hits = 0;
        for (std::size_t l = 0; l < f.labels.size(); ++l) {
            if (taken[l] == kNotAssigned || !(values[l * f.results.size() + taken[l]] > 0.0)) {
                continue;
            }
            const int label = f.labels[l];
            const int result = f.results[taken[l]];
            const auto [last, first_time] = ever.try_emplace(label, result);
            clear_.id_switches += !first_time && last->second != result ? 1 : 0;
            clear_.fragmentations += !first_time && was_found.count(label) == 0U ? 1 : 0;
            last->second = result;
            frame_before[label] = result;
            overlap_sum_ += f.at(l, taken[l]);
            ++hits;
        }
        for (const int label : f.labels) {
            if (frame_before.count(label) != 0U) {
                was_found.insert(label);
            } else {
                was_found.erase(label);
            }
        }
        clear_.labels += static_cast<std::int64_t>(f.labels.size());
        clear_.hits += hits;
        clear_.misses += static_cast<std::int64_t>(f.labels.size()) - hits;
        clear_.false_alarms += static_cast<std::int64_t>(f.results.size()) - hits;
    }
}

/// How well a label's track and a result's track belong together over a whole drive.
class TrackingEvaluation::Links {
public:
    explicit Links(const std::vector<Frame>& frames) {
        for (const Frame& f : frames) {
            add(f);
        }
    }
    /// Jaccard index of two tracks that have `common` frames in common.
    [[nodiscard]] double jaccard(const std::pair<int, int>& pair, double common) const {
        return share(common, label_frames_.at(pair.first) + result_frames_.at(pair.second) - common);
    }
    [[nodiscard]] double closeness(const std::pair<int, int>& pair) const { return jaccard(pair, common_.at(pair)); }

private:
    void add(const Frame& f) {
        std::vector<double> rows(f.labels.size(), 0.0);
        std::vector<double> columns(f.results.size(), 0.0);
        for (std::size_t l = 0; l < f.labels.size(); ++l) {
            label_frames_[f.labels[l]] += 1.0;
            for (std::size_t r = 0; r < f.results.size(); ++r) {
                rows[l] += f.at(l, r);
                columns[r] += f.at(l, r);
            }
        }
        for (std::size_t r = 0; r < f.results.size(); ++r) {
            result_frames_[f.results[r]] += 1.0;
            for (std::size_t l = 0; l < f.labels.size(); ++l) {
                common_[{f.labels[l], f.results[r]}] += share(f.at(l, r), rows[l] + columns[r] - f.at(l, r));
            }
        }
    }

    std::map<std::pair<int, int>, double> common_;  // frames, each weighted by how clear the pair is in it
    std::map<int, double> label_frames_;
    std::map<int, double> result_frames_;
};

void TrackingEvaluation::add_hota(const std::vector<Frame>& frames) {
    const Links links(frames);
    std::array<std::map<std::pair<int, int>, double>, kAlphas> matched;
    for (const Frame& f : frames) {
        std::vector<double> values;
        for (std::size_t l = 0; l < f.labels.size(); ++l) {
            for (std::size_t r = 0; r < f.results.size(); ++r) {
                values.push_back(links.closeness({f.labels[l], f.results[r]}) * f.at(l, r));
            }
        }
        const std::vector<std::size_t> taken = best_assignment(values, f.labels.size(), f.results.size());
        for (std::size_t a = 0; a < kAlphas; ++a) {
            const double alpha = 0.05 * static_cast<double>(a + 1U);
            std::int64_t hits = 0;
            for (std::size_t l = 0; l < f.labels.size(); ++l) {
                if (taken[l] != kNotAssigned && f.at(l, taken[l]) >= alpha - kRounding) {
                    matched[a][{f.labels[l], f.results[taken[l]]}] += 1.0;
                    ++hits;
                }
            }
            hota_[a].hits += hits;
            hota_[a].misses += static_cast<std::int64_t>(f.labels.size()) - hits;
            hota_[a].false_alarms += static_cast<std::int64_t>(f.results.size()) - hits;
        }
    }
    for (std::size_t a = 0; a < kAlphas; ++a) {
        for (const auto& [pair, count] : matched[a]) {
            hota_[a].association += count * links.jaccard(pair, count);
        }
    }
}

void TrackingEvaluation::add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                             const ObjectTruthSet& truth) {
    const std::vector<Frame> frames = frames_of(results, result_frames, truth);
    add_clear(frames);
    add_hota(frames);
}

TrackingScores TrackingEvaluation::scores() const {
    TrackingScores out = clear_;
    if (out.labels == 0) {
        return out;
    }
    out.mota =
        1.0 - static_cast<double>(out.misses + out.false_alarms + out.id_switches) / static_cast<double>(out.labels);
    if (out.hits > 0) {
        out.motp = overlap_sum_ / static_cast<double>(out.hits);
    }
    double hota = 0.0;
    double deta = 0.0;
    double assa = 0.0;
    for (const Counts& c : hota_) {
        const double detection =
            share(static_cast<double>(c.hits), static_cast<double>(c.hits + c.misses + c.false_alarms));
        const double association = share(c.association, static_cast<double>(c.hits));
        hota += std::sqrt(detection * association);
        deta += detection;
        assa += association;
    }
    out.hota = hota / kAlphas;
    out.deta = deta / kAlphas;
    out.assa = assa / kAlphas;
    return out;
}

}  // namespace semtrack::sil
