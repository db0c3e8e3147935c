// A short drive as one block of bytes, for a board without files: calibration, then frame by frame its time, the
// detector's list and both images. 8-byte words, little-endian; images padded to whole words.
#ifndef SEMTRACK_TESTS_BOARD_SCENE_HPP
#define SEMTRACK_TESTS_BOARD_SCENE_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "semtrack/calibration.hpp"
#include "semtrack/hal/sources.hpp"

namespace semtrack::board {

inline constexpr std::uint64_t kMagic = 0x31454E4543535453U;  // "STSCENE1"

/// Applies `word` to every value of a calibration in the order of the block. Reader and writer share it.
template <class Calib, class Word>
void each_value(Calib& c, Word word) {
    for (auto* camera : {&c.left, &c.right, &c.detection}) {
        word(camera->fx);
        word(camera->fy);
        word(camera->cx);
        word(camera->cy);
    }
    word(c.baseline_m);
    word(c.row_offset.constant);
    word(c.row_offset.slope);
    word(c.row_offset.per_disparity);
    for (auto& x : c.T_v_c.R) {
        word(x);
    }
    for (auto& x : c.T_v_c.t) {
        word(x);
    }
    for (auto& x : c.t_d_c) {
        word(x);
    }
}

/// Reads a block that outlives it. A block that ends early gives zeros and `ok() == false`.
class SceneReader {
public:
    SceneReader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {
        ok_ = word() == kMagic;
        frames_ = static_cast<int>(word());
        calibration_.width = static_cast<int>(word());
        calibration_.height = static_cast<int>(word());
        each_value(calibration_, [this](double& x) { x = number(); });
    }
    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] int frames() const { return frames_; }
    [[nodiscard]] const Calibration& calibration() const { return calibration_; }

    /// false: there is no further frame. `has_list`: the detector answered, `list` is its answer.
    [[nodiscard]] bool next(StereoFrame& frame, DetectionList& list, bool& has_list) {
        if (!ok_ || frames_read_ == frames_) {
            return false;
        }
        ++frames_read_;
        frame.time_us = static_cast<std::int64_t>(word());
        const auto count = static_cast<std::int64_t>(word());
        has_list = count >= 0;
        list = DetectionList{};
        list.time_us = frame.time_us;
        for (std::int64_t i = 0; i < count && ok_; ++i) {
            Detection d;
            d.box = Box2d{number(), number(), number(), number()};
            d.object_class = static_cast<ObjectClass>(word());
            d.viewpoint.horizontal = static_cast<std::int8_t>(word());
            d.viewpoint.vertical = static_cast<std::int8_t>(word());
            d.score = number();
            (void)list.items.try_push_back(d);
        }
        frame.left = image();
        frame.right = image();
        return ok_;
    }

private:
    std::uint64_t word() {
        std::uint64_t value = 0;
        if (left_ < sizeof value) {
            ok_ = false;
            return value;
        }
        std::memcpy(&value, at_, sizeof value);
        at_ += sizeof value;
        left_ -= sizeof value;
        return value;
    }
    double number() {
        const std::uint64_t bits = word();
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    ImageView image() {
        const auto pixels =
            static_cast<std::size_t>(calibration_.width) * static_cast<std::size_t>(calibration_.height);
        const std::size_t padded = (pixels + 7U) / 8U * 8U;
        if (left_ < padded) {
            ok_ = false;
            return {};
        }
        const ImageView view{at_, calibration_.width, calibration_.height, calibration_.width};
        at_ += padded;
        left_ -= padded;
        return view;
    }

    const std::uint8_t* at_;
    std::size_t left_;
    bool ok_{true};
    int frames_{0};
    int frames_read_{0};
    Calibration calibration_{};
};

}  // namespace semtrack::board

#endif
