#include "sil/evaluation.hpp"

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "publish/object_list.hpp"
#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/label_detections.hpp"
#include "sil/open_drive.hpp"
#include "sil/report/summary.hpp"
#include "sil/report/text_output.hpp"
#include "sil/result_rows.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr const char* kDontCare = "DontCare";

ObjectRow row_of_label(const Label& label) {
    ObjectRow row;
    row.frame = label.frame;
    row.id = label.id;
    row.type = label.type;
    row.truncated = label.truncated;
    row.occluded = label.occluded;
    row.box = label.box;
    row.size_m = Vec3(label.length, label.width, label.height);
    row.bottom_c0 = Vec3(label.x, label.y, label.z);
    row.rotation_y = label.rotation_y;
    return row;
}

std::vector<ObjectRow> label_rows(const Sequence& sequence) {
    DriveCameras cameras = sequence.cameras();
    cameras.calibration.detection = cameras.calibration.left;
    cameras.calibration.t_d_c = {0.0, 0.0, 0.0};
    std::vector<ObjectRow> rows;
    for (const Label& label : sequence.labels()) {
        ObjectRow row = row_of_label(label);
        if (label.type != kDontCare) {
            const auto moved = detections_from_labels({label}, {label.frame}, cameras);
            const std::vector<Detection>& here = moved.at(label.frame);
            if (here.empty()) {
                continue;  // a type that no detection has, or no overlap with the processed image
            }
            row.type = class_name(here.front().object_class);
            row.box = here.front().box;
        }
        rows.push_back(row);
    }
    return rows;
}

Trajectory processed_camera(const std::map<int, RigidTransform>& camera0, const std::array<double, 3>& t_c0_c) {
    const Pose T_c0_c{Mat3::Identity(), Vec3(t_c0_c[0], t_c0_c[1], t_c0_c[2])};
    Trajectory out;
    for (const auto& [frame, T] : camera0) {
        out[frame] = to_pose(T) * T_c0_c;
    }
    return out;
}

ResultCounts count(const Trajectory& ego, const std::vector<ObjectRow>& objects) {
    ResultCounts c;
    c.frames = static_cast<int>(ego.size());
    c.first_frame = ego.begin()->first;
    c.last_frame = ego.rbegin()->first;
    std::vector<Vec3> path;
    for (const auto& [frame, T] : ego) {
        path.push_back(T.t);
    }
    c.path_length_m = path_length(path);
    std::set<int> ids;
    for (const ObjectRow& o : objects) {
        ids.insert(o.id);
    }
    c.objects = static_cast<int>(ids.size());
    c.object_rows = static_cast<int>(objects.size());
    return c;
}

/// Of an older metrics.json, if there is one that can be read.
RunCounts old_run_counts(const fs::path& path) {
    RunCounts out;
    std::ifstream in(path);
    const auto json = nlohmann::ordered_json::parse(in, nullptr, false);
    if (json.is_object() && json.contains("run") && json["run"].is_object()) {
        for (const auto& [name, value] : json["run"].items()) {
            if (value.is_number_integer()) {
                out.emplace_back(name, value.get<std::int64_t>());
            }
        }
    }
    return out;
}

/// A part of an older metrics.json that only the run itself saw: features and stereo matches.
class OldPart {
public:
    OldPart(const fs::path& path, const char* name) {
        std::ifstream in(path);
        const auto json = nlohmann::ordered_json::parse(in, nullptr, false);
        if (json.is_object() && json.contains(name) && json[name].is_object()) {
            json_ = json[name];
        }
    }
    [[nodiscard]] bool empty() const { return json_.empty(); }
    [[nodiscard]] std::optional<double> value(const char* name) const {
        const auto found = json_.find(name);
        return found != json_.end() && found->is_number() ? std::optional<double>(found->get<double>()) : std::nullopt;
    }

private:
    nlohmann::ordered_json json_ = nlohmann::ordered_json::object();
};

std::optional<FeatureStatistics> old_features(const fs::path& path) {
    const OldPart old(path, "features");
    if (old.empty()) {
        return std::nullopt;
    }
    return FeatureStatistics{old.value("background_mean"), old.value("stereo_share"), old.value("track_length_mean"),
                             old.value("track_length_median")};
}

std::optional<StereoScores> old_stereo(const fs::path& path) {
    const OldPart old(path, "stereo");
    if (old.empty()) {
        return std::nullopt;
    }
    return StereoScores{old.value("within_2px"),
                        old.value("within_1_5px_by_truth"),
                        old.value("reprojection_median_px"),
                        old.value("label_depth_median_percent"),
                        old.value("label_depth_bias_percent"),
                        static_cast<std::int64_t>(old.value("label_points").value_or(0.0)),
                        old.value("row_offset_px")};
}

void add_yaw_rates(const std::map<std::pair<int, int>, double>& published, std::vector<ObjectRow>& objects) {
    for (ObjectRow& row : objects) {
        const auto found = published.find({row.frame, row.id % static_cast<int>(kObjectIds)});
        if (found != published.end()) {
            row.yaw_rate = found->second;
        }
    }
}

