// Feature observations r_Z of one object over its window, paper Eq. (11)-(12) [eq:feature-factor]: one lane per point.
// factor/stereo_point.hpp defines residual and derivative; here they are computed for all points of a frame at once.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_FEATURES_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_FEATURES_HPP

#include <array>
#include <cstdint>

#include "estimate/object/object_variables.hpp"
#include "estimate/solver/normal_equations.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

struct alignas(kLaneBytes) Lane : std::array<double, static_cast<std::size_t>(kMaxObjectFeatures)> {};

class ObjectFeatures {
public:
    /// Landmarks of the window that two frames or more saw become the points. enabled = false: there are none.
    void begin(const ObjectWindow& window, const Calibration& calibration, bool enabled);
    [[nodiscard]] int points() const { return points_; }
    [[nodiscard]] std::size_t slot(int p) const {
        return static_cast<std::size_t>(slot_of_point_[static_cast<std::size_t>(p)]);
    }
    /// 0.5 sum of robustified squares at x; keeps what add_to() needs.
    [[nodiscard]] double evaluate(const ObjectVariables& x);
    /// Adds the points' share of the normal equations at the x of the last evaluate().
    void add_to(NormalEquations& system) const;

private:
    /// One frame: what was measured, and projection, residuals and robust weight at the last x.
    struct FrameLanes {
        bool seen_any{false};
        Mat3 R_c_l{Mat3::Identity()};
        Vec3 t_c_l{Vec3::Zero()};
        double cos{1};
        double sin{0};
        // Measured, all times 1 / sigma: focal lengths and the distance from the principal point. 0: not seen.
        Lane focal_u{};
        Lane focal_v{};
        Lane focal_right{};  // 0 also without a right view
        Lane u{};
        Lane v{};
        Lane u_right{};
        Lane behind{};  // -1: seen, so that it costs something behind the camera; 0: not seen
        Lane x{};
        Lane y{};
        Lane inv_z{};
        std::array<Lane, 3> r{};
        Lane rho{};
        Lane robust{};  // root of the weight, which r has already
    };
    void gather_frame(const ObjectFrame& frame, FrameLanes& lanes) const;
    void project(const ObjectState& state, FrameLanes& lanes) const;
    [[nodiscard]] double robust_cost(FrameLanes& lanes) const;
    void add_frame(int k, NormalEquations& system) const;

    Calibration calibration_{};
    bool has_heading_{true};
    int frames_{0};
    int points_{0};
    std::size_t lane_count_{0};
    std::array<std::int16_t, kMaxObjectFeatures> slot_of_point_{};
    std::array<Lane, 3> f_{};
    std::array<FrameLanes, kObjectWindow> frame_lanes_{};
};

}  // namespace semtrack

#endif
