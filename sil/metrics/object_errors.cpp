#include "sil/metrics/object_errors.hpp"

#include <algorithm>
#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "sil/metrics/track_matching.hpp"

namespace semtrack::sil {

namespace {

constexpr double kLeastHeight_px = 25.0;
constexpr int kMostOccluded = 2;
constexpr double kMostTruncated = 0.5;
constexpr double kFar_m = 50.0;
constexpr double kLeastFarHeight_px = 10.0;
constexpr int kMostPartlyOccluded = 1;
constexpr double kMovingSpeed = 1.0;  // m/s
constexpr double kWalkingSpeed = 0.5;
constexpr std::int64_t kMostStep_us = 500000;
constexpr double kDegrees = 180.0 / kPi;

bool counts(const ObjectRow& label) {
    return label.type == "Car" && box_height(label) >= kLeastHeight_px && label.occluded <= kMostOccluded &&
           label.truncated <= kMostTruncated;
}

/// Small by distance: judged apart, whatever the height.
bool counts_far(const ObjectRow& label) {
    return label.type == "Car" && box_height(label) >= kLeastFarHeight_px && label.occluded <= kMostPartlyOccluded &&
           label.truncated <= kMostTruncated && label.bottom_c0.norm() >= kFar_m;
}

bool counts_as_pedestrian(const ObjectRow& label) {
    return label.type == "Pedestrian" && box_height(label) >= kLeastHeight_px &&
           label.occluded <= kMostPartlyOccluded && label.truncated <= kMostTruncated;
}

double distance_percent(const ObjectRow& label, const ObjectRow& result) {
    return 100.0 * (result.bottom_c0 - label.bottom_c0).norm() / label.bottom_c0.norm();
}

struct Samples {
    std::vector<double> position_percent;
    std::vector<double> position_m;
    std::vector<double> heading_deg;
    std::vector<double> flips;
    std::vector<double> speed;
    std::vector<double> yaw_rate;
    std::vector<double> parked;
    std::vector<double> far_percent;
    std::vector<double> pedestrian_percent;
    std::vector<double> pedestrian_speed;
    std::vector<double> motion_m;
    std::vector<double> motion_deg;
    std::optional<double> longest_track_m{};
};

void add_pair(const ObjectRow& label, const ObjectRow& result, const std::optional<TruthMotion>& motion, bool parked,
              Samples& s) {
    const double error = (result.bottom_c0 - label.bottom_c0).norm();
    const double distance = label.bottom_c0.norm();
    s.position_m.push_back(error);
    if (distance > 0.0) {
        s.position_percent.push_back(100.0 * error / distance);
    }
    const double turn = std::fabs(wrap_angle(result.rotation_y - label.rotation_y)) * kDegrees;
    s.heading_deg.push_back(turn);
    s.flips.push_back(turn > 90.0 ? 1.0 : 0.0);
    if (parked) {
        s.parked.push_back(std::fabs(result.speed));
    } else if (motion && std::fabs(motion->speed) >= kMovingSpeed) {
        s.speed.push_back(std::fabs(result.speed - motion->speed));
        if (result.yaw_rate) {
            s.yaw_rate.push_back(std::fabs(*result.yaw_rate - motion->yaw_rate));
        }
    }
}

/// Far cars and pedestrians.
void add_others(const ObjectRow& label, const ObjectRow& result, const std::optional<TruthMotion>& motion, Samples& s) {
    if (counts_far(label)) {
        s.far_percent.push_back(distance_percent(label, result));
    }
    if (counts_as_pedestrian(label)) {
        s.pedestrian_percent.push_back(distance_percent(label, result));
        if (motion && std::fabs(motion->speed) >= kWalkingSpeed) {
            s.pedestrian_speed.push_back(std::fabs(result.speed - motion->speed));
        }
    }
}

/// Steps from one labelled frame of a track to its next.
class MotionSteps {
public:
    MotionSteps(const ObjectTruthSet& truth, const std::map<int, Pose>& T_f_c0) : truth_(truth), T_f_c0_(T_f_c0) {}

