#include "sil/metrics/trajectory.hpp"

#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "sil/metrics/jacobi.hpp"

namespace semtrack::sil {

namespace {

constexpr double kSegment_m = 100.0;  // KITTI's segment lengths: 100, 200, ... 800 m
constexpr int kSegmentLengths = 8;
constexpr std::size_t kSegmentStep = 10;  // frames from start to start, as KITTI's own evaluation

struct PairedPoses {
    std::vector<int> frames;
    std::vector<Pose> result;
    std::vector<Pose> truth;
};

PairedPoses pair_by_frame(const Trajectory& result, const Trajectory& truth) {
    PairedPoses out;
    for (const auto& [frame, pose] : result) {
        const auto other = truth.find(frame);
        if (other != truth.end()) {
            out.frames.push_back(frame);
            out.result.push_back({orthonormalised(pose.R), pose.t});
            out.truth.push_back({orthonormalised(other->second.R), other->second.t});
        }
    }
    return out;
}

std::vector<Vec3> positions(const std::vector<Pose>& poses) {
    std::vector<Vec3> out;
    for (const Pose& T : poses) {
        out.push_back(T.t);
    }
    return out;
}

Vec3 mean(const std::vector<Vec3>& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) {
        sum += p;
    }
    return sum / static_cast<double>(points.size());
}

double degrees(double rad) {
    return rad * (180.0 / kPi);
}

Mat3 rotation(double w, double x, double y, double z) {
    Mat3 R;
    R << w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),  //
        2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x),   //
        2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z;
    return R;
}

double ate_rmse(const std::vector<Vec3>& result, const std::vector<Vec3>& truth) {
    const Pose T = align_se3(result, truth);
    double sum = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        sum += (truth[i] - T * result[i]).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(result.size()));
}

/// What is left of a step of the result after a step of the truth.
Pose step_error(const PairedPoses& p, std::size_t from, std::size_t to) {
    const Pose truth = p.truth[from].inverse() * p.truth[to];
    const Pose result = p.result[from].inverse() * p.result[to];
    return truth.inverse() * result;
}

void relative_errors(const PairedPoses& p, TrajectoryErrors& out) {
    double trans = 0.0;
    double squares = 0.0;
    double rot = 0.0;
    int count = 0;
    for (std::size_t i = 1; i < p.frames.size(); ++i) {
        if (p.frames[i] != p.frames[i - 1] + 1) {
            continue;
        }
        const Pose error = step_error(p, i - 1, i);
        trans += error.t.norm();
        squares += error.t.squaredNorm();
        rot += so3_log(error.R).norm();
        ++count;
    }
    if (count > 0) {
        out.rpe_trans_mean_m = trans / count;
        out.rpe_trans_rms_m = std::sqrt(squares / count);
        out.rpe_rot_mean_deg = degrees(rot) / count;
    }
}

void segment_errors(const PairedPoses& p, TrajectoryErrors& out) {
    std::vector<double> along{0.0};
    for (std::size_t i = 1; i < p.truth.size(); ++i) {
        along.push_back(along.back() + (p.truth[i].t - p.truth[i - 1].t).norm());
    }
    double trans = 0.0;
    double rot = 0.0;
    for (std::size_t first = 0; first < along.size(); first += kSegmentStep) {
        std::size_t last = first;
        for (int k = 1; k <= kSegmentLengths; ++k) {
            const double length = kSegment_m * k;
            while (last < along.size() && !(along[last] > along[first] + length)) {
                ++last;
            }
            if (last == along.size()) {
                break;
            }
            const Pose error = step_error(p, first, last);
            trans += error.t.norm() / length;
            rot += so3_log(error.R).norm() / length;
            ++out.segments;
        }
    }
    if (out.segments > 0) {
        out.segment_trans_percent = 100.0 * trans / out.segments;
        out.segment_rot_deg_per_100m = 100.0 * degrees(rot) / out.segments;
    }
}

}  // namespace

Pose align_se3(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    const Vec3 from_mean = mean(from);
    const Vec3 to_mean = mean(to);
    Mat3 S = Mat3::Zero();
    for (std::size_t i = 0; i < from.size(); ++i) {
        S += (from[i] - from_mean) * (to[i] - to_mean).transpose();
    }
    std::array<std::array<double, 4>, 4> N{};
    N[0] = {S(0, 0) + S(1, 1) + S(2, 2), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0)};
    N[1] = {N[0][1], S(0, 0) - S(1, 1) - S(2, 2), S(0, 1) + S(1, 0), S(2, 0) + S(0, 2)};
    N[2] = {N[0][2], N[1][2], S(1, 1) - S(0, 0) - S(2, 2), S(1, 2) + S(2, 1)};
    N[3] = {N[0][3], N[1][3], N[2][3], S(2, 2) - S(0, 0) - S(1, 1)};
    const SymmetricEigen<4> e = symmetric_eigen(N);
    std::size_t best = 0;
    for (std::size_t k = 1; k < 4; ++k) {
        best = e.values[k] > e.values[best] ? k : best;
    }
    const std::array<double, 4>& q = e.vectors[best];
    Pose T;
    T.R = orthonormalised(rotation(q[0], q[1], q[2], q[3]));
    T.t = to_mean - T.R * from_mean;
    return T;
}

double path_length(const std::vector<Vec3>& points) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        sum += (points[i] - points[i - 1]).norm();
    }
    return sum;
}

TrajectoryErrors compare_trajectories(const Trajectory& result, const Trajectory& truth) {
    TrajectoryErrors out;
    const PairedPoses paired = pair_by_frame(result, truth);
    out.frames_compared = static_cast<int>(paired.frames.size());
    if (paired.frames.empty()) {
        return out;
    }
    const std::vector<Vec3> result_points = positions(paired.result);
    const std::vector<Vec3> truth_points = positions(paired.truth);
    out.path_length_m = path_length(result_points);
    out.truth_path_length_m = path_length(truth_points);
    out.ate_rmse_m = ate_rmse(result_points, truth_points);
    relative_errors(paired, out);
    segment_errors(paired, out);
    return out;
}

}  // namespace semtrack::sil
