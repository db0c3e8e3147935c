// Are the features where the front end says? Positions of stereo matches, carried into the next frame and compared with
// where the feature is found there; and against the surfaces of labelled boxes.
#ifndef SEMTRACK_SIL_METRICS_STEREO_CHECKS_HPP
#define SEMTRACK_SIL_METRICS_STEREO_CHECKS_HPP

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "semtrack/calibration.hpp"
#include "sil/metrics/object_rows.hpp"
#include "sil/metrics/trajectory.hpp"

namespace semtrack::sil {

struct StereoScores {
    /// Of the background's stereo points that were followed into the next frame: share found there within 2 px of where
    /// the estimated ego-motion carries them. Those that RANSAC refused there count as wrong.
    std::optional<double> within_2px{};
    std::optional<double> within_1_5px_by_truth{};  ///< the same within 1.5 px, by the true ego-motion
    std::optional<double> reprojection_median_px{};
    /// Objects' stereo points seen on the lower half of a labelled box's side (above it, a car's windows and bonnet lie
    /// far inside its box): |z - z of the side| / z of the side, median, and the same with its sign.
    std::optional<double> label_depth_median_percent{};
    std::optional<double> label_depth_bias_percent{};
    std::int64_t label_points{0};
    std::optional<double> row_offset_px{};  ///< at the end, as the tracker reports it
};

class StereoChecker {
public:
    /// t_c0_c: x_c0 = x_c + t_c0_c, from the processed left camera to rectified camera 0, that of the labels.
    StereoChecker(const Calibration& calibration, const std::array<double, 3>& t_c0_c, const Trajectory& ego_truth,
                  const ObjectTruthSet& objects);
    void add(int frame, const Output& output);
    [[nodiscard]] StereoScores scores() const;

private:
    void reproject(int frame, const Output& output, const Pose& T_w_c);
    void compare_with_labels(int frame, const Output& output, const Pose& T_w_c);

    Calibration calibration_;
    Vec3 t_c0_c_;
    const Trajectory& ego_truth_;
    const ObjectTruthSet& objects_;
    std::map<int, RowIndices> labels_;
    int last_frame_{-1};
    Pose last_T_w_c_{};
    std::map<std::uint32_t, Vec3> last_points_;  ///< by id, in the last frame's camera
    std::vector<double> errors_px_;
    std::int64_t refused_{0};
    std::vector<double> truth_errors_px_;
    std::int64_t truth_refused_{0};
    std::vector<double> depth_errors_;
    float row_offset_px_{0};
};

struct SurfacePoint {
    double depth_m{0};  ///< along the camera's z
    double height{0};   ///< over the bottom, share of the box's height
    bool side{false};   ///< on one of the four vertical faces
};
/// Where a ray from the camera meets the surface of a box first. Empty: it does not, or the camera is inside. T_c_o:
/// origin at the bottom's middle, x along the length, y down, z along the width (pose_of).
[[nodiscard]] std::optional<SurfacePoint> surface_point(const Vec3& ray_c, const Pose& T_c_o, const Vec3& size_m);

}  // namespace semtrack::sil

#endif
