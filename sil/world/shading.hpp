// Radiance of a sample: reflectance of its surface, sun, sky, shadows on the ground, haze.
#ifndef SEMTRACK_SIL_WORLD_SHADING_HPP
#define SEMTRACK_SIL_WORLD_SHADING_HPP

#include <vector>

#include "sil/world/raycast.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

/// Share of the sun that reaches points of the ground, 0..1.
class GroundShadow {
public:
    GroundShadow(const Scene& scene, const std::vector<ShadowBlock>& blocks);
    [[nodiscard]] float lit(float x, float z, float footprint) const;

private:
    const std::vector<ShadowHouse>& houses_;
    std::vector<ShadowBlock> blocks_;
    float first_z_{0};
    std::vector<std::vector<int>> blocks_at_{};  ///< by metre of z
    std::vector<std::vector<int>> houses_at_{};
};

class Shader {
public:
    Shader(const Scene& scene, const View& view, const std::vector<Shade>& shades,
           const std::vector<ShadowBlock>& blocks);
    /// 0..about 1.2; 1 is white at gain 1.
    [[nodiscard]] bool is_ground(std::uint32_t id) const { return shades_[id].ground; }
    [[nodiscard]] float radiance(std::uint32_t id, float inverse_depth, double ray_x, double ray_y) const;

private:
    [[nodiscard]] float face(const Shade& shade, double q, double x, double y) const;
    [[nodiscard]] float ellipsoid(const Shade& shade, double q, double x, double y) const;

    const View& view_;
    const std::vector<Shade>& shades_;
    GroundShadow shadow_;
    double per_pixel_x_;  ///< of the ray, times the sample's share of the pixel
    double per_pixel_y_;
    float sun_;
    float ambient_;
};

}  // namespace semtrack::sil::world

#endif
