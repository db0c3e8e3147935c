// Keyframes, landmarks and observations of the background (paper Sect. 5.1).
//
// The window holds the newest kDenseFrames frames whatever they are (points near the road live for a few frames only
// and say most about the motion), and of the older ones the keyframes.
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_WINDOW_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_WINDOW_HPP

#include <array>
#include <cstdint>

#include "estimate/ego/vehicle_factor.hpp"
#include "estimate/factor/stereo_point.hpp"
#include "math/pose.hpp"
#include "model/feature.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

/// The keyframes and the current frame.
inline constexpr int kEgoFrames = kEgoWindow + 1;
inline constexpr int kDenseFrames = 3;
static_assert(kDenseFrames < kEgoFrames, "room for keyframes");

struct EgoFrame {
    std::uint32_t frame{0};
    int column{0};  ///< where the landmarks keep what this frame saw
    bool keyframe{false};
    Pose T_c_w{};
    std::uint32_t step_from{0};  ///< frame that the vehicle's step starts at
    VehicleStep step{};          ///< what the vehicle says of the motion from there
};

struct EgoObservation {
    bool valid{false};
    bool stereo{false};
    float u{0};
    float v{0};
    float u_right{0};
    float sigma_px{1};
    float sigma_right_px{1};

    [[nodiscard]] StereoPointMeasurement measurement() const;
};

/// A point outlives its feature: what older frames of the window saw of it still ties their poses together, and a
/// window of 500 features that live for 6 frames has seen some 1000 points.
inline constexpr int kEgoLandmarks = 2 * kMaxBackgroundFeatures;

/// Background feature n, ^0 f_n.
struct EgoLandmark {
    bool used{false};
    std::uint32_t id{0};    ///< of the feature
    std::int16_t slot{-1};  ///< of the feature while it lives
    bool valid{false};      ///< x_w is known
    Vec3 x_w{Vec3::Zero()};
    std::array<EgoObservation, kEgoFrames> seen{};  ///< by column

    /// x_w and all observations are forgotten.
    void forget();
    /// Forgotten, and free for another feature.
    void release();
};

struct EgoWindow {
    StaticVector<EgoFrame, kEgoFrames> frames{};  ///< oldest first; the last one is the current frame
    std::array<EgoLandmark, static_cast<std::size_t>(kEgoLandmarks)> landmarks{};
    std::array<std::int16_t, static_cast<std::size_t>(kMaxBackgroundFeatures)> landmark_of_slot{};  ///< -1: none

    void clear();
    /// The index of the frame that must leave before the next push; -1: there is room and nothing too old.
    [[nodiscard]] int leaving() const;
    void drop(int index);
    /// Makes room with drop(leaving()) first. The new frame has seen nothing yet.
    void push(std::uint32_t frame, const Pose& T_c_w);
    /// What the current frame measured. Rows of other owners, with a slot out of range or with numbers that are not
    /// finite are left out. A new id starts a new landmark; when none is free, the one that was seen last the longest
    /// ago and has no feature any more goes.
    void take(const FrameFeatures& features, const Calibration& calibration);
    /// Landmarks without a position start at the stereo point of the current frame.
    void give_birth(const Calibration& calibration);
    /// Newest keyframe before the current frame; -1: none.
    [[nodiscard]] int last_keyframe() const;

    [[nodiscard]] const EgoObservation& seen(int landmark, const EgoFrame& frame) const {
        return landmarks[static_cast<std::size_t>(landmark)].seen[static_cast<std::size_t>(frame.column)];
    }

private:
    void release_unseen();
    [[nodiscard]] int free_landmark(int from) const;
};

}  // namespace semtrack

#endif
