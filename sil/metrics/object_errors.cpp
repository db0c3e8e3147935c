#include "sil/metrics/object_errors.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "math/trig.hpp"
#include "model/box_geometry.hpp"

namespace semtrack::sil {

namespace {

constexpr double kMeetingOverlap = 0.5;
constexpr double kLeastHeight_px = 25.0;
constexpr int kMostOccluded = 2;
constexpr double kMostTruncated = 0.5;
constexpr double kMostGap_s = 0.5;  // of a central difference, each side
constexpr double kParkedRadius_m = 1.0;
constexpr double kParkedLeastSpan_s = 1.0;
constexpr double kMovingSpeed = 1.0;    // m/s
constexpr double kDontCareShare = 0.5;  // of a result's own area

using Indices = std::vector<std::size_t>;

std::map<int, Indices> by_frame(const std::vector<ObjectRow>& rows) {
    std::map<int, Indices> out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out[rows[i].frame].push_back(i);
    }
    return out;
}

const Indices& at_frame(const std::map<int, Indices>& rows, int frame) {
    static const Indices kNone;
    const auto found = rows.find(frame);
    return found == rows.end() ? kNone : found->second;
}

std::string family(const std::string& type) {
    return type == "Van" ? "Car" : type;
}

bool is_car(const ObjectRow& label) {
    return label.type == "Car";
}

bool counts(const ObjectRow& label) {
    return is_car(label) && label.box.bottom - label.box.top >= kLeastHeight_px && label.occluded <= kMostOccluded &&
           label.truncated <= kMostTruncated;
}

double share_inside(const Box2d& box, const Box2d& area) {
    const double w = std::min(box.right, area.right) - std::max(box.left, area.left);
    const double h = std::min(box.bottom, area.bottom) - std::max(box.top, area.top);
    const double own = (box.right - box.left) * (box.bottom - box.top);
    return w > 0.0 && h > 0.0 && own > 0.0 ? w * h / own : 0.0;
}

struct Match {
    std::size_t label;
    std::size_t result;
};

bool meet(const ObjectRow& label, const ObjectRow& result, double& overlap) {
    if (family(label.type) != family(result.type)) {
        return false;
    }
    overlap = box_overlap(label.box, result.box);
    return overlap >= kMeetingOverlap;
}

/// last_id: label id -> result id of its last match; kept and updated.
class FrameMatcher {
public:
    FrameMatcher(const std::vector<ObjectRow>& labels, const std::vector<ObjectRow>& results)
        : labels_(labels), results_(results) {}

