// What every stage of every frame left behind, as hashes: of two runs whose results differ, the first row that differs
// names the frame, the stage and the object. Padding, pointers and sizes of types do not enter: rows are the same on
// every target that computes the same.
#ifndef SEMTRACK_SIL_STAGE_TRACE_HPP
#define SEMTRACK_SIL_STAGE_TRACE_HPP

#include <array>
#include <cstdint>
#include <string>

#include "semtrack/hal/stage_observer.hpp"
#include "semtrack/tracker.hpp"

namespace semtrack {

class TrackerCore;

/// Rows of stages.csv: frame,stage,object,hash; object: the track's id, 0 for what is nobody's. A track has a row when
/// the stage changed it.
class StageTrace final : public StageObserver {
public:
    [[nodiscard]] static std::string header() { return "frame,stage,object,hash\n"; }

    /// Everything is passed on to `next`. Nothing is recorded before watch().
    explicit StageTrace(StageObserver& next) : next_(next) {}
    void watch(const Tracker& tracker);
    void begin(Stage stage) noexcept override;
    void end(Stage stage) noexcept override;
    /// The rows since the last call, all of this frame.
    [[nodiscard]] std::string take(int frame);

private:
    void add(Stage stage, std::uint32_t object, std::uint64_t hash);
    void add_tracks(Stage stage);
    void add_features(Stage stage, bool tracked);

    StageObserver& next_;
    const TrackerCore* core_{nullptr};
    std::string rows_;                                                         ///< without the frame's number
    std::array<std::uint64_t, static_cast<std::size_t>(kMaxObjects)> last_{};  ///< by slot: only changes are rows
};

}  // namespace semtrack

#endif
