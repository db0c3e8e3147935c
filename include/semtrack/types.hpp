// What goes into the tracker and what comes out. Plain data; no Eigen, no computation.
// Frames (docs/frames.md): C left camera (x right, y down, z forward), V vehicle (x forward, y left, z up),
// W world = V at the first frame, O object (x forward along the length, y left, z up, origin at the box's centre).
// SI units, radians, microseconds as int64. T_a_b maps coordinates in b to a.
#ifndef SEMTRACK_TYPES_HPP
#define SEMTRACK_TYPES_HPP

#include <array>
#include <cstdint>

#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

/// x_a = R x_b + t; R row by row.
struct RigidTransform {
    std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
    std::array<double, 3> t{0, 0, 0};
};

enum class ObjectClass : std::uint8_t { kCar = 0, kVan, kTruck, kPedestrian, kCyclist, kTram, kMisc };
inline constexpr int kObjectClasses = 7;

/// Which faces of the box the camera sees: horizontal 0..7 (0 right side, 1 front+right, 2 front, 3 front+left,
/// 4 left side, 5 rear+left, 6 rear, 7 rear+right), vertical 0 top not seen, 1 top seen; -1 unknown.
struct Viewpoint {
    std::int8_t horizontal{-1};
    std::int8_t vertical{-1};
};

/// Edges of a 2D box in pixels of its camera; the centre of the first pixel is at 0.
struct Box2d {
    double left{0};
    double top{0};
    double right{0};
    double bottom{0};
};

struct Detection {
    Box2d box{};
    ObjectClass object_class{ObjectClass::kCar};
    Viewpoint viewpoint{};
    double score{0};
};

/// The detector's answer for the image taken at time_us. An empty list says that nothing was seen; no list at all
/// says nothing.
struct DetectionList {
    std::int64_t time_us{0};
    StaticVector<Detection, kMaxDetections> items{};
    std::uint32_t dropped{0};  ///< detections beyond the capacity, or without overlap with the image
};

/// From the vehicle's own sensors (wheels, gyro), valid at time_us.
struct VehicleMotion {
    std::int64_t time_us{0};
    double speed{0};
    double yaw_rate{0};
    double sigma_speed{0.1};
    double sigma_yaw_rate{0.01};
};

/// A feature from outside the core (a hardware front end that tracks corners, a simulation), px of the processed pair.
/// Not finite, or outside the left image: left out.
struct ExternalFeature {
    std::uint32_t id{0};  ///< the same while it is tracked from frame to frame
    bool stereo{false};   ///< u_right is measured
    float u{0};
    float v{0};
    float u_right{0};
    float sigma_px{0.5F};  ///< of each coordinate; positive
};
using ExternalFeatures = StaticVector<ExternalFeature, kMaxFeatures>;

/// One cycle. Pointers may be null (not there) and need to live for the call only.
struct Input {
    std::int64_t time_us{0};                             ///< of the images; later than the last cycle's
    ImageView left{};                                    ///< empty: a dropped frame, the state is predicted
    ImageView right{};                                   ///< may be empty
    const StaticVector<DetectionList, kMaxDetectionLists>* detections{nullptr};
    const VehicleMotion* motion{nullptr};
    const ExternalFeatures* features{nullptr};           ///< in place of the images' own features
    const RigidTransform* T_w_v{nullptr};                ///< ego pose known from outside: taken as it is
};

enum class EgoStatus : std::uint8_t {
    kStart = 0,   ///< first frame
    kTracked,     ///< from the images
    kPredicted,   ///< no usable image: vehicle motion or the motion model
    kGiven        ///< Input::T_w_v
};

struct EgoState {
    std::int64_t time_us{0};
    EgoStatus status{EgoStatus::kStart};
    RigidTransform T_w_v{};
    std::array<double, 36> covariance{};  ///< of (rotation, translation), perturbed in V: T_w_v exp(xi); row by row
    double speed{0};                      ///< along V's x
    double yaw_rate{0};
    double sigma_speed{0};
    double sigma_yaw_rate{0};
    int features{0};                      ///< background features matched with an earlier frame
    int inliers{0};                       ///< of them, used by the estimate
    int rejected{0};                      ///< of them, refused by RANSAC
};

enum class TrackStatus : std::uint8_t { kNew = 0, kMeasured, kCoasted, kLost };
enum class MovementState : std::uint8_t { kUnknown = 0, kStanding, kMoving, kOncoming, kReversing };

