// The sliding window of one object: its states, what was measured of it, its size and its landmarks.
//
// States live in L, the local-level frame: W turned so that z is the road's normal near the vehicle (W's own z is
// wrong after a slope). L has W's origin; R_l_w is renewed every cycle and the window is re-expressed (relevel).
#ifndef SEMTRACK_MODEL_OBJECT_WINDOW_HPP
#define SEMTRACK_MODEL_OBJECT_WINDOW_HPP

#include <array>
#include <cstdint>

#include "math/eigen.hpp"
#include "math/pose.hpp"
#include "model/ground_plane.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// Paper Sect. 5, x_ok = {p, theta, v, delta}; the size d is the window's.
struct ObjectState {
    Vec3 p{Vec3::Zero()};  ///< box centre in L, m
    double theta{0};       ///< heading about L's z, rad
    double v{0};           ///< speed along the heading; negative: reversing; m/s
    double delta{0};       ///< steering angle of the bicycle model, rad

    [[nodiscard]] Pose T_l_o() const;
};

/// s_k^t: the 2D box of one frame, in pixels of the detection camera.
struct BoxMeasurement {
    bool valid{false};
    Box2d box{};
    std::array<double, 4> sigma_px{};  ///< per edge (left, right, top, bottom); 0: the edge says nothing (border)
    Viewpoint viewpoint{};
    double score{0};
};

/// z_k^t of one feature: processed pair, px.
struct FeatureObservation {
    bool valid{false};
    bool stereo{false};
    float u{0};
    float v{0};
    float u_right{0};
    float sigma_px{1};
    float sigma_right_px{1};
};

struct ObjectFrame {
    std::uint32_t frame{0};
    std::int64_t time_us{0};
    ObjectState state{};
    Pose T_c_l{};  ///< camera pose of the frame, refreshed from the ego history every cycle
    BoxMeasurement box{};
    GroundPlane ground{};  ///< the road at that frame, without what the object itself says of it
    std::array<FeatureObservation, kMaxObjectFeatures> features{};
};

/// ^k f_n, fixed in the object frame; index = the feature's slot.
struct ObjectLandmark {
    std::uint32_t id{0};
    bool valid{false};
    Vec3 f_o{Vec3::Zero()};
};

struct ObjectWindow {
    ObjectClass object_class{ObjectClass::kCar};
    Mat3 R_l_w{Mat3::Identity()};
    Vec3 size_m{Vec3::Ones()};  ///< d: length, width, height
    Mat3 size_covariance{Mat3::Identity()};
    /// What was known of the size before the window's first frame: the class's prior at first, then what the frames
    /// that have left said.
    Vec3 prior_size_m{Vec3::Ones()};
    Mat3 prior_size_covariance{Mat3::Identity()};
    std::uint32_t prior_frame{0};       ///< newest frame that the prior has used
    int stood{0};                       ///< frames that it was found standing so far
    int contradicted{0};                ///< frames with a box, one after another, that moving explains better
    double heading_information{0};      ///< what frames so far said of its heading while it stood, 1 / rad^2
    bool standing{false};               ///< the standing hypothesis explains the window as well
    Mat6 covariance{Mat6::Identity()};  ///< of the newest state (p, theta, v, delta)
    StaticVector<ObjectFrame, kObjectWindow> frames{};  ///< oldest first
    std::array<ObjectLandmark, kMaxObjectFeatures> landmarks{};

    [[nodiscard]] ObjectFrame& newest() { return frames.back(); }
    [[nodiscard]] const ObjectFrame& newest() const { return frames.back(); }
};

/// Motion of the state over dt [s] without new information: bicycle model at the rear axle for vehicles, straight
/// on for pedestrians (theta is their direction of motion).
[[nodiscard]] ObjectState predicted_state(const ObjectState& x, ObjectClass object_class, const Vec3& size_m,
                                          double dt_s);
/// Moves the window from its present L to the one of R_l_w_new; headings keep their direction in space.
void relevel(ObjectWindow& window, const Mat3& R_l_w_new);
/// Makes room for a new frame: the newest kObjectDenseFrames - 1 stay, of the older ones every kObjectFrameStride-th,
/// and the oldest goes when the window is still full.
void thin_out(ObjectWindow& window);
/// Another choice of the object's axes: x_old = R_z(turn) x_new + shift. Poses of all frames and landmarks move
/// together, so that no feature's projection changes.
void change_object_frame(ObjectWindow& window, const Vec3& shift_o, double turn_rad);
/// Index of the frame with this number; -1: not in the window.
[[nodiscard]] int find_frame(const ObjectWindow& window, std::uint32_t frame);

}  // namespace semtrack

#endif
