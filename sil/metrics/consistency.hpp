// Are the published standard deviations true? Squared errors over their variances: 1 on average when they are.
#ifndef SEMTRACK_SIL_METRICS_CONSISTENCY_HPP
#define SEMTRACK_SIL_METRICS_CONSISTENCY_HPP

#include "semtrack/calibration.hpp"
#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

/// A row of states.csv. W, metres and radians.
struct StateRow {
    int frame{0};
    int id{0};
    bool measured{false};  ///< status new or measured
    Vec3 centre_w{Vec3::Zero()};
    double yaw{0};
    double speed{0};
    Vec3 size_m{Vec3::Zero()};
    Vec3 sigma_position{Vec3::Zero()};
    double sigma_yaw{0};
    double sigma_speed{0};
};

/// A row of ego.csv; rows without speed (the first) are left out.
struct EgoMotionRow {
    int frame{0};
    std::int64_t time_us{0};
    double speed{0};
    double yaw_rate{0};
    double sigma_speed{0};
    double sigma_yaw_rate{0};
};

/// One kind of error. A standard deviation of 0 (not estimated) is left out.
struct ConsistencyScore {
    std::int64_t count{0};
    std::optional<double> mean{};       ///< of (error / sigma)^2, per degree of freedom
    std::optional<double> median{};     ///< 0.455 for normal errors
    std::optional<double> inside_95{};  ///< share with |error| <= 1.96 sigma
};

/// NEES: normalised estimation error squared, against the truth (labels of cars that counts_as_car under KITTI's hard
/// rule, matched by the 2D boxes). Standard deviations are in W, so correlations between axes are left out. The truth's
/// own noise counts as error. NIS: normalised innovation squared, without truth: each edge of a detection's box against
/// the box predicted from the track's state one frame before (constant velocity, published standard deviations of
/// position and heading, edges sqrt(0.8^2 + (0.022 height)^2) px, a quarter more left and right); edges within 3 px of
/// the image's border and hidden objects are left out.
struct Consistency {
    ConsistencyScore position{};  ///< horizontal, x and y of W
    ConsistencyScore heading{};
    ConsistencyScore speed{};
    ConsistencyScore ego_speed{};
    ConsistencyScore ego_yaw_rate{};
    ConsistencyScore box_nis{};
};

struct ConsistencyInput {
    const std::vector<ObjectRow>* objects{nullptr};
    const std::vector<StateRow>* states{nullptr};
    const std::vector<EgoMotionRow>* ego{nullptr};
    const std::vector<int>* result_frames{nullptr};
    const ObjectTruthSet* truth{nullptr};
    std::map<int, Pose> T_first_c{};           ///< the result's ego poses, processed camera
    std::map<int, Pose> truth_T_f_c{};         ///< truth of the same; may be empty
    std::optional<Calibration> calibration{};  ///< empty: no NIS. W: V of the first frame by its mount
};

[[nodiscard]] Consistency check_consistency(const ConsistencyInput& input);

}  // namespace semtrack::sil

#endif
