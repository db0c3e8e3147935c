#include "sil/metrics/metrics_json.hpp"

#include <cmath>

#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {

namespace {

/// Members of one object. Keys are the program's own names: nothing in them needs escaping.
class JsonObject {
public:
    explicit JsonObject(int depth) : indent_(static_cast<std::size_t>(2 * depth), ' ') {}

    void add(const char* key, std::int64_t value) { member(key, std::to_string(value)); }
    void add(const char* key, const std::optional<double>& value) {
        member(key, value && std::isfinite(*value) ? number_text(*value) : "null");
    }
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
    add_objects(json, metrics.objects.value_or(ObjectErrors{}));
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
