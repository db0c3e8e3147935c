#include "sil/metrics/object_rows.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "math/trig.hpp"

namespace semtrack::sil {

namespace {

constexpr double kAreaShare = 0.5;  // of a result's own area, in a DontCare area
constexpr double kMostGap_s = 0.5;  // of a central difference, each side
constexpr double kParkedRadius_m = 1.0;
constexpr double kParkedLeastSpan_s = 1.0;

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
        const Pose T_f_o = pose->second * pose_of(label);
        TrackPoint point;
        point.label = i;
        point.time_s = 1e-6 * static_cast<double>(time->second - truth.time_us.begin()->second);
        point.place = T_f_o.t;
        point.heading = T_f_o.R.col(0);
        out[label.id].push_back(point);
    }
    for (auto& [id, points] : out) {
        std::sort(points.begin(), points.end(),
                  [](const TrackPoint& a, const TrackPoint& b) { return a.time_s < b.time_s; });
    }
    return out;
}

/// From a to b about the vertical (y down, so a turn to the left is negative about y).
double turn_left(const Vec3& a, const Vec3& b) {
    return wrap_angle(atan2_rad(b(2), b(0)) - atan2_rad(a(2), a(0)));
}

bool stays(const std::vector<TrackPoint>& points) {
    if (points.back().time_s - points.front().time_s < kParkedLeastSpan_s) {
        return false;
    }
    Vec3 middle;
    for (int k = 0; k < 3; ++k) {
        std::vector<double> values;
        for (const TrackPoint& p : points) {
            values.push_back(p.place(k));
        }
        middle(k) = *median(values);
    }
    return std::all_of(points.begin(), points.end(),
                       [&](const TrackPoint& p) { return (p.place - middle).norm() < kParkedRadius_m; });
}

}  // namespace

std::map<int, RowIndices> rows_by_frame(const std::vector<ObjectRow>& rows) {
    std::map<int, RowIndices> out;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out[rows[i].frame].push_back(i);
    }
    return out;
}

const RowIndices& rows_at(const std::map<int, RowIndices>& rows, int frame) {
    static const RowIndices kNone;
    const auto found = rows.find(frame);
    return found == rows.end() ? kNone : found->second;
}

double box_height(const ObjectRow& row) {
    return row.box.bottom - row.box.top;
}

double share_inside(const Box2d& box, const Box2d& area) {
    const double w = std::min(box.right, area.right) - std::max(box.left, area.left);
    const double h = std::min(box.bottom, area.bottom) - std::max(box.top, area.top);
    const double own = (box.right - box.left) * (box.bottom - box.top);
    return w > 0.0 && h > 0.0 && own > 0.0 ? w * h / own : 0.0;
}

bool in_an_area(const Box2d& box, const std::vector<Box2d>& areas) {
    return std::any_of(areas.begin(), areas.end(),
                       [&](const Box2d& area) { return share_inside(box, area) >= kAreaShare; });
}

std::vector<EvaluatedFrame> evaluated_frames(const std::vector<ObjectRow>& results,
                                             const std::vector<int>& result_frames, const ObjectTruthSet& truth) {
    const std::set<int> processed(result_frames.begin(), result_frames.end());
    const std::map<int, RowIndices> labels = rows_by_frame(truth.labels);
    const std::map<int, RowIndices> rows = rows_by_frame(results);
    std::vector<EvaluatedFrame> out;
    for (const int frame : truth.frames) {
        if (processed.count(frame) == 0U) {
            continue;
        }
        EvaluatedFrame e;
        e.frame = frame;
        e.results = rows_at(rows, frame);
        for (const std::size_t l : rows_at(labels, frame)) {
            if (truth.labels[l].type == "DontCare") {
                e.areas.push_back(truth.labels[l].box);
            } else {
                e.labels.push_back(l);
            }
        }
        out.push_back(std::move(e));
    }
    return out;
}

std::vector<std::optional<TruthMotion>> truth_motions(const ObjectTruthSet& truth) {
    std::vector<std::optional<TruthMotion>> out(truth.labels.size());
    for (const auto& [id, points] : world_tracks(truth)) {
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            const double before = points[i].time_s - points[i - 1].time_s;
            const double after = points[i + 1].time_s - points[i].time_s;
            if (before > kMostGap_s || after > kMostGap_s || !(before + after > 0.0)) {
                continue;
            }
            const Vec3 velocity = (points[i + 1].place - points[i - 1].place) / (before + after);
            const double turn = turn_left(points[i - 1].heading, points[i + 1].heading);
            out[points[i].label] = TruthMotion{velocity.dot(points[i].heading), turn / (before + after)};
        }
    }
    return out;
}

std::map<int, bool> parked_tracks(const ObjectTruthSet& truth) {
    std::map<int, bool> out;
    for (const auto& [id, points] : world_tracks(truth)) {
        out[id] = stays(points);
    }
    return out;
}

Pose pose_of(const ObjectRow& row) {
    const SinCos ry = sin_cos(row.rotation_y);
    Pose T;
    T.R << ry.cos, 0.0, ry.sin,  //
        0.0, 1.0, 0.0,           //
        -ry.sin, 0.0, ry.cos;
    T.t = row.bottom_c0;
    return T;
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

}  // namespace semtrack::sil
