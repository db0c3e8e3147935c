// Stages 1 and 2: tracks are predicted to the frame, every list finds the frame of its own image, boxes become rough
// 3D poses (paper Sect. 3.2), and detections and tracks find each other (Sect. 4).
#include <cmath>

#include "estimate/factor/box_edges.hpp"
#include "estimate/factor/size_prior.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_outline.hpp"
#include "model/class_prior.hpp"
#include "model/stand_point.hpp"
#include "pipeline/edge_noise.hpp"
#include "pipeline/tracker_core.hpp"
#include "pipeline/usable_detections.hpp"

namespace semtrack {

namespace {

constexpr std::int64_t kSameImage_us = 5000;  // stamps of one image may differ by rounding, not by half a frame
constexpr int kWrongViews = 3;                // detections in a row that contradict the heading
constexpr double kWithinClass_rad = 0.7;      // half of what a class of two faces spans
constexpr double kStartDepthSigma = 0.15;     // of the depth: a size prior is off by so much

/// Steps between two horizontal viewpoint classes on the circle of eight.
int class_distance(int a, int b) {
    const int d = a > b ? a - b : b - a;
    return d > 4 ? 8 - d : d;
}

}  // namespace

void TrackerCore::refresh_poses(Track& track) const {
    const Mat3 R_w_l = track.window.R_l_w.transpose();
    for (ObjectFrame& frame : track.window.frames) {
        Pose T_w_c = T_w_c_;
        if (frame.frame != frame_) {
            if (!ego_.history().find(frame.frame, T_w_c)) {
                continue;
            }
            T_w_c = T_v_c_ * T_w_c;
        }
        const Pose T_c_w = T_w_c.inverse();
        frame.T_c_l = {T_c_w.R * R_w_l, T_c_w.t};
    }
}

void TrackerCore::predict_tracks() {
    for (int s = 0; s < kMaxObjects; ++s) {
        Track& track = tracks_[s];
        if (!track.alive) {
            continue;
        }
        ObjectWindow& window = track.window;
        relevel(window, level_.R_l_w());
        thin_out(window);
        const ObjectFrame& last = window.newest();
        const double dt_s = 1e-6 * static_cast<double>(time_us_ - last.time_us);
        new_frame_.frame = frame_;
        new_frame_.time_us = time_us_;
        new_frame_.state = predicted_state(last.state, window.object_class, window.size_m, dt_s);
        new_frame_.box.valid = false;
        for (FeatureObservation& o : new_frame_.features) {
            o.valid = false;
        }
        if (!window.frames.try_push_back(new_frame_)) {
            continue;
        }
        refresh_poses(track);
        track.hit_now = false;
        track.list_seen = false;
    }
}

bool TrackerCore::frame_of(std::int64_t time_us, std::uint32_t& frame, Pose& T_w_c) const {
    const std::int64_t age_us = time_us_ - time_us;
    if (age_us <= kSameImage_us && age_us >= -kSameImage_us) {
        frame = frame_;
        T_w_c = T_w_c_;
        return true;
    }
    for (std::uint32_t back = 1; back <= kMaxDetectionDelay && back < frame_; ++back) {
        std::int64_t stamp_us = 0;
        Pose T_wc_c;
        if (!ego_.history().find(frame_ - back, T_wc_c, &stamp_us)) {
            continue;
        }
        const std::int64_t d = stamp_us - time_us;
        if (d <= kSameImage_us && d >= -kSameImage_us) {
            frame = frame_ - back;
            T_w_c = T_v_c_ * T_wc_c;
            return true;
        }
    }
    return false;
}

void TrackerCore::take_lists(const Input& input) {
    health_.no_detections = input.detections == nullptr || input.detections->empty();
    health_.objects_untracked = 0;
    if (input.detections == nullptr) {
        return;
    }
    for (const DetectionList& list : *input.detections) {
        std::uint32_t frame = 0;
        Pose T_w_c;
        health_.detections_dropped += list.dropped;
        health_.objects_untracked += list.dropped;
        if (!frame_of(list.time_us, frame, T_w_c)) {
            ++health_.lists_too_late;
            continue;
        }
        if (frame != frame_) {
            ++health_.lists_late;
        }
        take_list(list, frame);
    }
}

void TrackerCore::take_list(const DetectionList& list, std::uint32_t frame) {
    begin(Stage::kAssociate);
    health_.detections_dropped += take_usable(list, calibration_.width, calibration_.height, usable_);
    candidates_.clear();
    boxes_.clear();
    unplaced_.clear();
    for (int s = 0; s < kMaxObjects; ++s) {
        const Track& track = tracks_[s];
        const int index = track.alive ? find_frame(track.window, frame) : -1;
        if (index < 0) {
            continue;
        }
        TrackBox box;
        box.object_class = track.window.object_class;
        box.box = expected_box(track, index);
        box.sigma_px = edge_tolerance(track, index, box.box);
        (void)boxes_.try_push_back(box);
        (void)candidates_.try_push_back({s, index});
    }
    widen_hidden_edges();
    associator_.run(boxes_, usable_, assignment_);
    for (int t = 0; t < candidates_.size(); ++t) {
        Track& track = tracks_[candidates_[t].slot];
        const int item = assignment_.detection_of_track[static_cast<std::size_t>(t)];
        track.list_seen = track.list_seen || frame == frame_;
        if (item >= 0) {
            attach(track, candidates_[t].index, usable_, item, frame);
            learn_ground(track, candidates_[t].slot, candidates_[t].index);
        } else {
            update_miss(track, detection_probability(track, boxes_[t].box.bottom - boxes_[t].box.top));
        }
    }
    end(Stage::kAssociate);
    begin(Stage::kInfer);
    for (int item = 0; item < usable_.items.size(); ++item) {
        if (!assignment_.detection_used[static_cast<std::size_t>(item)] && !is_repeat(item)) {
            start_track(usable_, item, frame);
        }
    }
    end(Stage::kInfer);
}

Box2d TrackerCore::expected_box(const Track& track, int index) const {
    const ObjectFrame& frame = track.window.frames[index];
    const DetectionView view{calibration_.detection, {frame.T_c_l.R, frame.T_c_l.t + t_d_c_}, calibration_.width};
    const Pose T_l_o{rot_z(box_heading(frame.state, track.window.object_class, view)), frame.state.p};
    Box2d box = track.box;
    Box2d projected;
    if (track.hits >= kYoungHits || track.features > 0) {
        if (seen_box(view.camera, calibration_.width, calibration_.height, view.T_d_l * T_l_o, track.window.size_m,
                     projected) == Status::kOk) {
            return projected;
        }
    }
    if (index > 0) {
        const Pose& before = track.window.frames[index - 1].T_c_l;
        box = rotated_box(track.box, frame.T_c_l.R * before.R.transpose(), calibration_.detection);
    }
    return box;
}

void TrackerCore::attach(Track& track, int index, const DetectionList& list, int item, std::uint32_t frame) {
    const Detection& detection = list.items[item];
    ObjectFrame& f = track.window.frames[index];
    f.box.valid = true;
    f.box.box = detection.box;
    f.box.sigma_px = edge_sigmas(list, item, calibration_.width, calibration_.height);
    f.box.viewpoint = detection.viewpoint;
    f.box.score = detection.score;
    update_hit(track, detection.score);
    track.box = detection.box;
    if (frame == frame_) {
        track.hit_now = true;
    }
    watch_heading(track, index, detection);
    if (frame != frame_ || track.hits > kYoungHits) {
        return;
    }
    // A young track's motion is not known: its predicted position follows the box sideways, so that its features are
    // looked for where the object is.
    const DetectionView view{calibration_.detection, {f.T_c_l.R, f.T_c_l.t + t_d_c_}, calibration_.width};
    const Vec3 p_d = view.T_d_l * f.state.p;
    if (!(p_d(2) > 1.0)) {
        return;
    }
    const Vec3 ray = bearing(view.camera, 0.5 * (detection.box.left + detection.box.right),
                             0.5 * (detection.box.top + detection.box.bottom));
    const bool whole = f.box.sigma_px[kLeft] > 0.0 && f.box.sigma_px[kRight] > 0.0;
    if (!whole) {
        return;
    }
    const Vec3 shift_d(ray(0) * p_d(2) - p_d(0), 0.0, 0.0);
    f.state.p += view.T_d_l.R.transpose() * shift_d;
}

void TrackerCore::learn_ground(const Track& track, int slot, int index) {
    const ObjectFrame& f = track.window.frames[index];
    const ClassPrior& prior = class_prior(track.window.object_class);
    const DetectionView view{calibration_.detection, {f.T_c_l.R, f.T_c_l.t + t_d_c_}, calibration_.width};
    const Pose T_l_o{rot_z(box_heading(f.state, track.window.object_class, view)), f.state.p};
    StandPoint point;
    if (stand_point(view.camera, f.box.box, f.box.sigma_px, view.T_d_l * T_l_o, prior.size_m, prior.size_sigma_m(2),
                    point) == Status::kOk) {
        ground_.add(slot, f.T_c_l, view.T_d_l.inverse() * point.p_d, point.sigma_m);
    }
}

void TrackerCore::watch_heading(Track& track, int index, const Detection& detection) {
    if (!class_prior(track.window.object_class).has_heading) {
        return;
    }
    ObjectFrame& f = track.window.frames[index];
    const Pose T_d_l{f.T_c_l.R, f.T_c_l.t + t_d_c_};
    const bool has_view = detection.viewpoint.horizontal >= 0;
    if (has_view) {
        const Viewpoint seen = visible_faces(T_d_l * f.state.T_l_o(), track.window.size_m);
        const bool wrong = seen.horizontal >= 0 && class_distance(seen.horizontal, detection.viewpoint.horizontal) >= 2;
        track.wrong_views = wrong ? track.wrong_views + 1 : 0;
    } else {
        // Cars drive forwards: a track that never had a viewpoint and runs backwards at speed was started reversed.
        track.wrong_views = f.state.v < -2.0 ? track.wrong_views + 1 : 0;
    }
    if (track.wrong_views < kWrongViews) {
        return;
    }
    track.wrong_views = 0;
    double turn = kPi;
    if (has_view) {
        ObjectState inferred;
        if (!infer(detection, f.T_c_l, track.window.size_m, nullptr, inferred)) {
            return;
        }
        turn = wrap_angle(inferred.theta - f.state.theta);
        if (track.window.standing && std::fabs(turn) < kWithinClass_rad) {
            return;  // what all frames said while it stood knows better
        }
    }
    change_object_frame(track.window, Vec3::Zero(), turn);
    track.window.heading_information = 0.0;
    const bool reversed = turn > 0.5 * kPi || turn < -0.5 * kPi;
    for (ObjectFrame& frame : track.window.frames) {
        if (reversed) {
            frame.state.v = -frame.state.v;
        }
        frame.state.delta = 0.0;
    }
}

bool TrackerCore::infer(const Detection& detection, const Pose& T_c_l, const Vec3& size_m, const double* theta,
                        ObjectState& x) const {
    BoxInferenceInput in;
    in.box = drawn_to_border(detection.box, calibration_.width, calibration_.height);
    in.viewpoint = detection.viewpoint;
    in.object_class = detection.object_class;
    in.size_m = size_m;
    in.camera = calibration_.detection;
    in.R_c_l = T_c_l.R;
    in.width = calibration_.width;
    in.height = calibration_.height;
    in.has_theta = theta != nullptr;
    in.theta = theta != nullptr ? *theta : 0.0;
    BoxHypotheses hypotheses;
    if (infer_box(in, hypotheses) != Status::kOk || hypotheses.empty()) {
        return false;
    }
    const BoxHypothesis& best = hypotheses[0];
    x = ObjectState{};
    x.p = T_c_l.R.transpose() * (best.p_c - t_d_c_ - T_c_l.t);
    x.theta = best.theta;
    return true;
}

// One frame at the list's own time, then one for every frame until now.
void TrackerCore::fill_window(ObjectWindow& window, const ObjectState& first, std::int64_t first_us,
                              std::uint32_t first_frame) {
    ObjectState state = first;
    std::int64_t stamp_us = first_us;
    for (std::uint32_t k = first_frame; k <= frame_; ++k) {
        Pose unused;
        std::int64_t next_us = time_us_;
        if (k != frame_ && !ego_.history().find(k, unused, &next_us)) {
            continue;
        }
        state =
            predicted_state(state, window.object_class, window.size_m, 1e-6 * static_cast<double>(next_us - stamp_us));
        stamp_us = next_us;
        new_frame_.frame = k;
        new_frame_.time_us = next_us;
        new_frame_.state = state;
        new_frame_.box.valid = false;
        new_frame_.ground = ground_.plane(-1);
        for (FeatureObservation& o : new_frame_.features) {
            o.valid = false;
        }
        if (!window.frames.try_push_back(new_frame_)) {
            break;
        }
    }
}

void TrackerCore::start_track(const DetectionList& list, int item, std::uint32_t frame) {
    const Detection& detection = list.items[item];
    const ClassPrior& prior = class_prior(detection.object_class);
    std::uint32_t found = 0;
    Pose T_w_c;
    if (!frame_of(list.time_us, found, T_w_c)) {
        return;
    }
    const Pose T_c_w = T_w_c.inverse();
    const Pose T_c_l{T_c_w.R * level_.R_l_w().transpose(), T_c_w.t};
    ObjectState x;
    if (!infer(detection, T_c_l, prior.size_m, nullptr, x)) {
        (void)unplaced_.try_push_back(detection.box);
        return;  // too much of it outside: not observable yet
    }
    int slot = -1;
    Track* track = tracks_.start(detection.object_class, detection.score, slot);
    if (track == nullptr) {
        ++health_.tracks_dropped;
        ++health_.objects_untracked;
        return;
    }
    ObjectWindow& window = track->window;
    window.R_l_w = level_.R_l_w();
    window.size_m = prior.size_m;
    window.prior_size_m = prior.size_m;
    window.prior_size_covariance = size_prior(detection.object_class).covariance;
    window.prior_frame = frame;
    window.size_covariance = prior.size_sigma_m.cwiseProduct(prior.size_sigma_m).asDiagonal();
    const Vec3 p_c = T_c_l * x.p;
    const double depth = kStartDepthSigma * std::sqrt(p_c.dot(p_c));
    Vec6 variance;
    variance << depth * depth, depth * depth, 0.25, 0.25, 100.0, 0.02;
    window.covariance = variance.asDiagonal();
    track->box = detection.box;
    track->hit_now = frame == frame_;
    fill_window(window, x, list.time_us, frame);
    BoxMeasurement& box = window.frames[0].box;
    box.valid = true;
    box.box = detection.box;
    box.sigma_px = edge_sigmas(list, item, calibration_.width, calibration_.height);
    box.viewpoint = detection.viewpoint;
    box.score = detection.score;
    refresh_poses(*track);
    learn_ground(*track, slot, 0);
}

}  // namespace semtrack
