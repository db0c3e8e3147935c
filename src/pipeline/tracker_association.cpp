// How far the edges of a detection may lie from where a track is expected: stage 2, association (paper Sect. 4).
#include <cmath>

#include "model/box_geometry.hpp"
#include "pipeline/edge_noise.hpp"
#include "pipeline/tracker_core.hpp"

namespace semtrack {

namespace {

constexpr double kBase_px = 1.0;         // a detector's edges scatter by this and ...
constexpr double kShare = 0.025;         // ... by this share of the box's size
constexpr double kPitch_rad = 0.002;     // of the predicted camera: bumps between two frames
constexpr double kManoeuvre_mps2 = 2.0;  // not in the speed's own variance
constexpr double kOpenDepth_m = 2.0;     // least depth for a projected motion
constexpr double kRepeatOverlap = 0.5;   // of a box with a better one, and ...
constexpr double kDoubtfulShare = 0.5;   // ... the share of its score below which it is that object once more

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

// What a detector draws of an edge behind a nearer object is a guess, or where that object begins.
void TrackerCore::widen_hidden_edges() {
    for (int t = 0; t < boxes_.size(); ++t) {
        std::array<double, 4>& sigma_px = boxes_[t].sigma_px;
        const double guess = hidden_edge_sigma(boxes_[t].box);
        for (int other = 0; other < boxes_.size(); ++other) {
            const std::array<bool, 4> hidden = hidden_edges(boxes_[t].box, boxes_[other].box);
            for (std::size_t e = 0; e < sigma_px.size(); ++e) {
                const double s = sigma_px[e];
                sigma_px[e] = hidden[e] ? std::sqrt(s * s + guess * guess) : s;
            }
        }
    }
}

// A detector's second, doubtful box of an object that a better one has been given to.
bool TrackerCore::is_repeat(int item) const {
    const Detection& doubtful = usable_.items[item];
    for (int other = 0; other < usable_.items.size(); ++other) {
        const Detection& given = usable_.items[other];
        if (assignment_.detection_used[static_cast<std::size_t>(other)] &&
            doubtful.score < kDoubtfulShare * given.score && may_be_one(doubtful.object_class, given.object_class) &&
            box_overlap(doubtful.box, given.box) > kRepeatOverlap) {
            return true;
        }
    }
    return false;
}

}  // namespace semtrack
