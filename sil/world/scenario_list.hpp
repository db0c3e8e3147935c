// The scenarios, one function each; the table of scenario.cpp gives them their names.
#ifndef SEMTRACK_SIL_WORLD_SCENARIO_LIST_HPP
#define SEMTRACK_SIL_WORLD_SCENARIO_LIST_HPP

#include "sil/world/scenario.hpp"

namespace semtrack::sil::world {

/// The default: parked cars on both sides, one car turning off, one oncoming, one overtaking, two pedestrians, a
/// cyclist, an exposure change.
[[nodiscard]] Scenario make_street_scenario();
/// The same street without road users.
[[nodiscard]] Scenario make_empty_scenario();
/// A queue in which moving vehicles cover more than half of the image.
[[nodiscard]] Scenario make_traffic_scenario();

}  // namespace semtrack::sil::world

#endif
