#include "sil/metrics/consistency.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "sil/metrics/average_precision.hpp"
#include "sil/metrics/track_matching.hpp"

namespace semtrack::sil {

namespace {

constexpr double kMovingSpeed = 1.0;  // m/s
constexpr double kInside95 = 1.96 * 1.96;
constexpr double kBorder_px = 3.0;
constexpr double kEdgeSigma_px = 0.8;
constexpr double kEdgeSigmaShare = 0.022;  // of the box's height
constexpr double kSideEdges = 1.25;        // left and right edges scatter more

using Key = std::pair<int, int>;  // frame, id

struct Sum {
    std::vector<double> squares;
    void add(double error, double sigma) {
        if (sigma > 0.0 && std::isfinite(error)) {
            squares.push_back(error * error / (sigma * sigma));
        }
    }
    [[nodiscard]] ConsistencyScore score() const {
        ConsistencyScore out;
        out.count = static_cast<std::int64_t>(squares.size());
        out.mean = sil::mean(squares);
        out.median = sil::median(squares);
        if (out.count > 0) {
            const auto inside = std::count_if(squares.begin(), squares.end(), [](double s) { return s <= kInside95; });
            out.inside_95 = static_cast<double>(inside) / static_cast<double>(out.count);
        }
        return out;
    }
};

std::map<Key, const StateRow*> by_key(const std::vector<StateRow>& rows) {
    std::map<Key, const StateRow*> out;
    for (const StateRow& row : rows) {
        out[{row.frame, row.id}] = &row;
    }
    return out;
}

void check_objects(const ConsistencyInput& in, const std::map<Key, const StateRow*>& states, Consistency& out) {
    const Calibration calibration = in.calibration.value_or(Calibration{});
    const Mat3 R_v_c = to_pose(calibration.T_v_c).R;
    const std::vector<EvaluatedFrame> frames = evaluated_frames(*in.objects, *in.result_frames, *in.truth);
    const auto matches = match_rows(frames, *in.objects, in.truth->labels);
    const auto motions = truth_motions(*in.truth);
    Sum position;
    Sum heading;
    Sum speed;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const auto pose = in.T_first_c.find(frames[f].frame);
        for (const RowMatch& m : matches[f]) {
            const ObjectRow& label = in.truth->labels[m.label];
            const ObjectRow& result = (*in.objects)[m.result];
            const auto state = states.find({result.frame, result.id});
            if (!counts_as_car(label, kRuleSets[0].difficulties[2]) || state == states.end() ||
                pose == in.T_first_c.end()) {
                continue;
            }
            const StateRow& s = *state->second;
            const Vec3 error = R_v_c * (pose->second.R * (result.bottom_c0 - label.bottom_c0));
            position.add(error(0), s.sigma_position(0));
            position.add(error(1), s.sigma_position(1));
            heading.add(wrap_angle(result.rotation_y - label.rotation_y), s.sigma_yaw);
            if (motions[m.label] && std::fabs(motions[m.label]->speed) >= kMovingSpeed) {
                speed.add(result.speed - motions[m.label]->speed, s.sigma_speed);
            }
        }
    }
    out.position = position.score();
    out.heading = heading.score();
    out.speed = speed.score();
}

void check_ego(const ConsistencyInput& in, Consistency& out) {
    const Calibration calibration = in.calibration.value_or(Calibration{});
    const Pose T_v_c = to_pose(calibration.T_v_c);
    Sum speed;
    Sum yaw_rate;
    for (std::size_t i = 1; i < in.ego->size(); ++i) {
        const EgoMotionRow& row = (*in.ego)[i];
        const EgoMotionRow& before = (*in.ego)[i - 1U];
        const auto now = in.truth_T_f_c.find(row.frame);
        const auto then = in.truth_T_f_c.find(before.frame);
        if (row.frame != before.frame + 1 || now == in.truth_T_f_c.end() || then == in.truth_T_f_c.end()) {
            continue;
        }
        const double dt = 1e-6 * static_cast<double>(row.time_us - before.time_us);
        const Pose step = T_v_c * then->second.inverse() * now->second * T_v_c.inverse();
        speed.add(row.speed - step.t(0) / dt, row.sigma_speed);
        yaw_rate.add(row.yaw_rate - so3_log(orthonormalised(step.R))(2) / dt, row.sigma_yaw_rate);
    }
    out.ego_speed = speed.score();
    out.ego_yaw_rate = yaw_rate.score();
}

/// State with x, y, z, yaw changed by `change`, dt later, as a box in the image of the camera T_w_c.
bool predict_box(const StateRow& s, const std::array<double, 4>& change, double dt_s, const Pose& T_w_c,
                 const PinholeCamera& camera, Box2d& box) {
    const SinCos yaw = sin_cos(wrap_angle(s.yaw + change[3]));
    Pose T_w_o;
    T_w_o.R << yaw.cos, -yaw.sin, 0.0, yaw.sin, yaw.cos, 0.0, 0.0, 0.0, 1.0;
    T_w_o.t = s.centre_w + Vec3(change[0], change[1], change[2]) + s.speed * dt_s * Vec3(yaw.cos, yaw.sin, 0.0);
    return projected_box(camera, T_w_c.inverse() * T_w_o, s.size_m, box) == Status::kOk;
}

/// Innovations of one detection's edges.
void add_innovations(const StateRow& s, const ObjectRow& now, double dt_s, const Pose& T_w_c,
                     const Calibration& calibration, Sum& sum) {
    constexpr std::array<double, 4> kSteps{0.01, 0.01, 0.01, 0.002};
    const std::array<double, 4> sigmas{s.sigma_position(0), s.sigma_position(1), s.sigma_position(2), s.sigma_yaw};
    std::array<Box2d, 5> boxes{};
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        std::array<double, 4> change{};
        if (k > 0) {
            change[k - 1U] = kSteps[k - 1U];
        }
        if (!predict_box(s, change, dt_s, T_w_c, calibration.left, boxes[k])) {
            return;
        }
    }
    for (int edge = 0; edge < kBoxEdges; ++edge) {
        const double value = edge_value(now.box, edge);
        const double limit = (edge == kLeft || edge == kRight) ? calibration.width - 1.0 : calibration.height - 1.0;
        if (value < kBorder_px || value > limit - kBorder_px) {
            continue;
        }
        const double own = kEdgeSigmaShare * box_height(now);
        double variance = (kEdgeSigma_px * kEdgeSigma_px + own * own) *
                          (edge == kLeft || edge == kRight ? kSideEdges * kSideEdges : 1.0);
        for (std::size_t k = 0; k < sigmas.size(); ++k) {
            const double slope = (edge_value(boxes[k + 1U], edge) - edge_value(boxes[0], edge)) / kSteps[k];
            variance += slope * slope * sigmas[k] * sigmas[k];
        }
        sum.add(value - edge_value(boxes[0], edge), std::sqrt(variance));
    }
}

