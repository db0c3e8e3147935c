// Time is observed, never obeyed: the core has no clock and tells an observer where it is.
#ifndef SEMTRACK_HAL_STAGE_OBSERVER_HPP
#define SEMTRACK_HAL_STAGE_OBSERVER_HPP

#include <cstdint>

namespace semtrack {

enum class Stage : std::uint8_t {
    kInfer = 0, kAssociate, kMask, kExtract, kMatch, kReject, kEgo, kObjects, kAlign, kLifecycle, kEncode
};
inline constexpr int kStages = 11;

/// Column names of timing.csv without "_us".
[[nodiscard]] constexpr const char* stage_name(Stage stage) {
    constexpr const char* kNames[kStages] = {"infer", "associate", "mask", "extract", "match", "reject",
                                             "ego", "objects", "align", "lifecycle", "encode"};
    return kNames[static_cast<int>(stage)];
}

class StageObserver {
public:
    /// A stage may begin and end several times within a frame; stages do not nest.
    virtual void begin(Stage stage) noexcept = 0;
    virtual void end(Stage stage) noexcept = 0;

protected:
    ~StageObserver() = default;
};

}  // namespace semtrack

#endif
