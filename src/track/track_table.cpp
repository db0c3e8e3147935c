#include "track/track_table.hpp"

namespace semtrack {

namespace {

// Detectors on KITTI-like roads: 85 of 100 visible cars are found in a frame, one false box in twenty frames.
constexpr double kDetectionProbability = 0.85;
constexpr double kHiddenDetectionProbability = 0.3;
constexpr double kSmallBox_px = 30.0;
constexpr double kSurvival = 0.995;  // per frame: road users leave
constexpr double kStartExistence = 0.5;
constexpr double kConfirm = 0.8;
constexpr double kDrop = 0.08;
constexpr double kMaxExistence = 0.999;  // so that misses can count again
constexpr int kMinHits = 2;
constexpr int kMaxCoast_frames = 20;       // 2 s: the paper's truncated car
constexpr int kMaxCoastBlind_frames = 10;  // without features nothing is measured
constexpr int kMinCoastFeatures = 6;

double clamped(double p) {
    return p > kMaxExistence ? kMaxExistence : p;
}

}  // namespace

double detection_probability(const Track& track, double box_height_px) {
    double p = kDetectionProbability;
    if (box_height_px < kSmallBox_px) {
        p = 0.6;
    }
    if (track.truncation > 0.3) {
        p = p < 0.5 ? p : 0.5;
    }
    if (track.occlusion >= 2) {
        p = kHiddenDetectionProbability;
    }
    if (track.visible_share < 0.15) {
        p = 0.05;
    }
    return p;
}

void TrackTable::reset() {
    for (Track& t : tracks_) {
        t.alive = false;
    }
    next_id_ = 1;
}

Track* TrackTable::start(ObjectClass object_class, double score, int& slot) {
    slot = -1;
    for (int s = 0; s < kMaxObjects && slot < 0; ++s) {
        if (!(*this)[s].alive) {
            slot = s;
        }
    }
    for (int s = 0; s < kMaxObjects && slot < 0; ++s) {
        if ((*this)[s].status == TrackStatus::kNew && (*this)[s].missed_lists > 0) {
            slot = s;
        }
    }
    if (slot < 0) {
        return nullptr;
    }
    Track& track = (*this)[slot];
    track.alive = true;
    track.id = next_id_++;
    track.status = TrackStatus::kNew;
    track.confirmed = false;
    track.existence = kStartExistence * (0.5 + 0.5 * score);
    track.detector_score = score;
    track.hits = 1;
    track.age = 0;
    track.missed_lists = 0;
    track.frames_unseen = 0;
    track.hit_now = true;
    track.list_seen = true;
    track.features = 0;
    track.wrong_views = 0;
    track.truncation = 0;
    track.occlusion = 0;
    track.visible_share = 1;
    track.window.object_class = object_class;
    track.window.frames.clear();
    track.window.standing = false;
    track.window.stood = track.window.contradicted = 0;
    track.window.heading_information = 0.0;
    for (ObjectLandmark& landmark : track.window.landmarks) {
        landmark.valid = false;
    }
    return &track;
}

void update_hit(Track& track, double score) {
    // Likelihood ratio of a box with this score being the object against being clutter.
    const double ratio = 2.0 + 10.0 * score;
    const double e = track.existence;
    track.existence = clamped(e * ratio / (e * ratio + 1.0 - e));
    ++track.hits;
    track.detector_score += (score - track.detector_score) / static_cast<double>(track.hits);
    track.missed_lists = 0;
    track.frames_unseen = 0;
}

void update_miss(Track& track, double detection_probability) {
    const double e = track.existence;
    const double missed = 1.0 - detection_probability;
    track.existence = e * missed / (e * missed + 1.0 - e);
    ++track.missed_lists;
}

void update_status(Track& track, bool in_view) {
    track.existence *= kSurvival;
    if (!track.hit_now) {
        ++track.frames_unseen;
    }
    const bool blind = track.features < kMinCoastFeatures;
    const int patience = blind ? kMaxCoastBlind_frames : kMaxCoast_frames;
    const bool gone = track.existence < kDrop || track.frames_unseen > patience || !in_view;
    track.confirmed = track.confirmed || (track.existence > kConfirm && track.hits >= kMinHits);
    if (gone) {
        track.status = TrackStatus::kLost;
    } else if (track.confirmed) {
        track.status = track.hit_now ? TrackStatus::kMeasured : TrackStatus::kCoasted;
    }
    ++track.age;
}

}  // namespace semtrack
