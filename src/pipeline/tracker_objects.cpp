// Stages 7 to 10: ego-motion on the background, every object's window, alignment to its points, lifecycle
// (paper Sect. 5).
#include <cmath>

#include "estimate/align/align_box.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"
#include "pipeline/tracker_core.hpp"

namespace semtrack {

namespace {
constexpr double kBehind_m = -1.0;     // the centre may pass the camera by so much while the front is still seen
constexpr double kMaxRange_m = 200.0;  // what the CAN list covers
}  // namespace

void TrackerCore::feed_features() {
    for (int s = 0; s < kMaxObjects; ++s) {
        tracks_[s].features = 0;
    }
    for (const FeatureMeasurement& m : features_) {
        if (m.owner == kBackground || m.owner > kMaxObjects) {
            continue;
        }
        Track& track = tracks_[m.owner - 1];
        if (!track.alive) {
            continue;
        }
        const auto slot = static_cast<std::size_t>(m.slot);
        ObjectLandmark& landmark = track.window.landmarks[slot];
        if (landmark.id != m.id) {  // the slot was given to another feature
            landmark.id = m.id;
            landmark.valid = false;
            for (ObjectFrame& frame : track.window.frames) {
                frame.features[slot].valid = false;
            }
        }
        FeatureObservation& o = track.window.newest().features[slot];
        o.valid = true;
        o.stereo = m.stereo;
        o.u = m.u;
        o.v = m.v;
        o.u_right = m.u_right;
        o.sigma_px = m.sigma_px;
        o.sigma_right_px = m.sigma_right_px;
        track.features += m.tracked ? 1 : 0;
    }
}

void TrackerCore::share_solver() {
    SolveWork work{};
    for (int s = 0; s < kMaxObjects; ++s) {
        work[static_cast<std::size_t>(s)] = tracks_[s].alive ? iteration_work(tracks_[s].window) : 0;
    }
    health_.solves_shortened += static_cast<std::uint32_t>(share_out(work, frame_, shares_));
}

// Every object by itself: a job reads the camera's poses, the road and its share, and writes its own track and report.
void TrackerCore::solve_objects() {
    begin(Stage::kObjects);
    share_solver();
    StaticVector<int, kMaxObjects> slots;
    for (int s = 0; s < kMaxObjects; ++s) {
        if (tracks_[s].alive) {
            refresh_poses(tracks_[s]);
            tracks_[s].window.newest().ground = ground_.plane(s);
            (void)slots.try_push_back(s);
        }
    }
    SolveJobs jobs({team_, worker_, slots, shares_, tracks_, solve_reports_});
    team_.run(jobs, slots.size());
    for (const int s : slots) {
        const ObjectSolveReport& report = solve_reports_[static_cast<std::size_t>(s)];
        health_.solver_failures += report.solved ? 0U : 1U;
        for (const std::int16_t slot : report.culled) {
            drop_feature(s + 1, slot);
        }
    }
    end(Stage::kObjects);
}

void TrackerCore::align_objects() {
    if (!config_.cues.alignment || !config_.cues.features) {
        return;
    }
    begin(Stage::kAlign);
    for (int s = 0; s < kMaxObjects; ++s) {
        AlignmentReport report;  // without enough points nothing is aligned, and that is no failure
        if (tracks_[s].alive) {
            (void)align_box(calibration_, tracks_[s].window, report);
        }
    }
    end(Stage::kAlign);
}

void TrackerCore::update_lifecycle() {
    begin(Stage::kLifecycle);
    for (int s = 0; s < kMaxObjects; ++s) {
        Track& track = tracks_[s];
        if (!track.alive) {
            continue;
        }
        const ObjectFrame& frame = track.window.newest();
        const Vec3 p_c = frame.T_c_l * frame.state.p;
        const double range2 = p_c.dot(p_c);
        const bool ahead = p_c(2) > kBehind_m && range2 < kMaxRange_m * kMaxRange_m;
        Box2d box;
        const Pose T_c_o = frame.T_c_l * frame.state.T_l_o();
        const bool in_image = projected_box(calibration_.left, T_c_o, track.window.size_m, box) == Status::kOk &&
                              clip_box(box, calibration_.width, calibration_.height, box);
        update_status(track, ahead && in_image);
    }
    end(Stage::kLifecycle);
}

}  // namespace semtrack
