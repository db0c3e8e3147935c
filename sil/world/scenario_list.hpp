// The scenarios, one function each; the table of scenario.cpp gives them their names.
#ifndef SEMTRACK_SIL_WORLD_SCENARIO_LIST_HPP
#define SEMTRACK_SIL_WORLD_SCENARIO_LIST_HPP

#include "sil/world/scenario.hpp"

namespace semtrack::sil::world {

/// Motion of the box's middle (ego: the camera).
[[nodiscard]] Motion make_motion(double x, double z, double heading, double speed, std::vector<Phase> phases = {});
/// A lane's change as two arcs of equal angle and duration; `radius` of the first (negative: to the right), `speed` at
/// its start.
[[nodiscard]] std::vector<Phase> change_lane(double wait_s, double speed, double arc_s, double radius,
                                             double acceleration);

// scenario_street.cpp
/// The default: parked cars on both sides, one car turning off, one oncoming, one overtaking, two pedestrians, a
/// cyclist, an exposure change.
[[nodiscard]] Scenario make_street_scenario();
/// The same street without road users.
[[nodiscard]] Scenario make_empty_scenario();

// scenario_traffic.cpp: what moves
/// A queue in which moving vehicles cover more than half of the image.
[[nodiscard]] Scenario make_traffic_scenario();
/// 700 m behind one car, which stays 12-20 m ahead for more than 200 m of them.
[[nodiscard]] Scenario make_follow_scenario();
/// The ego stands; cars cross from both sides.
[[nodiscard]] Scenario make_crossing_scenario();
/// A car overtakes and cuts in 7 m ahead.
[[nodiscard]] Scenario make_cut_in_scenario();
/// A car overtakes so close that it is cut by the image's border for seconds.
[[nodiscard]] Scenario make_beside_scenario();
/// The ego passes a slower car: seen whole at first, then for seconds with two edges outside the image.
[[nodiscard]] Scenario make_passed_scenario();
/// A car turns off, one turns in.
[[nodiscard]] Scenario make_turning_scenario();
/// A parked car backs out on an arc, stops and drives off.
[[nodiscard]] Scenario make_reversing_scenario();
/// Five pedestrians cross in front of a slow ego.
[[nodiscard]] Scenario make_pedestrians_scenario();
/// Cars 60-100 m ahead and a detector that sees them.
[[nodiscard]] Scenario make_far_scenario();
/// A crossing car is hidden behind a standing truck for 2 s.
[[nodiscard]] Scenario make_occlusion_scenario();
/// The ego stands in a street; traffic passes.
[[nodiscard]] Scenario make_standing_scenario();
/// The ego and the car ahead brake with 7 m/s^2 from 13 m/s.
[[nodiscard]] Scenario make_braking_scenario();
/// 5 degrees up and down again, with traffic.
[[nodiscard]] Scenario make_hill_scenario();

// scenario_ego.cpp: the ego-motion alone
/// 340 m between parked cars, nothing moves, a rectification without residual.
[[nodiscard]] Scenario make_avenue_scenario();
/// The same with the residual that the other scenarios have.
[[nodiscard]] Scenario make_avenue_residual_scenario();
/// The traffic, a rectification without residual; the same street and ego-motion without road users.
[[nodiscard]] Scenario make_queue_scenario();
[[nodiscard]] Scenario make_queue_empty_scenario();

// scenario_camera.cpp: the street through bad cameras and detectors
/// Its first four seconds: the car ahead, the oncoming one, pedestrians, parked cars; the base of those below.
[[nodiscard]] Scenario make_short_street_scenario();
[[nodiscard]] Scenario make_night_scenario();
/// Both images at half the light from one frame on, and back.
[[nodiscard]] Scenario make_exposure_scenario();
[[nodiscard]] Scenario make_dropped_scenario();
/// The emergency braking without images for half a second while the car brakes.
[[nodiscard]] Scenario make_blackout_scenario();
/// The right camera sees nothing for 0.5 s.
[[nodiscard]] Scenario make_blind_right_scenario();
/// The right image lies 1 px lower than calibrated.
[[nodiscard]] Scenario make_misaligned_scenario();
[[nodiscard]] Scenario make_detector_5hz_scenario();
/// 30 % of the boxes are missed.
[[nodiscard]] Scenario make_detector_misses_scenario();
[[nodiscard]] Scenario make_no_viewpoint_scenario();

}  // namespace semtrack::sil::world

#endif
