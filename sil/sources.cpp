#include "sil/sources.hpp"

#include <iterator>
#include <thread>

#include "math/float_env.hpp"
#include "math/so3.hpp"

namespace semtrack::sil {

SequenceStereoSource::SequenceStereoSource(Sequence& sequence, const Settings& settings, StageTimer& timer)
    : sequence_(sequence), settings_(settings), timer_(timer), frame_(settings.first - 1) {
    decode_ahead(settings.first);
}

SequenceStereoSource::~SequenceStereoSource() {
    if (ahead_.valid() && settings_.ahead) {
        ahead_.wait();
    }
}

void SequenceStereoSource::decode_ahead(int frame) {
    if (settings_.images && frame <= settings_.last) {
        ahead_ = std::async(settings_.ahead ? std::launch::async : std::launch::deferred, [this, frame] {
            const FloatEnvironment environment;
            Pair pair;
            sequence_.load(frame, pair.left, pair.right);
            return pair;
        });
    }
}

void SequenceStereoSource::keep_pace(std::int64_t time_us) {
    if (!settings_.realtime) {
        return;
    }
    if (frame_ == settings_.first) {
        start_ = std::chrono::steady_clock::now();
        start_us_ = time_us;
    }
    std::this_thread::sleep_until(start_ + std::chrono::microseconds(time_us - start_us_));
}

SourceResult SequenceStereoSource::next(StereoFrame& frame) noexcept {
    try {
        if (frame_ >= settings_.last) {
            return SourceResult::kEnd;
        }
        const std::int64_t time_us = sequence_.time_us(frame_ + 1);
        if (settings_.images) {
            current_ = ahead_.get();
        }
        ++frame_;
        decode_ahead(frame_ + 1);
        keep_pace(time_us);
        frame = StereoFrame{time_us, current_.left.view(), current_.right.view()};
        timer_.start_frame();
        return SourceResult::kOk;
    } catch (...) {
        error_ = std::current_exception();
        return SourceResult::kError;
    }
}

void SequenceStereoSource::rethrow() const {
    if (error_) {
        std::rethrow_exception(error_);
    }
}

DelayedDetectionSource::DelayedDetectionSource(const Sequence& sequence,
                                               const std::map<int, std::vector<Detection>>& by_frame, int first,
                                               int last, int delay) {
    for (const auto& [frame, detections] : by_frame) {
        if (frame < first || frame > last - delay) {
            continue;
        }
        Entry entry;
        entry.due_us = sequence.time_us(frame + delay);
        entry.list.time_us = sequence.time_us(frame);
        for (const Detection& d : detections) {
            entry.list.dropped += entry.list.items.try_push_back(d) ? 0U : 1U;
        }
        entries_.push_back(entry);
    }
}

SourceResult DelayedDetectionSource::poll(std::int64_t now_us,
                                          StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept {
    bool any = false;
    while (next_ < entries_.size() && entries_[next_].due_us <= now_us && lists.try_push_back(entries_[next_].list)) {
        ++next_;
        ++handed_over_;
        any = true;
    }
    return any ? SourceResult::kOk : SourceResult::kNone;
}

SourceResult VehicleMotionRows::poll(std::int64_t now_us, VehicleMotion& motion) noexcept {
    const auto later = rows_.upper_bound(now_us);
    if (later == rows_.begin() || now_us - std::prev(later)->first > kTimeout_us) {
        return SourceResult::kNone;
    }
    motion = std::prev(later)->second;
    ++handed_over_;
    return SourceResult::kOk;
}

GivenPoseSource::GivenPoseSource(const Sequence& sequence, const std::map<int, RigidTransform>& poses,
                                 const RigidTransform& T_v_c, int first, int last, const std::string& name) {
    const std::array<double, 3>& t = sequence.cameras().t_c0_c;
    const Pose T_c0_c{Mat3::Identity(), Vec3(t[0], t[1], t[2])};
    const Pose T_c0_v = T_c0_c * to_pose(T_v_c).inverse();
    Pose T_first_f;
    for (int frame = first; frame <= last; ++frame) {
        const auto row = poses.find(frame);
        if (row == poses.end()) {
            throw InputError(name + ": no pose for frame " + std::to_string(frame));
        }
        Pose T_f_c0 = to_pose(row->second);
        T_f_c0.R = orthonormalised(T_f_c0.R);
        const Pose T_f_v = T_f_c0 * T_c0_v;
        if (frame == first) {
            T_first_f = T_f_v.inverse();
        }
        T_w_v_[sequence.time_us(frame)] = to_rigid_transform(T_first_f * T_f_v);
    }
}

SourceResult GivenPoseSource::poll(std::int64_t now_us, RigidTransform& T_w_v) noexcept {
    const auto pose = T_w_v_.find(now_us);
    if (pose == T_w_v_.end()) {
        return SourceResult::kNone;
    }
    T_w_v = pose->second;
    return SourceResult::kOk;
}

}  // namespace semtrack::sil
