// Wall-clock time of a frame's stages. Time is observed here and nowhere else: it reaches timing.csv only.
#ifndef SEMTRACK_SIL_STAGE_TIMER_HPP
#define SEMTRACK_SIL_STAGE_TIMER_HPP

#include <chrono>

#include "semtrack/hal/stage_observer.hpp"
#include "sil/report/tables.hpp"

namespace semtrack::sil {

class StageTimer final : public StageObserver {
public:
    /// The images are decoded: from here on it counts.
    void start_frame() {
        timing_ = FrameTiming{};
        start_ = Clock::now();
    }
    void begin(Stage) noexcept override { stage_start_ = Clock::now(); }
    void end(Stage stage) noexcept override {
        const Clock::time_point now = Clock::now();
        timing_.stage_us[static_cast<std::size_t>(stage)] += microseconds(now - stage_start_);
        timing_.total_us = microseconds(now - start_);  // the last stage of a frame is the encoding
    }
    [[nodiscard]] const FrameTiming& timing() const { return timing_; }

private:
    using Clock = std::chrono::steady_clock;
    static double microseconds(Clock::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

    FrameTiming timing_{};
    Clock::time_point start_{};
    Clock::time_point stage_start_{};
};

}  // namespace semtrack::sil

#endif
