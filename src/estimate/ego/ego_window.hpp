// Keyframes, landmarks and observations of the background (paper Sect. 5.1).
#ifndef SEMTRACK_ESTIMATE_EGO_EGO_WINDOW_HPP
#define SEMTRACK_ESTIMATE_EGO_EGO_WINDOW_HPP

#include <array>
#include <cstdint>

#include "estimate/factor/stereo_point.hpp"
#include "math/pose.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

/// The keyframes and the current frame.
inline constexpr int kEgoFrames = kEgoWindow + 1;

struct EgoFrame {
    std::uint32_t frame{0};
    int column{0};  ///< where the landmarks keep what this frame saw
    bool keyframe{false};
    Pose T_c_w{};
};

struct EgoObservation {
    bool valid{false};
    bool stereo{false};
    float u{0};
    float v{0};
    float u_right{0};
    float sigma_px{1};
    float sigma_right_px{1};

    [[nodiscard]] StereoPointMeasurement measurement() const {
        StereoPointMeasurement z;
        z.u = static_cast<double>(u);
        z.v = static_cast<double>(v);
        z.u_right = static_cast<double>(u_right);
        z.stereo = stereo;
        z.sigma_px = static_cast<double>(sigma_px);
        z.sigma_right_px = static_cast<double>(sigma_right_px);
        return z;
    }
};

/// Background feature n, ^0 f_n; index = the feature's slot.
struct EgoLandmark {
    std::uint32_t id{0};
    bool valid{false};  ///< x_w is known
    Vec3 x_w{Vec3::Zero()};
    std::array<EgoObservation, kEgoFrames> seen{};  ///< by column
};

struct EgoWindow {
    StaticVector<EgoFrame, kEgoFrames> frames{};  ///< oldest first; the last one is the current frame
    std::array<EgoLandmark, kMaxBackgroundFeatures> landmarks{};

    void clear() {
        frames.clear();
        for (EgoLandmark& l : landmarks) {
            l.id = 0;
            l.valid = false;
        }
    }
};

}  // namespace semtrack

#endif
