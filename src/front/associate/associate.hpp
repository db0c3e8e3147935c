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
};
using TrackBoxes = StaticVector<TrackBox, kMaxObjects>;

struct Assignment {
    std::array<int, kMaxObjects> detection_of_track{};  ///< -1: none
    std::array<bool, kMaxDetections> detection_used{};
};

inline constexpr double kLostSimilarity = 0.4;

/// Detectors confuse classes: vehicles with vehicles, people with people.
[[nodiscard]] bool may_be_one(ObjectClass a, ObjectClass b);

/// 0..1: class compatibility x (centre distance relative to the boxes' size, a width
/// counting as half the height at least; and ratio of widths and heights).
[[nodiscard]] double box_similarity(const TrackBox& track, const Detection& detection);

/// The box turned with the camera: a far point at (u, v) moves by the rotation alone. R_cur_prev maps camera
/// coordinates of the earlier frame to the present one.
[[nodiscard]] Box2d rotated_box(const Box2d& box, const Mat3& R_cur_prev, const PinholeCamera& camera);

/// The assignment with the largest sum of what pairs have above kLostSimilarity, so that a pair at the threshold is
/// worth no more than none and a chain of poor pairs does not push out good ones (Hungarian method, at most kMaxObjects
/// x kMaxDetections; ties go to the lower indices). O(tracks^2 detections), no allocation.
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
