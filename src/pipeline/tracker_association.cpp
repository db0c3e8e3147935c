// How far the edges of a detection may lie from where a track is expected: stage 2, association (paper Sect. 4).
#include <cmath>

#include "pipeline/tracker_core.hpp"

namespace semtrack {

namespace {

constexpr double kBase_px = 1.0;         // a detector's edges scatter by this and ...
constexpr double kShare = 0.025;         // ... by this share of the box's size
constexpr double kPitch_rad = 0.002;     // of the predicted camera: bumps between two frames
constexpr double kManoeuvre_mps2 = 2.0;  // not in the speed's own variance
constexpr double kOpenDepth_m = 2.0;     // least depth for a projected motion

}  // namespace

// The projected box of a track was fitted to earlier boxes, so its own position's uncertainty (mostly depth against
// size) is not seen in the image: what counts is the motion since it was last detected, and the detector.
std::array<double, 4> TrackerCore::edge_tolerance(const Track& track, int index, const Box2d& expected) const {
    const ObjectWindow& window = track.window;
    const ObjectFrame& frame = window.frames[index];
    std::int64_t seen_us = window.frames[0].time_us;
    for (int k = 0; k < index; ++k) {
        seen_us = window.frames[k].box.valid ? window.frames[k].time_us : seen_us;
    }
    const double dt_s = 1e-6 * static_cast<double>(frame.time_us - seen_us);
    const Mat6& C = window.covariance;
    const double v = frame.state.v;
    const double speed_variance = C(4, 4) + v * v * C(3, 3);
    const double manoeuvre = 0.5 * kManoeuvre_mps2 * dt_s * dt_s;
    const double moved_m = std::sqrt(speed_variance * dt_s * dt_s + manoeuvre * manoeuvre);
    const double ahead = (frame.T_c_l * frame.state.p)(2);
    const double depth = ahead > kOpenDepth_m ? ahead : kOpenDepth_m;
    const PinholeCamera& camera = calibration_.detection;
    const double width = expected.right - expected.left;
    const double height = expected.bottom - expected.top;
    // Sideways a motion is seen whole, along the line of sight by the change of scale about the horizon.
    const double across = camera.fx * moved_m / depth;
    const double scaled = moved_m / depth;
    const auto sigma = [&](double size, double own, double moved) {
        const double s = kShare * size;
        return std::sqrt(kBase_px * kBase_px + s * s + own * own + moved * moved);
    };
    const double bump = camera.fy * kPitch_rad;
    return {sigma(width, bump, across), sigma(width, bump, across),
            sigma(height, bump, scaled * std::fabs(expected.top - camera.cy)),
            sigma(height, bump, scaled * std::fabs(expected.bottom - camera.cy))};
}

}  // namespace semtrack
