#include "model/ego_history.hpp"

#include "math/so3.hpp"

namespace semtrack {

void EgoHistory::reset() {
    count_ = 0;
    next_ = 0;
}

int EgoHistory::index_of(std::uint32_t frame) const {
    for (int i = 0; i < count_; ++i) {
        if (entry(i).frame == frame) {
            return i;
        }
    }
    return -1;
}

void EgoHistory::add(std::uint32_t frame, std::int64_t time_us, const Pose& T_w_c) {
    Entry& e = entry(next_);
    e.frame = frame;
    e.anchor = frame;
    e.time_us = time_us;
    e.T_w_c = T_w_c;
    e.T_anchor_c = Pose{};
    next_ = next_ + 1 == kEgoHistory ? 0 : next_ + 1;
    count_ = count_ < kEgoHistory ? count_ + 1 : kEgoHistory;
}

void EgoHistory::revise(std::uint32_t frame, const Pose& T_w_c) {
    for (int i = 0; i < count_; ++i) {
        Entry& e = entry(i);
        if (e.anchor == frame) {
            e.T_w_c = e.frame == frame ? T_w_c : T_w_c * e.T_anchor_c;
        }
    }
}

void EgoHistory::turn(const Mat3& R) {
    for (int i = 0; i < count_; ++i) {
        entry(i).T_w_c.R = orthonormalised(entry(i).T_w_c.R * R);
    }
}

void EgoHistory::hang(std::uint32_t frame, std::uint32_t keyframe) {
    const int at = index_of(keyframe);
    if (at < 0 || index_of(frame) < 0 || frame == keyframe) {
        return;
    }
    const Pose T_key_w = entry(at).T_w_c.inverse();
    for (int i = 0; i < count_; ++i) {
        Entry& e = entry(i);
        if (e.anchor == frame) {
            e.anchor = keyframe;
            e.T_anchor_c = T_key_w * e.T_w_c;
        }
    }
}

bool EgoHistory::find(std::uint32_t frame, Pose& T_w_c, std::int64_t* time_us) const {
    const int i = index_of(frame);
    if (i < 0) {
        return false;
    }
    T_w_c = entry(i).T_w_c;
    if (time_us != nullptr) {
        *time_us = entry(i).time_us;
    }
    return true;
}

bool EgoHistory::find_time(std::int64_t time_us, std::uint32_t& frame, Pose& T_w_c) const {
    for (int i = 0; i < count_; ++i) {
        if (entry(i).time_us == time_us) {
            frame = entry(i).frame;
            T_w_c = entry(i).T_w_c;
            return true;
        }
    }
    return false;
}

}  // namespace semtrack
