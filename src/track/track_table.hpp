// All tracks, by slot, and their lifecycle: new -> measured <-> coasted -> lost.
#ifndef SEMTRACK_TRACK_TRACK_TABLE_HPP
#define SEMTRACK_TRACK_TRACK_TABLE_HPP

#include <array>
#include <cstdint>

#include "model/object_window.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct Track {
    bool alive{false};
    std::uint32_t id{0};
    TrackStatus status{TrackStatus::kNew};
    bool confirmed{false};     ///< it was published as a real object once
    double existence{0};       ///< probability
    double detector_score{0};  ///< mean over the detections
    int hits{0};               ///< detections attached
    int age{0};                ///< frames
    int missed_lists{0};       ///< lists in a row without a detection of it
    int frames_unseen{0};      ///< frames in a row without detection
    bool hit_now{false};       ///< a detection of this frame's own image was attached
    bool list_seen{false};     ///< a list of this frame's own image was there
    int features{0};           ///< matched in this frame
    int wrong_views{0};        ///< detections in a row whose viewpoint contradicts the heading
    double truncation{0};
    int occlusion{0};
    double visible_share{1};
    Box2d box{};  ///< last detection, px of the detection camera
    ObjectWindow window{};
};

/// Probability that the detector sees an object; drops when it is hidden, cut or small.
[[nodiscard]] double detection_probability(const Track& track, double box_height_px);

class TrackTable {
public:
    void reset();
    [[nodiscard]] Track& operator[](int slot) { return tracks_[static_cast<std::size_t>(slot)]; }
    [[nodiscard]] const Track& operator[](int slot) const { return tracks_[static_cast<std::size_t>(slot)]; }

    /// New track for a detection of this score; nullptr: no slot is free. Its window is empty. A tentative track that
    /// was never confirmed gives way when all slots are taken.
    [[nodiscard]] Track* start(ObjectClass object_class, double score, int& slot);
    /// Frees the slot; ids are never used twice.
    void remove(int slot) { tracks_[static_cast<std::size_t>(slot)].alive = false; }

private:
    std::array<Track, static_cast<std::size_t>(kMaxObjects)> tracks_{};
    std::uint32_t next_id_{1};
};

/// Bayes' rule for a detection with this score, and for a list without one.
void update_hit(Track& track, double score);
void update_miss(Track& track, double detection_probability);

/// Once a frame, after the estimate: ages the track and sets its status. kLost: publish once, then remove.
void update_status(Track& track, bool in_view);

}  // namespace semtrack

#endif
