// One ego history for everybody: poses of the last frames as the ego window last revised them. A frame that the window
// still holds has a pose of its own; one that left hangs on a keyframe and follows when that is revised.
#ifndef SEMTRACK_MODEL_EGO_HISTORY_HPP
#define SEMTRACK_MODEL_EGO_HISTORY_HPP

#include <array>
#include <cstdint>

#include "math/pose.hpp"
#include "semtrack/capacity.hpp"

namespace semtrack {

/// The last kEgoHistory frames; frame numbers and times grow. W is the caller's. Lookups cost O(kEgoHistory).
class EgoHistory {
public:
    void reset();
    /// A new frame with a pose of its own; the oldest one goes when the history is full.
    void add(std::uint32_t frame, std::int64_t time_us, const Pose& T_w_c);
    /// A revised pose; frames that hang on this one follow.
    void revise(std::uint32_t frame, const Pose& T_w_c);
    /// Every pose with its camera turned: R_w_c R.
    void turn(const Mat3& R);
    /// From now on `frame`, and what hangs on it, follows `keyframe` with the relative pose of this moment. Nothing
    /// happens when one of them is not in the history.
    void hang(std::uint32_t frame, std::uint32_t keyframe);
    /// false: not in the history; outputs untouched.
    [[nodiscard]] bool find(std::uint32_t frame, Pose& T_w_c, std::int64_t* time_us = nullptr) const;
    /// The frame with exactly this time stamp; false: none, outputs untouched.
    [[nodiscard]] bool find_time(std::int64_t time_us, std::uint32_t& frame, Pose& T_w_c) const;
    [[nodiscard]] int size() const { return count_; }

private:
    struct Entry {
        std::uint32_t frame{0};
        std::uint32_t anchor{0};  // itself: a pose of its own
        std::int64_t time_us{0};
        Pose T_w_c{};
        Pose T_anchor_c{};
    };
    [[nodiscard]] int index_of(std::uint32_t frame) const;
    [[nodiscard]] Entry& entry(int i) { return entries_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Entry& entry(int i) const { return entries_[static_cast<std::size_t>(i)]; }

    std::array<Entry, kEgoHistory> entries_{};
    int count_{0};
    int next_{0};
};

}  // namespace semtrack

#endif
