#include "sil/metrics/stereo_checks.hpp"

#include <algorithm>
#include <cmath>

#include "math/camera.hpp"

namespace semtrack::sil {

namespace {

constexpr double kBodyHeight = 0.5;

std::optional<double> share_below(const std::vector<double>& errors, std::int64_t refused, double limit) {
    const auto total = static_cast<double>(errors.size()) + static_cast<double>(refused);
    if (errors.empty()) {
        return std::nullopt;
    }
    return static_cast<double>(std::count_if(errors.begin(), errors.end(), [=](double e) { return e < limit; })) /
           total;
}

}  // namespace

std::optional<SurfacePoint> surface_point(const Vec3& ray_c, const Pose& T_c_o, const Vec3& size_m) {
    const Vec3 origin = T_c_o.R.transpose() * -T_c_o.t;
    const Vec3 ray = T_c_o.R.transpose() * ray_c;
    const Vec3 low(-0.5 * size_m(0), -size_m(2), -0.5 * size_m(1));
    const Vec3 high(0.5 * size_m(0), 0.0, 0.5 * size_m(1));
    double enter = -1e9;
    double leave = 1e9;
    int face = 0;  // axis of the face where the ray enters
    for (int i = 0; i < 3; ++i) {
        if (std::fabs(ray(i)) < 1e-12) {
            if (origin(i) < low(i) || origin(i) > high(i)) {
                return std::nullopt;
            }
            continue;
        }
        const double a = (low(i) - origin(i)) / ray(i);
        const double b = (high(i) - origin(i)) / ray(i);
        if (std::min(a, b) > enter) {
            enter = std::min(a, b);
            face = i;
        }
        leave = std::min(leave, std::max(a, b));
    }
    if (!(enter > 0.0) || !(enter < leave)) {
        return std::nullopt;
    }
    return SurfacePoint{enter * ray_c(2), -(origin(1) + enter * ray(1)) / size_m(2), face != 1};
}

StereoChecker::StereoChecker(const Calibration& calibration, const std::array<double, 3>& t_c0_c,
                             const Trajectory& ego_truth, const ObjectTruthSet& objects)
    : calibration_(calibration),
      t_c0_c_(t_c0_c[0], t_c0_c[1], t_c0_c[2]),
      ego_truth_(ego_truth),
      objects_(objects),
      labels_(rows_by_frame(objects.labels)) {}

void StereoChecker::reproject(int frame, const Output& output, const Pose& T_w_c) {
    const Pose T_cur_prev = T_w_c.inverse() * last_T_w_c_;
    const auto before = ego_truth_.find(last_frame_);
    const auto now = ego_truth_.find(frame);
    const bool truth = before != ego_truth_.end() && now != ego_truth_.end();
    const Pose T_true = truth ? now->second.inverse() * before->second : Pose{};
    for (const SparsePoint& point : output.points) {
        const auto last = last_points_.find(point.id);
        if (point.owner != 0 || last == last_points_.end()) {
            continue;
        }
        const Vec2 at(static_cast<double>(point.u), static_cast<double>(point.v));
        const auto error = [&](const Pose& T) {
            const Vec3 x_c = T * last->second;
            return x_c(2) > kMinDepth_m ? (project(calibration_.left, x_c) - at).norm() : 1e9;
        };
        errors_px_.push_back(error(T_cur_prev));
        if (truth) {
            truth_errors_px_.push_back(error(T_true));
        }
    }
    refused_ += output.ego.rejected;
    truth_refused_ += truth ? output.ego.rejected : 0;
}

void StereoChecker::compare_with_labels(int frame, const Output& output, const Pose& T_w_c) {
    const Pose T_c_w = T_w_c.inverse();
    for (const SparsePoint& point : output.points) {
        if (point.owner == 0 || !point.has_position) {
            continue;
        }
        const Vec3 ray = bearing(calibration_.left, static_cast<double>(point.u), static_cast<double>(point.v));
        std::optional<SurfacePoint> nearest;
        for (const std::size_t i : rows_at(labels_, frame)) {
            const ObjectRow& label = objects_.labels[i];
            if (label.type == "DontCare") {
                continue;
            }
            Pose T_c_o = pose_of(label);
            T_c_o.t -= t_c0_c_;
            const std::optional<SurfacePoint> point_o = surface_point(ray, T_c_o, label.size_m);
            if (point_o && (!nearest || point_o->depth_m < nearest->depth_m)) {
                nearest = point_o;
            }
        }
        if (nearest && nearest->side && nearest->height < kBodyHeight) {
            const Vec3 x_w(static_cast<double>(point.position_w[0]), static_cast<double>(point.position_w[1]),
                           static_cast<double>(point.position_w[2]));
            depth_errors_.push_back(((T_c_w * x_w)(2) - nearest->depth_m) / nearest->depth_m);
        }
    }
}

void StereoChecker::add(int frame, const Output& output) {
    const Pose T_w_c = to_pose(output.ego.T_w_v) * to_pose(calibration_.T_v_c);
    if (last_frame_ >= 0 && frame == last_frame_ + 1 && output.ego.status == EgoStatus::kTracked) {
        reproject(frame, output, T_w_c);
    }
    compare_with_labels(frame, output, T_w_c);
    last_points_.clear();
    const Pose T_c_w = T_w_c.inverse();
    for (const SparsePoint& point : output.points) {
        if (point.owner == 0 && point.has_position) {
            last_points_[point.id] =
                T_c_w * Vec3(static_cast<double>(point.position_w[0]), static_cast<double>(point.position_w[1]),
                             static_cast<double>(point.position_w[2]));
        }
    }
    last_frame_ = frame;
    last_T_w_c_ = T_w_c;
    row_offset_px_ = output.health.row_offset_px;
}

StereoScores StereoChecker::scores() const {
    StereoScores out;
    out.within_2px = share_below(errors_px_, refused_, 2.0);
    out.within_1_5px_by_truth = share_below(truth_errors_px_, truth_refused_, 1.5);
    out.reprojection_median_px = median(errors_px_);
    std::vector<double> sizes;
    for (const double e : depth_errors_) {
        sizes.push_back(100.0 * std::fabs(e));
    }
    out.label_depth_median_percent = median(sizes);
    out.label_points = static_cast<std::int64_t>(sizes.size());
    if (const std::optional<double> middle = median(depth_errors_)) {
        out.label_depth_bias_percent = 100.0 * *middle;
    }
    out.row_offset_px = static_cast<double>(row_offset_px_);
    return out;
}

}  // namespace semtrack::sil