/// One road user. `_w` in W, `_v` in V of this frame; velocities are over ground. A standard deviation of a
/// component that is not estimated (a pedestrian's steering) is 0.
struct TrackedObject {
    std::uint32_t id{0};              ///< never used twice
    int slot{0};                      ///< owner number minus one; stable while the track lives
    ObjectClass object_class{ObjectClass::kCar};
    TrackStatus status{TrackStatus::kNew};
    MovementState movement{MovementState::kUnknown};  ///< unknown: too young, or a speed within its sigma
    double existence{0};              ///< probability, 0..1
    double score{0};                  ///< ranks the objects, 0..1, lower when coasting
    int age{0};                       ///< frames since its first detection
    int features{0};                  ///< matched on it in this frame
    int rejected{0};                  ///< more of them, refused by RANSAC
    bool has_heading{false};          ///< false: yaw is the direction of motion (pedestrians)
    std::array<double, 3> position_w{};
    std::array<double, 3> position_v{};
    std::array<double, 2> velocity_v{};
    double yaw_w{0};
    double yaw_v{0};
    double speed{0};                  ///< along the heading; negative: reversing
    double steering{0};
    double yaw_rate{0};
    std::array<double, 3> size{};     ///< length, width, height
    std::array<double, 3> sigma_position_w{};
    std::array<double, 3> sigma_position_v{};
    std::array<double, 2> sigma_velocity_v{};
    std::array<double, 3> sigma_size{};
    double sigma_yaw{0};
    double sigma_speed{0};
    double sigma_yaw_rate{0};
    Box2d box{};                      ///< processed left image: measured, or the projected box, clipped to the image
    bool box_valid{false};            ///< false: no overlap with the image
    double truncation{0};             ///< share of the projected box outside the image, 0..1
    int occlusion{0};                 ///< 0 visible, 1 partly, 2 largely hidden, 3 unknown
};

/// One feature of this frame, for pictures and point clouds.
struct SparsePoint {
    std::uint8_t owner{0};            ///< 0 background, else slot + 1
    bool has_position{false};
    std::uint32_t id{0};              ///< the same while it is tracked; never used twice
    float u{0};                       ///< left image, px
    float v{0};
    std::array<float, 3> position_w{};
};

/// The CAN bus as the sender sees it.
enum class CanState : std::uint8_t {
    kActive = 0,    ///< nothing is known to be wrong
    kErrorPassive,  ///< the controller counts many errors; frames still go out
    kBusOff,        ///< the controller has left the bus, or has no carrier
    kDown           ///< the interface is down or gone
};

/// Counters only grow; flags are of this frame.
struct Health {
    std::uint32_t frames{0};
    std::uint32_t frames_dropped{0};        ///< without a left image
    std::uint32_t frames_without_right{0};
    std::uint32_t lists_late{0};            ///< lists attached to an earlier frame
    std::uint32_t lists_too_late{0};        ///< older than kMaxDetectionDelay, or of no known frame: dropped
    std::uint32_t detections_dropped{0};    ///< not finite, inverted, outside the image, doubled, or beyond a capacity
    std::uint32_t tracks_dropped{0};        ///< no free slot
    std::uint32_t features_rejected{0};     ///< by RANSAC
    std::uint32_t solves_shortened{0};      ///< objects solved with fewer iterations or without trials: bounded work
    std::uint32_t solver_failures{0};       ///< not one step lowered the cost; the start was kept
    float row_offset_px{0};                 ///< rows that the right image lies lower than the calibration says, measured
                                            ///< slowly: a camera that moved shows here first
    bool ego_degraded{false};               ///< predicted, or few inliers
    bool no_right_image{false};
    bool no_detections{false};              ///< no list came in this frame
    bool road_not_plane{false};             ///< the road ahead leaves the plane of ground contact by more than twice
                                            ///< what is admitted (0.06 m + 0.004 distance), for three frames or more
    std::uint32_t objects_untracked{0};     ///< of this frame: detections beyond a capacity
    std::uint32_t can_lists_dropped{0};     ///< object lists that did not get onto the bus whole, before this one
    CanState can_state{CanState::kActive};  ///< before this frame's list; both are set by Cycle
};

struct Output {
    EgoState ego{};
    StaticVector<TrackedObject, kMaxObjects> objects{};  ///< by slot; lost tracks appear once, with status kLost
    StaticVector<SparsePoint, kMaxFeatures> points{};
    Health health{};
};

}  // namespace semtrack

#endif