DriveTruth read_odometry_truth(const DriveOptions& options) {
    const fs::path poses = options.root / "poses" / (options.sequence + ".txt");
    if (!fs::exists(poses)) {
        return truth_of(*open_drive(options));
    }
    DriveTruth truth;
    truth.ego = processed_camera(read_poses(poses, {}), {0.0, 0.0, 0.0});
    return truth;
}

}  // namespace

DriveTruth truth_of(const Sequence& sequence) {
    DriveTruth truth;
    truth.calibration = sequence.cameras().calibration;
    truth.t_c0_c = sequence.cameras().t_c0_c;
    truth.ego = processed_camera(sequence.ego_truth(), truth.t_c0_c);
    truth.objects.labels = label_rows(sequence);
    truth.objects.frames = sequence.labelled_frames();
    for (const auto& [frame, T] : sequence.ego_truth()) {
        truth.objects.T_f_c0[frame] = to_pose(T);
    }
    for (const int frame : truth.objects.frames) {
        if (frame < sequence.first_frame() || frame > sequence.last_frame()) {
            continue;
        }
        truth.objects.time_us[frame] = sequence.time_us(frame);
    }
    return truth;
}

DriveTruth read_truth(const DriveOptions& options) {
    if (options.layout == "odometry") {
        return read_odometry_truth(options);
    }
    try {
        return truth_of(*open_drive(options));
    } catch (const InputError&) {
        DriveOptions without_images = options;
        without_images.images = false;
        try {
            return truth_of(*open_drive(without_images));
        } catch (const InputError&) {
        }
        throw;
    }
}

ResultFiles read_results(const fs::path& dir) {
    ResultFiles out;
    out.frames = read_frame_list(dir / "frames.txt");
    out.ego = read_trajectory(dir, out.frames);
    out.has_objects = fs::exists(dir / "objects.txt");
    if (out.has_objects) {
        out.objects = read_object_rows(dir / "objects.txt");
    }
    if (out.has_objects && fs::exists(dir / "list.csv")) {
        add_yaw_rates(read_yaw_rates(dir / "list.csv"), out.objects);
    }
    if (fs::exists(dir / "states.csv") && fs::exists(dir / "ego.csv")) {
        out.states = read_state_rows(dir / "states.csv");
        out.ego_motion = read_ego_motion_rows(dir / "ego.csv");
    }
    return out;
}

Metrics compare(const ResultFiles& results, const DriveTruth& truth) {
    Metrics metrics;
    metrics.counts = count(results.ego, results.objects);
    if (!truth.ego.empty()) {
        metrics.ego = compare_trajectories(results.ego, truth.ego);
    }
    if (results.has_objects && !truth.objects.labels.empty()) {
        const Pose T_c_c0{Mat3::Identity(), -Vec3(truth.t_c0_c[0], truth.t_c0_c[1], truth.t_c0_c[2])};
        std::map<int, Pose> T_f_c0;
        for (const auto& [frame, T] : results.ego) {
            T_f_c0[frame] = T * T_c_c0;
        }
        metrics.objects = compare_objects(results.objects, results.frames, truth.objects, T_f_c0);
        metrics.object_scores.emplace();
        metrics.object_scores->add(results.objects, results.frames, truth.objects);
    }
    if (!results.ego_motion.empty()) {
        ConsistencyInput in;
        in.objects = &results.objects;
        in.states = &results.states;
        in.ego = &results.ego_motion;
        in.result_frames = &results.frames;
        in.truth = &truth.objects;
        in.T_first_c = results.ego;
        in.truth_T_f_c = truth.ego;
        in.calibration = truth.calibration;
        metrics.consistency = check_consistency(in);
    }
    return metrics;
}

Metrics evaluate_results(const fs::path& dir, const DriveTruth& truth, const std::vector<fs::path>& others) {
    const ResultFiles results = read_results(dir);
    Metrics metrics = compare(results, truth);
    if (!others.empty()) {
        std::vector<Trajectory> trajectories;
        for (const fs::path& other : others) {
            trajectories.push_back(read_trajectory_file(other, results.frames));
        }
        metrics.agreement = compare_with_others(results.ego, trajectories);
    }
    return metrics;
}

void run_evaluate(const EvaluateOptions& options) {
    if (!fs::is_directory(options.results)) {
        throw InputError(options.results.string() + ": no such folder");
    }
    const fs::path path = options.results / "metrics.json";
    Metrics metrics = evaluate_results(options.results, read_truth(options.drive), options.drive.others);
    metrics.run = old_run_counts(path);
    metrics.features = old_features(path);
    metrics.stereo = old_stereo(path);
    const fs::path unfinished = options.results / "metrics.json.unfinished";
    try {
        write_file(unfinished, to_json(metrics));
    } catch (const std::runtime_error& error) {
        throw InputError(error.what());
    }
    fs::rename(unfinished, path);
    const std::string text = to_json(metrics);
    (void)std::fputs(text.c_str(), stdout);
    (void)std::fputs(errors_text(metrics).c_str(), stdout);
}

}  // namespace semtrack::sil