void check_innovations(const ConsistencyInput& in, const std::map<Key, const StateRow*>& states, Consistency& out) {
    const Calibration& calibration = *in.calibration;
    const Pose T_v_c = to_pose(calibration.T_v_c);
    std::map<int, std::int64_t> times;
    for (const EgoMotionRow& row : *in.ego) {
        times[row.frame] = row.time_us;
    }
    Sum sum;
    for (const ObjectRow& now : *in.objects) {
        const auto state = states.find({now.frame, now.id});
        const auto before = states.find({now.frame - 1, now.id});
        const auto pose = in.T_first_c.find(now.frame);
        const auto time = times.find(now.frame);
        const auto time_before = times.find(now.frame - 1);
        if (state == states.end() || !state->second->measured || before == states.end() || now.occluded > 0 ||
            pose == in.T_first_c.end() || time == times.end() || time_before == times.end()) {
            continue;
        }
        const double dt_s = 1e-6 * static_cast<double>(time->second - time_before->second);
        add_innovations(*before->second, now, dt_s, T_v_c * pose->second, calibration, sum);
    }
    out.box_nis = sum.score();
}

}  // namespace

Consistency check_consistency(const ConsistencyInput& input) {
    Consistency out;
    const std::map<Key, const StateRow*> states = by_key(*input.states);
    check_objects(input, states, out);
    check_ego(input, out);
    if (input.calibration) {
        check_innovations(input, states, out);
    }
    return out;
}

}  // namespace semtrack::sil