    std::vector<Match> match(const Indices& labels, const Indices& results) {
        std::vector<Match> out;
        std::set<std::size_t> used_labels;
        std::set<std::size_t> used_results;
        const auto take = [&](std::size_t l, std::size_t r) {
            out.push_back({l, r});
            used_labels.insert(l);
            used_results.insert(r);
        };
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (const std::size_t l : labels) {
            for (const std::size_t r : results) {
                double overlap = 0.0;
                if (!meet(labels_[l], results_[r], overlap)) {
                    continue;
                }
                pairs.emplace_back(-overlap, l, r);
                const auto last = last_frame_ids_.find(labels_[l].id);
                if (last != last_frame_ids_.end() && last->second == results_[r].id && used_labels.count(l) == 0U &&
                    used_results.count(r) == 0U) {
                    take(l, r);
                }
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [overlap, l, r] : pairs) {
            if (used_labels.count(l) == 0U && used_results.count(r) == 0U) {
                take(l, r);
            }
        }
        last_frame_ids_.clear();
        for (const Match& m : out) {
            last_frame_ids_[labels_[m.label].id] = results_[m.result].id;
        }
        return out;
    }

private:
    const std::vector<ObjectRow>& labels_;
    const std::vector<ObjectRow>& results_;
    std::map<int, int> last_frame_ids_;
};

/// Labels of a track in the order of their frames, with their place in the world.
struct TrackPoint {
    std::size_t label{0};
    double time_s{0};
    Vec3 place{Vec3::Zero()};
    Vec3 heading{Vec3::Zero()};
};

std::map<int, std::vector<TrackPoint>> world_tracks(const ObjectTruthSet& truth) {
    std::map<int, std::vector<TrackPoint>> out;
    for (std::size_t i = 0; i < truth.labels.size(); ++i) {
        const ObjectRow& label = truth.labels[i];
        const auto pose = truth.T_f_c0.find(label.frame);
        const auto time = truth.time_us.find(label.frame);
        if (label.type == "DontCare" || pose == truth.T_f_c0.end() || time == truth.time_us.end()) {
            continue;
        }
        const SinCos ry = sin_cos(label.rotation_y);
        TrackPoint point;
        point.label = i;
        point.time_s = 1e-6 * static_cast<double>(time->second - truth.time_us.begin()->second);
        point.place = pose->second * label.bottom_c0;
        point.heading = pose->second.R * Vec3(ry.cos, 0.0, -ry.sin);
        out[label.id].push_back(point);
    }
    for (auto& [id, points] : out) {
        std::sort(points.begin(), points.end(),
                  [](const TrackPoint& a, const TrackPoint& b) { return a.time_s < b.time_s; });
    }
    return out;
}

/// Ids of tracks that stay within a metre of their middle for a second or more.
std::set<int> parked_tracks(const ObjectTruthSet& truth) {
    std::set<int> out;
    for (const auto& [id, points] : world_tracks(truth)) {
        if (points.back().time_s - points.front().time_s < kParkedLeastSpan_s) {
            continue;
        }
        Vec3 middle;
        for (int k = 0; k < 3; ++k) {
            std::vector<double> values;
            for (const TrackPoint& p : points) {
                values.push_back(p.place(k));
            }
            middle(k) = *median(values);
        }
        const bool stays = std::all_of(points.begin(), points.end(), [&](const TrackPoint& p) {
            return (p.place - middle).norm() < kParkedRadius_m;
        });
        if (stays) {
            out.insert(id);
        }
    }
    return out;
}

std::optional<double> mean(const std::vector<double>& values) {
    if (values.empty()) {
        return std::nullopt;
    }
    double sum = 0.0;
    for (const double v : values) {
        sum += v;
    }
    return sum / static_cast<double>(values.size());
}

struct Samples {
    std::vector<double> position_percent;
    std::vector<double> position_m;
    std::vector<double> heading_deg;
    std::vector<double> flips;
    std::vector<double> speed;
    std::vector<double> parked;
};

void add_pair(const ObjectRow& label, const ObjectRow& result, const std::optional<double>& speed, bool parked,
              Samples& s) {
    const double error = (result.bottom_c0 - label.bottom_c0).norm();
    const double distance = label.bottom_c0.norm();
    s.position_m.push_back(error);
    if (distance > 0.0) {
        s.position_percent.push_back(100.0 * error / distance);
    }
    const double turn = std::fabs(wrap_angle(result.rotation_y - label.rotation_y)) * (180.0 / kPi);
    s.heading_deg.push_back(turn);
    s.flips.push_back(turn > 90.0 ? 1.0 : 0.0);
    if (parked) {
        s.parked.push_back(std::fabs(result.speed));
    } else if (speed && std::fabs(*speed) >= kMovingSpeed) {
        s.speed.push_back(std::fabs(result.speed - *speed));
    }
}

void summarise(const Samples& s, ObjectErrors& out) {
    out.position_mean_percent = mean(s.position_percent);
    out.position_median_m = median(s.position_m);
    out.heading_median_deg = median(s.heading_deg);
    out.heading_mean_deg = mean(s.heading_deg);
    out.heading_flip_share = mean(s.flips);
    out.speed_mean_mps = mean(s.speed);
    out.speed_median_mps = median(s.speed);
    out.parked_speed_median_mps = median(s.parked);
    out.parked_speed_p95_mps = quantile(s.parked, 0.95);
    if (out.labelled_cars > 0) {
        out.recall = static_cast<double>(out.matched_cars) / out.labelled_cars;
    }
}

int unmatched(const std::vector<ObjectRow>& results, const Indices& here, const std::vector<Match>& matches,
              const std::vector<Box2d>& dont_care) {
    int count = 0;
    for (const std::size_t r : here) {
        const bool met = std::any_of(matches.begin(), matches.end(), [r](const Match& m) { return m.result == r; });
        const bool ignored = std::any_of(dont_care.begin(), dont_care.end(), [&](const Box2d& area) {
            return share_inside(results[r].box, area) >= kDontCareShare;
        });
        count += !met && !ignored ? 1 : 0;
    }
    return count;
}

}  // namespace

std::optional<double> median(std::vector<double> values) {
    if (values.empty()) {
        return std::nullopt;
    }
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2U == 1U ? values[n / 2U] : 0.5 * (values[n / 2U - 1U] + values[n / 2U]);
}

std::optional<double> quantile(std::vector<double> values, double share) {
    if (values.empty()) {
        return std::nullopt;
    }
    std::sort(values.begin(), values.end());
    const double n = static_cast<double>(values.size());
    const auto rank = static_cast<std::size_t>(std::min(std::max(std::ceil(share * n), 1.0), n));
    return values[rank - 1U];
}

std::vector<std::optional<double>> truth_speeds(const ObjectTruthSet& truth) {
    std::vector<std::optional<double>> out(truth.labels.size());
    for (const auto& [id, points] : world_tracks(truth)) {
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            const double before = points[i].time_s - points[i - 1].time_s;
            const double after = points[i + 1].time_s - points[i].time_s;
            if (before > kMostGap_s || after > kMostGap_s || !(before + after > 0.0)) {
                continue;
            }
            const Vec3 velocity = (points[i + 1].place - points[i - 1].place) / (before + after);
            out[points[i].label] = velocity.dot(points[i].heading);
        }
    }
    return out;
}