    void add(const ObjectRow& label, const ObjectRow& result, bool moving, Samples& s) {
        const auto truth_ego = truth_.T_f_c0.find(label.frame);
        const auto own_ego = T_f_c0_.find(label.frame);
        const auto time = truth_.time_us.find(label.frame);
        if (truth_ego == truth_.T_f_c0.end() || own_ego == T_f_c0_.end() || time == truth_.time_us.end()) {
            return;
        }
        State now{result.id, time->second, truth_ego->second * pose_of(label), own_ego->second * pose_of(result), 0.0};
        const auto last = last_.find(label.id);
        const bool goes_on = last != last_.end() && last->second.result_id == now.result_id &&
                             now.time_us - last->second.time_us <= kMostStep_us;
        if (goes_on) {
            now.path_m = last->second.path_m + (now.truth.t - last->second.truth.t).norm();
            s.longest_track_m = std::max(s.longest_track_m.value_or(0.0), now.path_m);
        }
        if (goes_on && moving) {
            const Pose truth_step = last->second.truth.inverse() * now.truth;
            const Pose own_step = last->second.own.inverse() * now.own;
            const Pose error = truth_step.inverse() * own_step;
            s.motion_m.push_back(error.t.norm());
            s.motion_deg.push_back(so3_log(orthonormalised(error.R)).norm() * kDegrees);
        }
        last_[label.id] = now;
    }

private:
    struct State {
        int result_id;
        std::int64_t time_us;
        Pose truth;
        Pose own;
        double path_m;  ///< since this result id took over
    };
    const ObjectTruthSet& truth_;
    const std::map<int, Pose>& T_f_c0_;
    std::map<int, State> last_;
};

void summarise(const Samples& s, ObjectErrors& out) {
    out.position_mean_percent = mean(s.position_percent);
    out.position_median_m = median(s.position_m);
    out.heading_median_deg = median(s.heading_deg);
    out.heading_mean_deg = mean(s.heading_deg);
    out.heading_flip_share = mean(s.flips);
    out.speed_mean_mps = mean(s.speed);
    out.speed_median_mps = median(s.speed);
    out.yaw_rates = static_cast<int>(s.yaw_rate.size());
    out.yaw_rate_mean_radps = mean(s.yaw_rate);
    out.yaw_rate_median_radps = median(s.yaw_rate);
    out.parked_speed_median_mps = median(s.parked);
    out.parked_speed_p95_mps = quantile(s.parked, 0.95);
    out.motion_steps = static_cast<int>(s.motion_m.size());
    out.motion_trans_mean_m = mean(s.motion_m);
    out.motion_rot_mean_deg = mean(s.motion_deg);
    out.longest_track_m = s.longest_track_m;
    out.far_position_mean_percent = mean(s.far_percent);
    out.pedestrian_position_mean_percent = mean(s.pedestrian_percent);
    out.pedestrian_speed_median_mps = median(s.pedestrian_speed);
    if (out.labelled_pedestrians > 0) {
        out.pedestrian_recall = static_cast<double>(s.pedestrian_percent.size()) / out.labelled_pedestrians;
    }
    if (out.far_cars > 0) {
        out.far_recall = static_cast<double>(s.far_percent.size()) / out.far_cars;
    }
    if (out.labelled_cars > 0) {
        out.recall = static_cast<double>(out.matched_cars) / out.labelled_cars;
    }
}

int unmatched(const EvaluatedFrame& frame, const std::vector<ObjectRow>& results,
              const std::vector<RowMatch>& matches) {
    int count = 0;
    for (const std::size_t r : frame.results) {
        const bool met = std::any_of(matches.begin(), matches.end(), [r](const RowMatch& m) { return m.result == r; });
        count += !met && !in_an_area(results[r].box, frame.areas) ? 1 : 0;
    }
    return count;
}

}  // namespace

ObjectErrors compare_objects(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                             const ObjectTruthSet& truth, const std::map<int, Pose>& T_f_c0) {
    ObjectErrors out;
    Samples samples;
    const std::vector<EvaluatedFrame> frames = evaluated_frames(results, result_frames, truth);
    const std::vector<std::vector<RowMatch>> matches = match_rows(frames, results, truth.labels);
    const std::vector<std::optional<TruthMotion>> motions = truth_motions(truth);
    const std::map<int, bool> parked = parked_tracks(truth);
    MotionSteps steps(truth, T_f_c0);
    std::map<int, int> last_id;  // label id -> result id, for switches: also over frames without a match
    out.frames_compared = static_cast<int>(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        for (const std::size_t l : frames[f].labels) {
            out.labelled_cars += counts(truth.labels[l]) ? 1 : 0;
            out.far_cars += counts_far(truth.labels[l]) ? 1 : 0;
            out.labelled_pedestrians += counts_as_pedestrian(truth.labels[l]) ? 1 : 0;
        }
        for (const RowMatch& m : matches[f]) {
            const ObjectRow& label = truth.labels[m.label];
            const ObjectRow& result = results[m.result];
            const auto [last, first_time] = last_id.try_emplace(label.id, result.id);
            out.id_switches += !first_time && last->second != result.id ? 1 : 0;
            last->second = result.id;
            add_others(label, result, motions[m.label], samples);
            if (!counts(label)) {
                continue;
            }
            ++out.matched_cars;
            const auto stays = parked.find(label.id);
            const std::optional<TruthMotion>& motion = motions[m.label];
            add_pair(label, result, motion, stays != parked.end() && stays->second, samples);
            steps.add(label, result, motion && std::fabs(motion->speed) >= kMovingSpeed, samples);
        }
        out.unmatched_rows += unmatched(frames[f], results, matches[f]);
    }
    summarise(samples, out);
    return out;
}

}  // namespace semtrack::sil
