// Where a cycle gets its input from. Implementations own what they return until the next call; none blocks for
// longer than the camera's period; none throws.
#ifndef SEMTRACK_HAL_SOURCES_HPP
#define SEMTRACK_HAL_SOURCES_HPP

#include <cstdint>

#include "semtrack/types.hpp"

namespace semtrack {

enum class SourceResult : std::uint8_t {
    kOk = 0,  ///< something new was stored
    kNone,    ///< nothing new; the output is untouched
    kEnd,     ///< there will be nothing more
    kError    ///< the source failed; the output is untouched
};

/// One stereo pair, or the news that a frame was dropped (both views empty; time_us is when it was due).
struct StereoFrame {
    std::int64_t time_us{0};
    ImageView left{};
    ImageView right{};
};

class StereoSource {
public:
    [[nodiscard]] virtual SourceResult next(StereoFrame& frame) noexcept = 0;

protected:
    ~StereoSource() = default;
};

class DetectionSource {
public:
    /// All lists that arrived by now_us (the image's time of this cycle), oldest first; each carries the time stamp
    /// of its own image.
    [[nodiscard]] virtual SourceResult poll(std::int64_t now_us,
                                            StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept = 0;

protected:
    ~DetectionSource() = default;
};

class VehicleMotionSource {
public:
    /// The newest motion by now_us.
    [[nodiscard]] virtual SourceResult poll(std::int64_t now_us, VehicleMotion& motion) noexcept = 0;

protected:
    ~VehicleMotionSource() = default;
};

/// A localisation from outside (replay with given poses).
class EgoPoseSource {
public:
    [[nodiscard]] virtual SourceResult poll(std::int64_t now_us, RigidTransform& T_w_v) noexcept = 0;

protected:
    ~EgoPoseSource() = default;
};

/// Features from outside: masks, rejection and both estimators work on them as on the images' own.
class FeatureSource {
public:
    /// Those of the frame at time_us, in any order.
    [[nodiscard]] virtual SourceResult poll(std::int64_t time_us, ExternalFeatures& features) noexcept = 0;

protected:
    ~FeatureSource() = default;
};

}  // namespace semtrack

#endif
