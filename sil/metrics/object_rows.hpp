// Results and labels of road users in one form, and what all object metrics share.
#ifndef SEMTRACK_SIL_METRICS_OBJECT_ROWS_HPP
#define SEMTRACK_SIL_METRICS_OBJECT_ROWS_HPP

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
    std::optional<double> yaw_rate{};  ///< as published; empty: not known
};

struct ObjectTruthSet {
    std::vector<ObjectRow> labels;        ///< type DontCare: an area; only its box counts
    std::vector<int> frames;              ///< labelled frames, growing
    std::map<int, Pose> T_f_c0;           ///< ego truth; empty: no speeds
    std::map<int, std::int64_t> time_us;  ///< of the labelled frames
};

using RowIndices = std::vector<std::size_t>;
[[nodiscard]] std::map<int, RowIndices> rows_by_frame(const std::vector<ObjectRow>& rows);
/// Empty for a frame without rows.
[[nodiscard]] const RowIndices& rows_at(const std::map<int, RowIndices>& rows, int frame);

[[nodiscard]] double box_height(const ObjectRow& row);
/// Share of the box's own area that lies in `area`.
[[nodiscard]] double share_inside(const Box2d& box, const Box2d& area);
/// Half of the box or more lies in one of the areas: KITTI's rule for DontCare.
[[nodiscard]] bool in_an_area(const Box2d& box, const std::vector<Box2d>& areas);

/// One evaluated frame: it was labelled and processed.
struct EvaluatedFrame {
    int frame{0};
    RowIndices labels;  ///< without areas
    RowIndices results;
    std::vector<Box2d> areas;  ///< DontCare
};
[[nodiscard]] std::vector<EvaluatedFrame> evaluated_frames(const std::vector<ObjectRow>& results,
                                                           const std::vector<int>& result_frames,
                                                           const ObjectTruthSet& truth);

/// The truth's signed speed along the heading [m/s] and yaw rate about the vertical, positive to the left [rad/s]:
/// central differences over a track's labels (each neighbour at most 0.5 s away), in the world by the ego truth.
struct TruthMotion {
    double speed{0};
    double yaw_rate{0};
};
/// Index as labels; empty where it is not known.
[[nodiscard]] std::vector<std::optional<TruthMotion>> truth_motions(const ObjectTruthSet& truth);
/// Labels' tracks that stay within a metre of their middle for a second or more, by id.
[[nodiscard]] std::map<int, bool> parked_tracks(const ObjectTruthSet& truth);

/// KITTI object of a row in rectified camera 0: origin at the bottom's middle, x along the heading, y down.
[[nodiscard]] Pose pose_of(const ObjectRow& row);

[[nodiscard]] std::optional<double> mean(const std::vector<double>& values);
/// Middle of the sorted values (mean of both middle ones); empty without values.
[[nodiscard]] std::optional<double> median(std::vector<double> values);
/// Value at rank ceil(share * n).
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double share);

}  // namespace semtrack::sil

#endif
