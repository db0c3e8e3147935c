// A drive behind the HAL's interfaces. None throws: what went wrong is kept and thrown again by the replay.
#ifndef SEMTRACK_SIL_SOURCES_HPP
#define SEMTRACK_SIL_SOURCES_HPP

#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <map>
#include <utility>
#include <vector>

#include "math/pose.hpp"
#include "semtrack/hal/sources.hpp"
#include "sil/sequence.hpp"
#include "sil/stage_timer.hpp"

namespace semtrack::sil {

/// Frames first..last; the next pair is decoded in the background, unless that is switched off.
class SequenceStereoSource final : public StereoSource {
public:
    struct Settings {
        int first{0};
        int last{0};
        bool images{true};     ///< false: boxes only, every view is empty
        bool ahead{true};      ///< false: decoded when asked for; a rendered pair takes all cores, the tracker's too
        bool realtime{false};  ///< hand over at the drive's own pace
    };
    /// timer: told when a frame is handed over.
    SequenceStereoSource(Sequence& sequence, const Settings& settings, StageTimer& timer);
    ~SequenceStereoSource();

    [[nodiscard]] SourceResult next(StereoFrame& frame) noexcept override;
    /// Of the frame that was handed over last.
    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] const GreyImage& left() const { return current_.left; }
    /// Throws again what made next() fail.
    void rethrow() const;

private:
    struct Pair {
        GreyImage left;
        GreyImage right;
    };
    void decode_ahead(int frame);
    void keep_pace(std::int64_t time_us);

    Sequence& sequence_;
    Settings settings_;
    StageTimer& timer_;
    int frame_;
    Pair current_;
    std::future<Pair> ahead_;
    std::exception_ptr error_;
    std::chrono::steady_clock::time_point start_{};
    std::int64_t start_us_{0};
};

/// Lists by frame, each handed over `delay` frames after its own and with its own time stamp.
class DelayedDetectionSource final : public DetectionSource {
public:
    DelayedDetectionSource(const Sequence& sequence, const std::map<int, std::vector<Detection>>& by_frame, int first,
                           int last, int delay);
    [[nodiscard]] SourceResult poll(std::int64_t now_us,
                                    StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept override;
    [[nodiscard]] int lists_handed_over() const { return handed_over_; }

private:
    struct Entry {
        std::int64_t due_us{0};
        DetectionList list{};
    };
    std::vector<Entry> entries_;
    std::size_t next_{0};
    int handed_over_{0};
};

/// Rows of the vehicle's own sensors, handed over as they were at each image's time.
class VehicleMotionRows final : public VehicleMotionSource {
public:
    /// A row older than this at the image's time is none, as on the bus.
    static constexpr std::int64_t kTimeout_us = 200000;
    explicit VehicleMotionRows(std::map<std::int64_t, VehicleMotion> rows) : rows_(std::move(rows)) {}
    [[nodiscard]] SourceResult poll(std::int64_t now_us, VehicleMotion& motion) noexcept override;
    [[nodiscard]] int handed_over() const { return handed_over_; }

private:
    std::map<std::int64_t, VehicleMotion> rows_;
    int handed_over_{0};
};

/// Given ego poses, brought to W = V at the first processed frame.
class GivenPoseSource final : public EgoPoseSource {
public:
    /// poses: rectified camera 0 by frame; T_v_c: mount; x_c0 = x_c + t_c0_c. InputError: a frame of first..last has
    /// no pose (`name`: of the file).
    GivenPoseSource(const Sequence& sequence, const std::map<int, RigidTransform>& poses, const RigidTransform& T_v_c,
                    int first, int last, const std::string& name);
    [[nodiscard]] SourceResult poll(std::int64_t now_us, RigidTransform& T_w_v) noexcept override;

private:
    std::map<std::int64_t, RigidTransform> T_w_v_;
};

}  // namespace semtrack::sil

#endif
