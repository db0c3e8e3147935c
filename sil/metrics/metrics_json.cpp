#include "sil/metrics/metrics_json.hpp"

#include <cmath>

#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {

namespace {

std::string number_or_null(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? number_text(*value) : "null";
}

/// Members of one object. Keys are the program's own names: nothing in them needs escaping.
class JsonObject {
public:
    explicit JsonObject(int depth) : indent_(static_cast<std::size_t>(2 * depth), ' ') {}

    void add(const char* key, std::int64_t value) { member(key, std::to_string(value)); }
    void add(const char* key, const std::optional<double>& value) { member(key, number_or_null(value)); }
    void member(const std::string& key, const std::string& value) {
        text_ += text_.empty() ? "" : ",\n";
        text_ += indent_ + "\"" + key + "\": " + value;
    }
    [[nodiscard]] std::string text() const { return "{\n" + text_ + "\n" + indent_.substr(2) + "}"; }

private:
    std::string indent_;
    std::string text_;
};

void add_ego(JsonObject& json, const TrajectoryErrors& e) {
    json.add("ego_frames_compared", std::int64_t{e.frames_compared});
    json.add("truth_path_length_m", e.truth_path_length_m);
    json.add("compared_path_length_m", e.path_length_m);
    json.add("ate_rmse_m", e.ate_rmse_m);
    json.add("rpe_trans_mean_m", e.rpe_trans_mean_m);
    json.add("rpe_trans_rms_m", e.rpe_trans_rms_m);
    json.add("rpe_rot_mean_deg", e.rpe_rot_mean_deg);
    json.add("segments", std::int64_t{e.segments});
    json.add("segment_trans_percent", e.segment_trans_percent);
    json.add("segment_rot_deg_per_100m", e.segment_rot_deg_per_100m);
}

void add_objects(JsonObject& json, const ObjectErrors& e) {
    json.add("labelled_frames_compared", std::int64_t{e.frames_compared});
    json.add("labelled_cars", std::int64_t{e.labelled_cars});
    json.add("matched_cars", std::int64_t{e.matched_cars});
    json.add("car_recall", e.recall);
    json.add("unmatched_rows", std::int64_t{e.unmatched_rows});
    json.add("id_switches", std::int64_t{e.id_switches});
    json.add("car_position_mean_percent", e.position_mean_percent);
    json.add("car_position_median_m", e.position_median_m);
    json.add("car_heading_mean_deg", e.heading_mean_deg);
    json.add("car_heading_median_deg", e.heading_median_deg);
    json.add("car_heading_flip_share", e.heading_flip_share);
    json.add("moving_car_speed_mean_mps", e.speed_mean_mps);
    json.add("moving_car_speed_median_mps", e.speed_median_mps);
    json.add("parked_car_speed_median_mps", e.parked_speed_median_mps);
    json.add("parked_car_speed_p95_mps", e.parked_speed_p95_mps);
    json.add("moving_car_yaw_rates", std::int64_t{e.yaw_rates});
    json.add("moving_car_yaw_rate_mean_radps", e.yaw_rate_mean_radps);
    json.add("moving_car_yaw_rate_median_radps", e.yaw_rate_median_radps);
    json.add("far_cars", std::int64_t{e.far_cars});
    json.add("far_car_recall", e.far_recall);
    json.add("far_car_position_mean_percent", e.far_position_mean_percent);
    json.add("labelled_pedestrians", std::int64_t{e.labelled_pedestrians});
    json.add("pedestrian_recall", e.pedestrian_recall);
    json.add("pedestrian_position_mean_percent", e.pedestrian_position_mean_percent);
    json.add("pedestrian_speed_median_mps", e.pedestrian_speed_median_mps);
    json.add("moving_car_steps", std::int64_t{e.motion_steps});
    json.add("moving_car_motion_trans_mean_m", e.motion_trans_mean_m);
    json.add("moving_car_motion_rot_mean_deg", e.motion_rot_mean_deg);
    json.add("longest_car_track_m", e.longest_track_m);
}

std::string tracking_text(const TrackingScores& s) {
    JsonObject json(2);
    json.add("labels", s.labels);
    json.add("hits", s.hits);
    json.add("misses", s.misses);
    json.add("false_alarms", s.false_alarms);
    json.add("id_switches", s.id_switches);
    json.add("fragmentations", s.fragmentations);
    json.add("mota", s.mota);
    json.add("motp", s.motp);
    json.add("hota", s.hota);
    json.add("deta", s.deta);
    json.add("assa", s.assa);
    return json.text();
}

std::string curve_text(const PrecisionCurve& curve) {
    JsonObject json(5);
    json.add("ap11", curve.ap11());
    json.add("ap40", curve.ap40());
    json.add("labels", curve.labels);
    json.add("hits", curve.hits());
    json.add("false_alarms", curve.false_alarms());
    return json.text();
}

std::string precision_text(const AveragePrecision& precision) {
    JsonObject all(2);
    for (std::size_t r = 0; r < kRuleSets.size(); ++r) {
        JsonObject rules(3);
        for (std::size_t o = 0; o < kOverlapNames.size(); ++o) {
            for (std::size_t t = 0; t < kOverlapThresholds.size(); ++t) {
                JsonObject difficulties(4);
                for (std::size_t d = 0; d < kDifficulties; ++d) {
                    difficulties.member(kDifficultyNames[d], curve_text(precision.curve(r, o, t, d)));
                }
                rules.member(std::string(kOverlapNames[o]) + "_" + kThresholdNames[t], difficulties.text());
            }
        }
        all.member(kRuleSets[r].name, rules.text());
    }
    return all.text();
}

std::string position_mean_text(const PositionMean& mean, int depth) {
    JsonObject json(depth);
    json.add("labels", mean.labels);
    json.add("error_percent", mean.error_percent);
    json.add("recall", mean.labels > 0
                           ? std::optional<double>(static_cast<double>(mean.hits) / static_cast<double>(mean.labels))
                           : std::nullopt);
    return json.text();
}

std::string position_text(const PositionEvaluation& position) {
    JsonObject all(2);
    for (std::size_t d = 0; d < kDifficulties; ++d) {
        const PositionCurve curve = position.curve(d);
        JsonObject json(3);
        json.add("labels", curve.labels);
        json.add("error_percent", curve.points[0].error_percent);
        std::string rates;
        std::string errors;
        for (const PositionCurve::Point& p : curve.points) {
            rates += (rates.empty() ? "" : ", ") + number_or_null(p.rate);
            errors += (errors.empty() ? "" : ", ") + number_or_null(p.error_percent);
        }
        json.member("rate_by_overlap", "[" + rates + "]");
        json.member("error_percent_by_overlap", "[" + errors + "]");
        all.member(kDifficultyNames[d], json.text());
    }
    JsonObject kitti(3);
    for (std::size_t d = 0; d < kDifficulties; ++d) {
        kitti.member(kDifficultyNames[d], position_mean_text(position.kitti(d), 4));
    }
    all.member("kitti", kitti.text());
    all.member("pedestrians", position_mean_text(position.pedestrians(), 3));
    return all.text();
}

std::string agreement_text(const Agreement& a) {
    JsonObject json(2);
    const auto list = [&](const char* key, std::optional<double> TrajectoryErrors::*value) {
        std::string text;
        for (const TrajectoryErrors& e : a.with) {
            text += (text.empty() ? "" : ", ") + number_or_null(e.*value);
        }
        json.member(key, "[" + text + "]");
    };
    list("ate_rmse_m", &TrajectoryErrors::ate_rmse_m);
    list("rpe_trans_mean_m", &TrajectoryErrors::rpe_trans_mean_m);
    list("rpe_rot_mean_deg", &TrajectoryErrors::rpe_rot_mean_deg);
    json.add("own_error_rms_m", a.own_error_rms_m);
    return json.text();
}

std::string features_text(const FeatureStatistics& f) {
    JsonObject json(2);
    json.add("background_mean", f.per_frame_mean);
    json.add("stereo_share", f.stereo_share);
    json.add("track_length_mean", f.track_length_mean);
    json.add("track_length_median", f.track_length_median);
    return json.text();
}

std::string stereo_text(const StereoScores& s) {
    JsonObject json(2);
    json.add("within_2px", s.within_2px);
    json.add("within_1_5px_by_truth", s.within_1_5px_by_truth);
    json.add("reprojection_median_px", s.reprojection_median_px);
    json.add("label_depth_median_percent", s.label_depth_median_percent);
    json.add("label_depth_bias_percent", s.label_depth_bias_percent);
    json.add("label_points", s.label_points);
    json.add("row_offset_px", s.row_offset_px);
    return json.text();
}

std::string consistency_text(const Consistency& c) {
    JsonObject all(2);
    const auto add = [&all](const char* name, const ConsistencyScore& s) {
        JsonObject json(3);
        json.add("count", s.count);
        json.add("mean", s.mean);
        json.add("median", s.median);
        json.add("inside_95", s.inside_95);
        all.member(name, json.text());
    };
    add("nees_position", c.position);
    add("nees_heading", c.heading);
    add("nees_speed", c.speed);
    add("nees_ego_speed", c.ego_speed);
    add("nees_ego_yaw_rate", c.ego_yaw_rate);
    add("nis_box", c.box_nis);
    return all.text();
}

}  // namespace

