#include "publish/messages.hpp"

#include "publish/e2e.hpp"

namespace semtrack {

namespace {

using S = SignalId;

constexpr MessageSpec kHeaderFd{
    "ListHeader",
    24,
    0,
    15,
    {S::kProtocolVersion, S::kObjectCount, S::kObjectsDropped, S::kImageTime, S::kImageAge, S::kEgoStatus, S::kEgoSpeed,
     S::kEgoYawRate, S::kSigmaEgoSpeed, S::kSigmaEgoYawRate, S::kEgoDegraded, S::kNoRightImage, S::kNoDetections,
     S::kHeaderSaturated, S::kFramesDropped},
    "Once a cycle, before the objects"};

constexpr MessageSpec kPairFd{
    "ObjectPair",
    64,
    2,
    26,
    {S::kObjectId,       S::kClass,          S::kStatus,         S::kMovement,  S::kExistence, S::kAge,
     S::kPositionX,      S::kPositionY,      S::kPositionZ,      S::kVelocityX, S::kVelocityY, S::kYaw,
     S::kYawRate,        S::kLength,         S::kWidth,          S::kHeight,    S::kSigmaX,    S::kSigmaY,
     S::kSigmaZ,         S::kSigmaVelocityX, S::kSigmaVelocityY, S::kSigmaYaw,  S::kTruncated, S::kOcclusion,
     S::kReferencePoint, S::kSaturated},
    "Two objects; as many frames a cycle as ObjectCount asks for, slots behind the last object are all ones"};

constexpr MessageSpec vehicle_motion(std::uint8_t length) {
    return {"VehicleMotion",
            length,
            0,
            4,
            {S::kVehicleSpeed, S::kVehicleYawRate, S::kSigmaVehicleSpeed, S::kSigmaVehicleYawRate},
            "The vehicle's own motion, received by semtrack; valid at its reception"};
}

constexpr DialectSpec kFd{"fd", true, 2, 1, kMaxObjects, "PairIndex", {{kHeaderFd, kPairFd}}, vehicle_motion(12)};

// 16 objects: 32 would take more than half of a bus of 500 kbit/s at ten lists a second.
constexpr DialectSpec kClassic{
    "classic",
    false,
    11,
    4,
    16,
    "ObjectSlot",
    {{{"ListHeader",
       8,
       0,
       5,
       {S::kObjectCount, S::kObjectsDropped, S::kImageAge, S::kProtocolVersion, S::kEgoStatus},
       "First of the four header messages, once a cycle"},
      {"ListTime", 8, 0, 1, {S::kImageTime}, "Second header message"},
      {"EgoMotion",
       8,
       0,
       5,
       {S::kEgoSpeed, S::kEgoYawRate, S::kEgoDegraded, S::kNoRightImage, S::kNoDetections},
       "Third header message"},
      {"EgoSigma",
       8,
       0,
       4,
       {S::kSigmaEgoSpeed, S::kSigmaEgoYawRate, S::kHeaderSaturated, S::kFramesDropped},
       "Fourth header message"},
      {"ObjectPosition", 8, 1, 3, {S::kPositionX, S::kPositionY, S::kStatus}, "One a cycle and object"},
      {"ObjectVelocity", 8, 1, 3, {S::kVelocityX, S::kVelocityY, S::kExistence}, "One a cycle and object"},
      {"ObjectHeading", 8, 1, 4, {S::kPositionZ, S::kYaw, S::kClass, S::kMovement}, "One a cycle and object"},
      {"ObjectIdentity", 8, 1, 4, {S::kObjectId, S::kAge, S::kYawRate, S::kSaturated}, "One a cycle and object"},
      {"ObjectSize", 8, 1, 4, {S::kLength, S::kWidth, S::kHeight, S::kOcclusion}, "One a cycle and object"},
      {"ObjectSigmaPosition",
       8,
       1,
       5,
       {S::kSigmaX, S::kSigmaY, S::kSigmaZ, S::kTruncated, S::kReferencePoint},
       "One a cycle and object"},
      {"ObjectSigmaVelocity",
       8,
       1,
       3,
       {S::kSigmaVelocityX, S::kSigmaVelocityY, S::kSigmaYaw},
       "One a cycle and object"}}},
    vehicle_motion(8)};

}  // namespace

const DialectSpec& dialect_spec(CanDialect dialect) {
    return dialect == CanDialect::kClassic ? kClassic : kFd;
}

int protection_bits(const DialectSpec& dialect) {
    return dialect.fd ? kProfile5Bits : kProfile11Bits;
}

int list_counter_bit(const DialectSpec& dialect) {
    return protection_bits(dialect);
}

int record_index_bit(const DialectSpec& dialect) {
    return list_counter_bit(dialect) + signal_spec(SignalId::kListCounter).length;
}

int first_signal_bit(const DialectSpec& dialect, const MessageSpec& message) {
    return record_index_bit(dialect) + (message.records > 0 ? kRecordIndexBits : 0);
}

int record_bits(const MessageSpec& message) {
    int bits = 0;
    for (int i = 0; i < message.signals; ++i) {
        bits += signal_spec(message.signal[static_cast<std::size_t>(i)]).length;
    }
    return bits;
}

}  // namespace semtrack
