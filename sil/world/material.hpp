// Reflectance of the street's surfaces from texture coordinates (model coordinates of the face, m).
#ifndef SEMTRACK_SIL_WORLD_MATERIAL_HPP
#define SEMTRACK_SIL_WORLD_MATERIAL_HPP

#include "sil/world/model_piece.hpp"

namespace semtrack::sil::world {

/// Where a sample lies on its face, and how much of the face it covers along each coordinate.
struct SurfacePoint {
    float s{0};
    float t{0};
    float fs{0};
    float ft{0};
};

/// 0..1. Every pattern is filtered to the footprint: steps by their covered share, noise by leaving octaves out.
[[nodiscard]] float reflectance(const Surface& surface, const SurfacePoint& at);
/// The same for ellipsoids, in their own coordinates (m).
[[nodiscard]] float reflectance(const Surface& surface, float x, float y, float z, float footprint);
/// false: a hole in the leaves; rim is 0 in the middle of the crown and 1 at its silhouette.
[[nodiscard]] bool leaf_at(const Surface& surface, float x, float y, float z, float footprint, float rim);
/// Radiance of the sky in the direction (x right, y down, z forward in N), not normalised.
[[nodiscard]] float sky(double x, double y, double z, float footprint);

}  // namespace semtrack::sil::world

#endif
