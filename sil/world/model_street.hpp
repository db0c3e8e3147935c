// The street itself: road, pavements, houses, gardens, trees, lamps, signs; generated from the street's seed.
#ifndef SEMTRACK_SIL_WORLD_MODEL_STREET_HPP
#define SEMTRACK_SIL_WORLD_MODEL_STREET_HPP

#include <vector>

#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

struct StreetModel {
    Pieces pieces{};  ///< in N
    std::vector<ShadowHouse> houses{};
    std::vector<ShadowBlock> crowns{};
};

/// From z0 to z1 along the street; the far end is closed by houses and trees.
[[nodiscard]] StreetModel make_street(const Street& street, double z0, double z1);

/// Parts, in their own model frames.
/// House of `length` along x from 0, front at y = 0, reaching back to y = -depth (right side of the street).
[[nodiscard]] Pieces make_house(double length, double depth, double eaves, double ridge, std::uint32_t seed);
/// Tree with its trunk at the origin.
[[nodiscard]] Pieces make_tree(double height, double crown_radius, std::uint32_t seed);
[[nodiscard]] Pieces make_lamp(double height, double arm);
[[nodiscard]] Pieces make_traffic_sign(std::uint32_t seed);

}  // namespace semtrack::sil::world

#endif
