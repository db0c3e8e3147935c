#include "model/ego_history.hpp"

namespace semtrack {

int EgoHistory::index_of(std::uint32_t frame) const {
    for (int i = 0; i < count_; ++i) {
        if (entries_[static_cast<std::size_t>(i)].frame == frame) {
            return i;
        }
    }
    return -1;
}

void EgoHistory::add(std::uint32_t frame, std::int64_t time_us, const Pose& T_w_c, std::uint32_t keyframe) {
    if (count_ == 0) {
        next_ = 0;
    }
    Entry& e = entries_[static_cast<std::size_t>(next_)];
    Pose T_w_key;
    const bool hangs = keyframe != frame && find(keyframe, T_w_key);
    e.frame = frame;
    e.keyframe = hangs ? keyframe : frame;
    e.time_us = time_us;
    e.T_w_c = T_w_c;
    e.T_key_c = hangs ? T_w_key.inverse() * T_w_c : Pose{};
    next_ = next_ + 1 == kEgoHistory ? 0 : next_ + 1;
    count_ = count_ < kEgoHistory ? count_ + 1 : kEgoHistory;
}

void EgoHistory::make_keyframe(std::uint32_t frame) {
    const int i = index_of(frame);
    if (i < 0) {
        return;
    }
    entries_[static_cast<std::size_t>(i)].keyframe = frame;
    entries_[static_cast<std::size_t>(i)].T_key_c = Pose{};
}

void EgoHistory::revise(std::uint32_t keyframe, const Pose& T_w_c) {
    for (int i = 0; i < count_; ++i) {
        Entry& e = entries_[static_cast<std::size_t>(i)];
        if (e.keyframe == keyframe) {
            e.T_w_c = T_w_c * e.T_key_c;
        }
    }
}

bool EgoHistory::find(std::uint32_t frame, Pose& T_w_c, std::int64_t* time_us) const {
    const int i = index_of(frame);
    if (i < 0) {
        return false;
    }
    T_w_c = entries_[static_cast<std::size_t>(i)].T_w_c;
    if (time_us != nullptr) {
        *time_us = entries_[static_cast<std::size_t>(i)].time_us;
    }
    return true;
}

}  // namespace semtrack
