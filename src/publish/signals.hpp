// Every signal of the object list, once: width, resolution, range, unit. The encoder, the DBC, the list.csv of a run
// and the receiver's tests all read this table.
#ifndef SEMTRACK_PUBLISH_SIGNALS_HPP
#define SEMTRACK_PUBLISH_SIGNALS_HPP

#include <array>
#include <cstdint>

#include "publish/bits.hpp"

namespace semtrack {

/// The header's signals first, then an object's, then those of the vehicle motion that semtrack receives.
enum class SignalId : std::uint8_t {
    kListCounter,
    kProtocolVersion,
    kObjectCount,
    kObjectsDropped,
    kImageTime,
    kImageAge,
    kEgoStatus,
    kEgoSpeed,
    kEgoYawRate,
    kSigmaEgoSpeed,
    kSigmaEgoYawRate,
    kEgoDegraded,
    kNoRightImage,
    kNoDetections,
    kHeaderSaturated,
    kFramesDropped,
    kObjectId,
    kClass,
    kStatus,
    kMovement,
    kExistence,
    kAge,
    kPositionX,
    kPositionY,
    kPositionZ,
    kVelocityX,
    kVelocityY,
    kYaw,
    kYawRate,
    kLength,
    kWidth,
    kHeight,
    kSigmaX,
    kSigmaY,
    kSigmaZ,
    kSigmaVelocityX,
    kSigmaVelocityY,
    kSigmaYaw,
    kTruncated,
    kOcclusion,
    kReferencePoint,
    kSaturated,
    kVehicleSpeed,
    kVehicleYawRate,
    kSigmaVehicleSpeed,
    kSigmaVehicleYawRate
};
inline constexpr int kSignals = 46;
inline constexpr int kFirstObjectSignal = static_cast<int>(SignalId::kObjectId);
inline constexpr int kListSignals = static_cast<int>(SignalId::kVehicleSpeed);  // those of the object list

/// Names of values, "0 text;1 text;..." (text: letters, digits, blanks); null: a number.
using ValueNames = const char*;

struct SignalSpec {
    const char* name;
    std::uint8_t length;  ///< bits
    bool counts;          ///< wraps and is never missing: all ones is a value like any other
    double scale;         ///< physical = raw * scale + offset
    double offset;
    const char* unit;
    ValueNames values;
    const char* comment;
};

[[nodiscard]] const SignalSpec& signal_spec(SignalId id);

/// Highest raw value that is a physical one.
[[nodiscard]] constexpr std::uint64_t max_raw(const SignalSpec& s) {
    return s.counts ? all_ones(s.length) : all_ones(s.length) - 1U;
}
[[nodiscard]] inline double physical(const SignalSpec& s, std::uint64_t raw) {
    return static_cast<double>(raw) * s.scale + s.offset;
}

/// Physical values of a record, before quantisation.
struct SignalValue {
    double value{0};
    bool available{false};
};
using SignalValues = std::array<SignalValue, static_cast<std::size_t>(kSignals)>;

struct Quantised {
    std::uint64_t raw{0};
    bool saturated{false};  ///< the value lies outside the range; raw is the nearest end of it
};
/// Nearest raw value; not available, or not finite: all ones. A counter has to be given within its range.
[[nodiscard]] Quantised quantise(const SignalSpec& s, const SignalValue& v);

}  // namespace semtrack

#endif
