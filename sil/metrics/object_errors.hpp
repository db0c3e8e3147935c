// Errors of tracked objects against labels, on labelled frames only.
#ifndef SEMTRACK_SIL_METRICS_OBJECT_ERRORS_HPP
#define SEMTRACK_SIL_METRICS_OBJECT_ERRORS_HPP

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "math/pose.hpp"
#include "semtrack/types.hpp"

namespace semtrack::sil {

/// A row of objects.txt, or a label brought into its terms: 2D box in pixels of the processed left image, bottom
/// centre and rotation_y in rectified camera 0.
struct ObjectRow {
    int frame{0};
    int id{0};
    std::string type;
    double truncated{0};
    int occluded{0};
    Box2d box{};
    Vec3 size_m{Vec3::Zero()};  ///< length, width, height
    Vec3 bottom_c0{Vec3::Zero()};
    double rotation_y{0};
    double score{0};
    double speed{0};
};

struct ObjectTruthSet {
    std::vector<ObjectRow> labels;        ///< type DontCare: an area; only its box counts
    std::vector<int> frames;              ///< labelled frames, growing
    std::map<int, Pose> T_f_c0;           ///< ego truth; empty: no speeds
    std::map<int, std::int64_t> time_us;  ///< of the labelled frames
};

struct ObjectErrors {
    int frames_compared{0};
    int labelled_cars{0};  ///< cars 25 px high or more, occluded 2 or less, truncated 0.5 or less
    int matched_cars{0};
    int unmatched_rows{0};  ///< results that meet no label and no DontCare area
    int id_switches{0};
    std::optional<double> recall{};
    std::optional<double> position_mean_percent{};  ///< 3D distance of the bottom centres / the label's distance
    std::optional<double> position_median_m{};
    std::optional<double> heading_median_deg{};
    std::optional<double> heading_mean_deg{};
    std::optional<double> heading_flip_share{};  ///< off by more than 90 degrees
    std::optional<double> speed_mean_mps{};      ///< |speed - truth's|, cars that move
    std::optional<double> speed_median_mps{};
    std::optional<double> parked_speed_median_mps{};  ///< |speed| of cars whose labels stay within 1 m
    std::optional<double> parked_speed_p95_mps{};
};

/// A result and a label meet when their 2D boxes overlap by an IoU of 0.5 or more and their classes are one (Car and
/// Van count as one). A pair of the frame before stays while it still meets; the rest is matched greedily by falling
/// IoU. Result rows of frames that are not labelled say nothing. `result_frames`: frames that were processed.
[[nodiscard]] ObjectErrors compare_objects(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                                           const ObjectTruthSet& truth);

/// The truth's signed speed along the heading: central difference over a track's labels (each neighbour at most 0.5 s
/// away), in the world by the ego truth. Index as labels; empty where it is not known.
[[nodiscard]] std::vector<std::optional<double>> truth_speeds(const ObjectTruthSet& truth);

/// Middle of the sorted values (mean of both middle ones); empty without values.
[[nodiscard]] std::optional<double> median(std::vector<double> values);
/// Value at rank ceil(share * n).
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double share);

}  // namespace semtrack::sil

#endif
