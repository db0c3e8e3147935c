// Ego-motion: a live pose per frame from a sliding window of keyframes on the background (paper Sect. 5.1).
// W_c, the world of this estimator, is the first camera frame. The published pose is never revised; the history is.
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_ESTIMATOR_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_ESTIMATOR_HPP

#include "estimate/ego/calibration_error.hpp"
#include "estimate/ego/ego_prediction.hpp"
#include "estimate/ego/ego_problem.hpp"
#include "estimate/ego/given_heading.hpp"
#include "estimate/ego/pose_tracker.hpp"
#include "estimate/solver/levenberg_marquardt.hpp"
#include "model/ego_history.hpp"
#include "model/feature.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct EgoInput {
    std::uint32_t frame{0};  ///< grows by one every cycle, from 1
    std::int64_t time_us{0};
    const FrameFeatures* features{nullptr};  ///< rows with owner 0 are used
    bool has_images{false};
    const VehicleMotion* motion{nullptr};
    const Pose* given_T_w_c{nullptr};  ///< pose known from outside
};

struct EgoResult {
    EgoStatus status{EgoStatus::kStart};
    Pose T_w_c{};       ///< to publish: a given pose as it was given
    Pose T_w_camera{};  ///< the same, but for a given pose turned to where the camera really looks (given_heading.hpp)
    Pose T_prev_cur{};  ///< motion since the last frame, in the camera
    double dt_s{0};
    Mat6 covariance{Mat6::Zero()};         ///< of T_w_c (translation, rotation), perturbed in the current camera
    Mat6 motion_covariance{Mat6::Zero()};  ///< of T_prev_cur, likewise
    int features{0};                       ///< matched with an earlier frame
    int inliers{0};                        ///< landmarks that the current frame saw where the estimate has them
    StaticVector<std::int16_t, kMaxBackgroundFeatures> outliers{};  ///< slots that the estimate refused
};

class EgoEstimator {
public:
    void init(const Calibration& calibration);
    /// Motion to expect until time_us, as T_cur_prev: a point in the last camera frame -> in the coming one. From the
    /// vehicle's sensors when given, else the last motion scaled by the time. Identity before the first frame.
    [[nodiscard]] Pose predicted_motion(std::int64_t time_us, const VehicleMotion* motion) const;
    /// Where the camera looks when given_T_w_c is given, by what is known so far of the given poses' heading.
    [[nodiscard]] Pose camera_pose(const Pose& given_T_w_c) const;
    /// One frame. Cost: a pose fit of 14 and a window of 5 iterations; system and step are workspace.
    /// kInvalidArgument: time or frame number do not grow, or a given pose that is not finite; out and the state are
    /// untouched. kNotConverged: the images did not give a pose and it was predicted (status kPredicted); the window
    /// starts anew with this frame.
    Status process(const EgoInput& input, NormalEquations& system, SolverStep& step, EgoResult& out);
    [[nodiscard]] const EgoHistory& history() const { return history_; }

private:
    [[nodiscard]] MotionPrediction predict(std::int64_t time_us, const VehicleMotion* motion) const;
    [[nodiscard]] bool acceptable(const EgoInput& input) const;
    [[nodiscard]] bool track(const EgoInput& input, const MotionPrediction& predicted, NormalEquations& system,
                             SolverStep& step, EgoResult& out, Mat6& covariance);
    void push_frame(std::uint32_t frame, const Pose& T_c_w);
    void restart(const EgoInput& input, const Pose& T_c_w);
    void solve_window(NormalEquations& system, SolverStep& step, Mat6& covariance);
    [[nodiscard]] double residual_variance() const;
    void cull(EgoResult& out);
    [[nodiscard]] bool needs_keyframe() const;
    void make_keyframe();
    void remember(const EgoInput& input, const Pose& T_w_c);
    [[nodiscard]] Pose take_given(const EgoInput& input);
    void finish(const EgoInput& input, EgoStatus status, const Pose& T_w_c, const Mat6& motion_covariance,
                const DisparityResponse& response, EgoResult& out);

    Calibration calibration_{};
    Pose T_v_c_{};
    EgoWindow window_{};
    EgoProblem problem_{};
    EgoHistory history_{};
    bool started_{false};
    std::uint32_t frame_{0};
    std::int64_t time_us_{0};
    Pose T_w_c_{};
    Pose T_cur_prev_{};              // last motion
    double dt_s_{0};                 // ... and the time it took
    Mat6 covariance_{Mat6::Zero()};  // of T_w_c by noise
    DisparityResponse response_{};   // of T_w_c
    GivenHeading heading_{};
    bool given_{false};          // the last pose was given ...
    Pose given_T_w_c_{};         // ... as it was given
    double noise_{1.0};          // variance of the residuals, in stated sigmas
    int keyframe_landmarks_{0};  // that the newest keyframe saw
};

}  // namespace semtrack

#endif
