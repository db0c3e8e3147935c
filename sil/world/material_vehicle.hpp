// Surfaces of vehicles: paint with seams and reflections, lamps, plates, windows, wheels.
#ifndef SEMTRACK_SIL_WORLD_MATERIAL_VEHICLE_HPP
#define SEMTRACK_SIL_WORLD_MATERIAL_VEHICLE_HPP

#include "sil/world/material.hpp"

namespace semtrack::sil::world {

[[nodiscard]] float vehicle_reflectance(const Surface& surface, const SurfacePoint& at);

}  // namespace semtrack::sil::world

#endif
