// One ego history for everybody: poses of the last frames as the ego window last revised them. A keyframe's pose is the
// window's; a frame between keyframes hangs on its keyframe by the relative pose that was found at its time.
#ifndef SEMTRACK_MODEL_EGO_HISTORY_HPP
#define SEMTRACK_MODEL_EGO_HISTORY_HPP

#include <array>
#include <cstdint>

#include "math/pose.hpp"
#include "semtrack/capacity.hpp"

namespace semtrack {

class EgoHistory {
public:
    void reset() { count_ = 0; }
    /// frame grows from call to call. keyframe: number of the keyframe it hangs on (its own: it is one).
    void add(std::uint32_t frame, std::int64_t time_us, const Pose& T_w_c, std::uint32_t keyframe);
    /// A keyframe's revised pose; frames that hang on it follow.
    void revise(std::uint32_t keyframe, const Pose& T_w_c);
    /// A frame is to hang on itself from now on (it became a keyframe).
    void make_keyframe(std::uint32_t frame);
    /// false: not in the history; outputs untouched.
    [[nodiscard]] bool find(std::uint32_t frame, Pose& T_w_c, std::int64_t* time_us = nullptr) const;

private:
    struct Entry {
        std::uint32_t frame{0};
        std::uint32_t keyframe{0};
        std::int64_t time_us{0};
        Pose T_w_c{};
        Pose T_key_c{};
    };
    [[nodiscard]] int index_of(std::uint32_t frame) const;
    std::array<Entry, kEgoHistory> entries_{};
    int count_{0};
    int next_{0};
};

}  // namespace semtrack

#endif