std::string to_json(const Metrics& metrics) {
    JsonObject json(1);
    const ResultCounts& c = metrics.counts;
    json.add("frames", std::int64_t{c.frames});
    json.add("first_frame", std::int64_t{c.first_frame});
    json.add("last_frame", std::int64_t{c.last_frame});
    json.add("path_length_m", std::optional<double>(c.path_length_m));
    json.add("objects", std::int64_t{c.objects});
    json.add("object_rows", std::int64_t{c.object_rows});
    add_ego(json, metrics.ego.value_or(TrajectoryErrors{}));
    json.member("agreement", metrics.agreement ? agreement_text(*metrics.agreement) : "null");
    add_objects(json, metrics.objects.value_or(ObjectErrors{}));
    json.member("tracking", metrics.object_scores ? tracking_text(metrics.object_scores->tracking.scores()) : "null");
    json.member("average_precision", metrics.object_scores ? precision_text(metrics.object_scores->precision) : "null");
    json.member("position_error", metrics.object_scores ? position_text(metrics.object_scores->position) : "null");
    json.member("consistency", metrics.consistency ? consistency_text(*metrics.consistency) : "null");
    json.member("features", metrics.features ? features_text(*metrics.features) : "null");
    json.member("stereo", metrics.stereo ? stereo_text(*metrics.stereo) : "null");
    if (!metrics.run.empty()) {
        JsonObject run(2);
        for (const auto& [name, value] : metrics.run) {
            run.add(name.c_str(), value);
        }
        json.member("run", run.text());
    } else {
        json.member("run", "null");
    }
    return json.text() + "\n";
}

}  // namespace semtrack::sil