ObjectErrors compare_objects(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                             const ObjectTruthSet& truth) {
    ObjectErrors out;
    Samples samples;
    const std::set<int> processed(result_frames.begin(), result_frames.end());
    const std::map<int, Indices> labels = by_frame(truth.labels);
    const std::map<int, Indices> rows = by_frame(results);
    const std::vector<std::optional<double>> speeds = truth_speeds(truth);
    const std::set<int> parked = parked_tracks(truth);
    FrameMatcher matcher(truth.labels, results);
    std::map<int, int> last_id;  // label id -> result id, for switches: also over frames without a match
    for (const int frame : truth.frames) {
        if (processed.count(frame) == 0U) {
            continue;
        }
        ++out.frames_compared;
        Indices objects;
        std::vector<Box2d> dont_care;
        for (const std::size_t l : at_frame(labels, frame)) {
            if (truth.labels[l].type == "DontCare") {
                dont_care.push_back(truth.labels[l].box);
            } else {
                objects.push_back(l);
                out.labelled_cars += counts(truth.labels[l]) ? 1 : 0;
            }
        }
        const Indices& here = at_frame(rows, frame);
        const std::vector<Match> matches = matcher.match(objects, here);
        for (const Match& m : matches) {
            const ObjectRow& label = truth.labels[m.label];
            const auto [last, first_time] = last_id.try_emplace(label.id, results[m.result].id);
            out.id_switches += !first_time && last->second != results[m.result].id ? 1 : 0;
            last->second = results[m.result].id;
            if (counts(label)) {
                ++out.matched_cars;
                add_pair(label, results[m.result], speeds[m.label], parked.count(label.id) != 0U, samples);
            }
        }
        out.unmatched_rows += unmatched(results, here, matches, dont_care);
    }
    summarise(samples, out);
    return out;
}

}  // namespace semtrack::sil
