// A drive past random landmarks: what the matcher would hand over, and the true poses.
#ifndef SEMTRACK_TESTS_ESTIMATE_EGO_DRIVE_SCENE_HPP
#define SEMTRACK_TESTS_ESTIMATE_EGO_DRIVE_SCENE_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "math/camera.hpp"
#include "math/so3.hpp"
#include "model/feature.hpp"
#include "semtrack/types.hpp"
#include "support/noise.hpp"

namespace semtrack {

struct DriveOptions {
    int features{250};
    double noise_px{0.2};
    double step_m{0.8};
    double gain_m{0.0};              ///< of the step, a frame
    double turn_rad{0.01};           ///< a frame
    double disparity_error_px{0.0};  ///< of all features alike
    double outlier_share{0.0};       ///< of the features of a frame, off by 5 to 30 px
    double survival{0.85};           ///< of a feature, from frame to frame
    std::uint32_t seed{1};
};

/// Frames are asked for in order, from 0. The camera of frame 0 is the world.
class DriveScene {
public:
    static constexpr std::int64_t kFrame_us = 100000;

    explicit DriveScene(const DriveOptions& options) : options_(options), rng_(options.seed), step_m_(options.step_m) {
        calibration_.width = 1242;
        calibration_.height = 375;
        calibration_.left = {720.0, 720.0, 610.0, 173.0};
        calibration_.right = calibration_.left;
        calibration_.detection = calibration_.left;
        calibration_.baseline_m = 0.54;
    }

    [[nodiscard]] const Calibration& calibration() const { return calibration_; }
    [[nodiscard]] const Pose& T_w_c() const { return T_w_c_; }

    /// Speed and yaw rate of the last motion as wheels and gyroscope measure them.
    [[nodiscard]] VehicleMotion vehicle_motion() {
        VehicleMotion out;
        const double dt_s = 1e-6 * static_cast<double>(kFrame_us);
        out.speed = step_m_ / dt_s + out.sigma_speed * normal(rng_);
        out.yaw_rate = -options_.turn_rad / dt_s + out.sigma_yaw_rate * normal(rng_);
        return out;
    }

    /// Moves the camera on (not before frame 0) and measures.
    void next(FrameFeatures& out) {
        if (frame_ > 0) {
            Pose motion;
            motion.R = so3_exp(Vec3(0.0, options_.turn_rad, 0.0));
            step_m_ += options_.gain_m;
            motion.t = Vec3(0.0, 0.0, step_m_);
            T_w_c_ = T_w_c_ * motion;
        }
        ++frame_;
        out.clear();
        for (std::size_t slot = 0; slot < static_cast<std::size_t>(options_.features); ++slot) {
            measure(slot, out);
        }
    }

private:
    struct Landmark {
        std::uint32_t id{0};
        Vec3 x_w{Vec3::Zero()};
        std::uint16_t age{0};
        FeatureMeasurement last{};
    };

    [[nodiscard]] bool seen(const Vec3& x_c) const {
        if (x_c(2) < 2.0) {
            return false;
        }
        const Vec2 p = project(calibration_.left, x_c);
        return p(0) > 0.0 && p(0) < 1241.0 && p(1) > 0.0 && p(1) < 374.0;
    }

    void measure(std::size_t slot, FrameFeatures& out) {
        Landmark& l = landmarks_[slot];
        const Pose T_c_w = T_w_c_.inverse();
        bool tracked = l.id != 0 && seen(T_c_w * l.x_w) && rng_.uniform() < options_.survival;
        if (!tracked) {
            // Near points are many: the road and what stands beside it.
            const double depth = 5.0 / (1.0 - 0.92 * rng_.uniform());
            const Vec3 x_c = bearing(calibration_.left, between(rng_, 5.0, 1236.0), between(rng_, 5.0, 370.0)) * depth;
            l = {next_id_++, T_w_c_ * x_c, 0, {}};
        }
        const Vec3 x_c = T_c_w * l.x_w;
        const Vec2 p = project(calibration_.left, x_c);
        FeatureMeasurement m;
        m.id = l.id;
        m.slot = static_cast<std::int16_t>(slot);
        m.stereo = true;
        m.tracked = tracked;
        m.age = tracked ? ++l.age : std::uint16_t{0};
        const bool wrong = tracked && rng_.uniform() < options_.outlier_share;
        const double jump = wrong ? between(rng_, 5.0, 30.0) * (rng_.below(2) == 0 ? 1.0 : -1.0) : 0.0;
        m.u = static_cast<float>(p(0) + jump + options_.noise_px * normal(rng_));
        m.v = static_cast<float>(p(1) + 0.5 * jump + options_.noise_px * normal(rng_));
        m.u_right = static_cast<float>(right_column(calibration_, p(0), x_c(2)) + jump - options_.disparity_error_px +
                                       options_.noise_px * normal(rng_));
        m.v_right = m.v;
        m.previous_u = l.last.u;
        m.previous_v = l.last.v;
        m.previous_u_right = l.last.u_right;
        m.previous_stereo = tracked;
        m.sigma_px = m.sigma_right_px = static_cast<float>(options_.noise_px > 0.25 ? options_.noise_px : 0.25);
        l.last = m;
        (void)out.try_push_back(m);
    }

    DriveOptions options_;
    Rng rng_;
    double step_m_;
    Calibration calibration_{};
    Pose T_w_c_{};
    std::uint32_t next_id_{1};
    int frame_{0};
    std::array<Landmark, kMaxBackgroundFeatures> landmarks_{};
};

}  // namespace semtrack

#endif
