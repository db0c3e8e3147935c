// Association of detections with tracks, paper Sect. 4: 2D box similarity (centre distance and shape) after
// compensating the camera's rotation; a track is not seen when its best similarity is below a threshold.
#ifndef SEMTRACK_FRONT_ASSOCIATE_ASSOCIATE_HPP
#define SEMTRACK_FRONT_ASSOCIATE_ASSOCIATE_HPP

#include <array>

#include "math/eigen.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// Where a track is expected, px of the detection camera.
struct TrackBox {
    Box2d box{};
    ObjectClass object_class{ObjectClass::kCar};
    /// Of what a detection's edges (left, right, top, bottom) may differ from the box: detector and predicted motion;
    /// 0: not known.
    std::array<double, 4> sigma_px{};
};
using TrackBoxes = StaticVector<TrackBox, kMaxObjects>;

struct Assignment {
    std::array<int, kMaxObjects> detection_of_track{};  ///< -1: none
    std::array<bool, kMaxDetections> detection_used{};
};

inline constexpr double kLostSimilarity = 0.4;
inline constexpr double kEdgeTolerance = 4.0;  ///< mean squared residual at which edges agree by half: two sigmas

/// Detectors confuse classes: vehicles with vehicles, people with people.
[[nodiscard]] bool may_be_one(ObjectClass a, ObjectClass b);

/// 0..1: class compatibility x (centre distance relative to the boxes' size, a width
/// counting as half the height at least; and ratio of widths and heights).
[[nodiscard]] double box_similarity(const TrackBox& track, const Detection& detection);

/// 0..1: how well the edges agree, 1 / (1 + mean r^2 / kEdgeTolerance) over the edges that have a sigma; 1 without any.
/// Unlike the similarity it knows how far prediction and detector can be trusted: of two people one behind the other,
/// whose boxes differ by a few pixels, each gets his own.
[[nodiscard]] double edge_agreement(const TrackBox& track, const Detection& detection);

/// What the assignment maximises for a pair: 0 at the lost threshold and below, so that the agreement decides between
/// pairs that are similar enough and never refuses one (as a gate it lost tracks whose motion is not known yet).
[[nodiscard]] double pair_worth(const TrackBox& track, const Detection& detection);

/// The box turned with the camera: a far point at (u, v) moves by the rotation alone. R_cur_prev maps camera
/// coordinates of the earlier frame to the present one.
[[nodiscard]] Box2d rotated_box(const Box2d& box, const Mat3& R_cur_prev, const PinholeCamera& camera);

/// The assignment with the largest sum of pair_worth, which counts from kLostSimilarity, so that a pair at the
/// threshold is worth no more than none and a chain of poor pairs does not push out good ones (Hungarian method, at
/// most kMaxObjects x kMaxDetections; ties go to the lower indices). O(tracks^2 detections), no allocation.
class Associator {
public:
    void run(const TrackBoxes& tracks, const DetectionList& list, Assignment& out);

private:
    void augment(int row, int columns);
    [[nodiscard]] double& cost(int row, int column) { return cost_[static_cast<std::size_t>(row * kColumns + column)]; }
    // One column per detection and one "not seen" column per track, so that every track has a place.
    static constexpr int kColumns = kMaxDetections + kMaxObjects + 1;
    std::array<double, static_cast<std::size_t>(kMaxObjects + 1) * kColumns> cost_{};
    std::array<double, static_cast<std::size_t>(kMaxObjects + 1)> row_potential_{};
    std::array<double, static_cast<std::size_t>(kColumns)> column_potential_{};
    std::array<double, static_cast<std::size_t>(kColumns)> slack_{};
    std::array<int, static_cast<std::size_t>(kColumns)> row_of_column_{};
    std::array<int, static_cast<std::size_t>(kColumns)> previous_{};
    std::array<bool, static_cast<std::size_t>(kColumns)> visited_{};
};

}  // namespace semtrack

#endif
