#include "sil/report/summary.hpp"

#include <algorithm>

#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {

namespace {

constexpr std::size_t kLabelWidth = 15;

void line(std::string& text, std::string label, const std::string& value) {
    label.resize(kLabelWidth, ' ');
    text += label + value + "\n";
}

std::int64_t run_count(const Metrics& metrics, const char* name) {
    for (const auto& [key, value] : metrics.run) {
        if (key == name) {
            return value;
        }
    }
    return 0;
}

void add_ego_errors(std::string& text, const TrajectoryErrors& e) {
    if (e.ate_rmse_m) {
        line(text, "ATE",
             fixed_text(*e.ate_rmse_m, 3) + " m over " + std::to_string(e.frames_compared) + " frames (" +
                 fixed_text(*e.truth_path_length_m, 1) + " m of truth)");
    }
    if (e.rpe_trans_mean_m && e.rpe_rot_mean_deg) {
        line(text, "RPE",
             fixed_text(*e.rpe_trans_mean_m, 4) + " m, " + fixed_text(*e.rpe_rot_mean_deg, 4) + " deg per frame");
    }
    if (e.segment_trans_percent && e.segment_rot_deg_per_100m) {
        line(text, "segments",
             fixed_text(*e.segment_trans_percent, 2) + " %, " + fixed_text(*e.segment_rot_deg_per_100m, 3) +
                 " deg per 100 m");
    }
}

void add_object_errors(std::string& text, const ObjectErrors& e) {
    if (e.recall) {
        line(text, "cars",
             std::to_string(e.matched_cars) + " of " + std::to_string(e.labelled_cars) + " labelled found (" +
                 fixed_text(100.0 * *e.recall, 1) + " %), " + std::to_string(e.id_switches) + " id switches");
    }
    if (e.position_mean_percent && e.heading_median_deg) {
        line(text, "",
             "position off by " + fixed_text(*e.position_mean_percent, 1) + " % of the distance, heading by " +
                 fixed_text(*e.heading_median_deg, 1) + " deg (median)");
    }
    if (e.speed_median_mps) {
        line(text, "", "speed of moving cars off by " + fixed_text(*e.speed_median_mps, 2) + " m/s (median)");
    }
    if (e.parked_speed_median_mps) {
        line(text, "", "speed of parked cars " + fixed_text(*e.parked_speed_median_mps, 3) + " m/s (median)");
    }
}

std::string percent(const std::optional<double>& value) {
    return value ? fixed_text(*value, 1) : std::string("-");
}

void add_object_scores(std::string& text, const ObjectScores& scores) {
    const TrackingScores t = scores.tracking.scores();
    if (t.hota && t.mota) {
        line(text, "tracking",
             "HOTA " + fixed_text(100.0 * *t.hota, 1) + ", MOTA " + fixed_text(100.0 * *t.mota, 1) + ", " +
                 std::to_string(t.id_switches) + " id switches, " + std::to_string(t.fragmentations) +
                 " fragmentations");
    }
    for (std::size_t o = 0; o < kOverlapNames.size(); ++o) {
        std::string row;
        for (std::size_t k = 0; k < 2; ++k) {  // overlaps 0.25 and 0.5, the paper's
            row += (k == 0 ? "" : ", ") + fixed_text(kOverlapThresholds[k], 2) + ": ";
            for (std::size_t d = 0; d < kDifficulties; ++d) {
                row += (d == 0 ? "" : "/") + percent(scores.precision.curve(0, o, k, d).ap40());
            }
        }
        line(text, std::string("AP40 ") + kOverlapNames[o], row + " (easy/moderate/hard, KITTI's rules)");
    }
}

}  // namespace

std::string errors_text(const Metrics& metrics) {
    std::string text;
    add_ego_errors(text, metrics.ego.value_or(TrajectoryErrors{}));
    add_object_errors(text, metrics.objects.value_or(ObjectErrors{}));
    if (metrics.object_scores) {
        add_object_scores(text, *metrics.object_scores);
    }
    return text.empty() ? "no truth to compare with\n" : text;
}

std::string summary_text(const std::string& drive, const Metrics& metrics, const std::vector<double>& total_us,
                         const std::string& out) {
    const ResultCounts& c = metrics.counts;
    std::string text;
    line(text, "drive", drive);
    std::string frames =
        std::to_string(c.frames) + " (" + std::to_string(c.first_frame) + ".." + std::to_string(c.last_frame) + ")";
    const std::int64_t dropped = run_count(metrics, "frames_dropped");
    if (dropped > 0) {
        frames += ", " + std::to_string(dropped) + " of them dropped and predicted";
    }
    line(text, "frames", frames);
    line(text, "ego path", fixed_text(c.path_length_m, 2) + " m");
    line(text, "objects", std::to_string(c.objects) + " confirmed, " + std::to_string(c.object_rows) + " rows");
    text += errors_text(metrics);
    if (!total_us.empty()) {
        line(text, "time a frame",
             fixed_text(1e-3 * *median(total_us), 2) + " ms median, " +
                 fixed_text(1e-3 * *std::max_element(total_us.begin(), total_us.end()), 2) + " ms at most");
    }
    line(text, "CAN",
         std::to_string(run_count(metrics, "can_frames")) + " frames in " +
             std::to_string(run_count(metrics, "can_lists")) + " lists");
    line(text, "results", out);
    return text;
}

}  // namespace semtrack::sil
