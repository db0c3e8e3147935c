// Road users from convex pieces, inside their labelled 3D box and touching all its faces (so that the box is tight).
#ifndef SEMTRACK_SIL_WORLD_MODEL_ROAD_USER_HPP
#define SEMTRACK_SIL_WORLD_MODEL_ROAD_USER_HPP

#include <cstdint>

#include "semtrack/types.hpp"
#include "sil/world/model_piece.hpp"

namespace semtrack::sil::world {

enum class BodyStyle : std::uint8_t { kSaloon, kEstate, kHatchback };

struct Look {
    BodyStyle style{BodyStyle::kSaloon};
    float tone{0.3F};       ///< of the paint or the clothes
    std::uint32_t seed{0};  ///< of its textures
};

/// size: length, width, height in m; M's origin is the middle of the box's bottom. gait: phase of the walk in
/// steps (only pedestrians and cyclists move parts of their own).
[[nodiscard]] Pieces make_road_user(ObjectClass object_class, const Vec3& size_m, const Look& look, double gait);

/// Parts, by kind.
[[nodiscard]] Pieces make_car(const Vec3& size_m, const Look& look);
[[nodiscard]] Pieces make_van(const Vec3& size_m, const Look& look);
[[nodiscard]] Pieces make_truck(const Vec3& size_m, const Look& look);
[[nodiscard]] Pieces make_tram(const Vec3& size_m, const Look& look);
[[nodiscard]] Pieces make_pedestrian(const Vec3& size_m, const Look& look, double gait);
[[nodiscard]] Pieces make_cyclist(const Vec3& size_m, const Look& look, double gait);

}  // namespace semtrack::sil::world

#endif
