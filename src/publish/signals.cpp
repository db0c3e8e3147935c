#include "publish/signals.hpp"

namespace semtrack {

namespace {

constexpr ValueNames kNoYes = "0 no;1 yes";

constexpr std::array<SignalSpec, static_cast<std::size_t>(kSignals)> kSpecs{{
    {"ListCounter", 8, true, 1.0, 0.0, "", nullptr, "The same in every frame of a list; a receiver never mixes two"},
    {"ProtocolVersion", 4, true, 1.0, 0.0, "", nullptr, "Of this layout; others are to be ignored"},
    {"ObjectCount", 6, false, 1.0, 0.0, "", nullptr, "Objects that follow in this list"},
    {"ObjectsDropped", 6, false, 1.0, 0.0, "", nullptr,
     "Road users left out of this list: beyond the places of the list or of the tracker"},
    {"ImageTime", 40, true, 1.0, 0.0, "us", nullptr,
     "Time stamp of the images, modulo 2^40 us (12.7 days); all values refer to it"},
    {"ImageAge", 16, false, 0.1, 0.0, "ms", nullptr, "Age of the images when the list was sent"},
    {"EgoStatus", 3, false, 1.0, 0.0, "", "0 start;1 tracked;2 predicted;3 given", "Where the ego motion comes from"},
    {"EgoSpeed", 14, false, 0.01, -80.0, "m/s", nullptr, "Speed along the vehicle's x axis"},
    {"EgoYawRate", 13, false, 0.0005, -2.0, "rad/s", nullptr, "Yaw rate, positive to the left"},
    {"SigmaEgoSpeed", 10, false, 0.01, 0.0, "m/s", nullptr, "Standard deviation of EgoSpeed"},
    {"SigmaEgoYawRate", 10, false, 0.0005, 0.0, "rad/s", nullptr, "Standard deviation of EgoYawRate"},
    {"EgoDegraded", 2, false, 1.0, 0.0, "", kNoYes, "Ego motion is predicted, or few features agree with it"},
    {"NoRightImage", 2, false, 1.0, 0.0, "", kNoYes, "The right image is missing: no new depth from stereo"},
    {"NoDetections", 2, false, 1.0, 0.0, "", kNoYes, "No detection list came with this image"},
    {"HeaderSaturated", 2, false, 1.0, 0.0, "", kNoYes, "A value of the header lies outside its range"},
    {"FramesDropped", 16, true, 1.0, 0.0, "", nullptr, "Images lost since start, modulo 2^16"},
    {"ObjectId", 12, false, 1.0, 0.0, "", nullptr,
     "Of the track, modulo 4095: stays while the track lives; all ones: slot not used"},
    {"Class", 4, false, 1.0, 0.0, "", "0 car;1 van;2 truck;3 pedestrian;4 cyclist;5 tram;6 misc", "Kind of road user"},
    {"Status", 3, false, 1.0, 0.0, "", "0 new;1 measured;2 coasted;3 lost",
     "new: not confirmed yet; coasted: predicted, no detection; lost: sent once, then the track is gone"},
    {"Movement", 3, false, 1.0, 0.0, "", "0 unknown;1 standing;2 moving;3 oncoming;4 reversing", "Over ground"},
    {"Existence", 7, false, 0.01, 0.0, "", nullptr, "Probability that the object exists"},
    {"Age", 10, false, 1.0, 0.0, "cycles", nullptr, "Cycles since the first detection; stops at the highest value"},
    {"PositionX", 16, false, 0.01, -300.0, "m", nullptr, "ReferencePoint in the vehicle frame, forward"},
    {"PositionY", 16, false, 0.01, -300.0, "m", nullptr, "ReferencePoint in the vehicle frame, to the left"},
    {"PositionZ", 12, false, 0.01, -20.0, "m", nullptr, "ReferencePoint in the vehicle frame, up"},
    {"VelocityX", 14, false, 0.01, -80.0, "m/s", nullptr, "Over ground, along the vehicle's x axis"},
    {"VelocityY", 14, false, 0.01, -80.0, "m/s", nullptr, "Over ground, along the vehicle's y axis"},
    {"Yaw", 13, false, 0.0008, -3.2, "rad", nullptr, "Heading against the vehicle's x axis, positive to the left"},
    {"YawRate", 12, false, 0.001, -2.0, "rad/s", nullptr, "Over ground, positive to the left"},
    {"Length", 12, false, 0.01, 0.0, "m", nullptr, "Of the 3D box, along its heading"},
    {"Width", 10, false, 0.01, 0.0, "m", nullptr, "Of the 3D box, across its heading"},
    {"Height", 10, false, 0.01, 0.0, "m", nullptr, "Of the 3D box"},
    {"SigmaX", 10, false, 0.02, 0.0, "m", nullptr, "Standard deviation of PositionX"},
    {"SigmaY", 10, false, 0.02, 0.0, "m", nullptr, "Standard deviation of PositionY"},
    {"SigmaZ", 10, false, 0.02, 0.0, "m", nullptr, "Standard deviation of PositionZ"},
    {"SigmaVelocityX", 9, false, 0.05, 0.0, "m/s", nullptr, "Standard deviation of VelocityX"},
    {"SigmaVelocityY", 9, false, 0.05, 0.0, "m/s", nullptr, "Standard deviation of VelocityY"},
    {"SigmaYaw", 8, false, 0.0125, 0.0, "rad", nullptr, "Standard deviation of Yaw"},
    {"Truncated", 2, false, 1.0, 0.0, "", kNoYes, "More than a tenth of the projected box lies outside the image"},
    {"Occlusion", 3, false, 1.0, 0.0, "", "0 visible;1 partly;2 largely hidden;3 unknown",
     "Hidden by objects in front"},
    {"ReferencePoint", 3, false, 1.0, 0.0, "", "0 box centre;1 middle of the bottom face",
     "The point of the 3D box that the position is of; always the box centre in this version"},
    {"Saturated", 2, false, 1.0, 0.0, "", kNoYes, "A value of this object lies outside its range"},
    {"VehicleSpeed", 16, false, 0.005, -100.0, "m/s", nullptr,
     "Along the vehicle's x axis, negative when reversing; outside the range: not available"},
    {"VehicleYawRate", 16, false, 0.0001, -3.2, "rad/s", nullptr,
     "Positive to the left; outside the range: not available"},
    {"SigmaVehicleSpeed", 8, false, 0.02, 0.0, "m/s", nullptr, "Standard deviation of VehicleSpeed"},
    {"SigmaVehicleYawRate", 8, false, 0.001, 0.0, "rad/s", nullptr, "Standard deviation of VehicleYawRate"},
}};

}  // namespace

const SignalSpec& signal_spec(SignalId id) {
    return kSpecs[static_cast<std::size_t>(id)];
}

Quantised quantise(const SignalSpec& s, const SignalValue& v) {
    const double steps = (v.value - s.offset) / s.scale + 0.5;
    if (!v.available || !(steps - steps == 0.0)) {  // infinite or not a number
        return {all_ones(s.length), false};
    }
    const std::uint64_t highest = max_raw(s);
    if (steps < 0.0) {
        return {0, true};
    }
    if (steps >= static_cast<double>(highest) + 1.0) {
        return {highest, true};
    }
    return {static_cast<std::uint64_t>(steps), false};
}

}  // namespace semtrack
