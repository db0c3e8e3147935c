#include "sil/world/shading.hpp"

#include <cmath>

#include "sil/world/material.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

// The samples of a pixel share its area; a little more than half its width each, so that they overlap.
constexpr double kSampleShare = 0.6;
constexpr float kHaze_m = 900.0F;
constexpr float kSunX = 0.44F / 0.78F;  // shadow's shift per metre of height, away from the sun
constexpr float kSunZ = 0.445F / 0.78F;

float clamp01(float x) {
    return x < 0.0F ? 0.0F : (x > 1.0F ? 1.0F : x);
}
double magnitude(double x) {
    return x < 0.0 ? -x : x;
}

// 1 inside, 0 outside, over a soft edge.
float soft(float inside_m, float edge_m) {
    return clamp01(0.5F + inside_m / edge_m);
}

// Shadow of an upright block: its base and two sections of it, shifted away from the sun.
float block_shadow(const ShadowBlock& b, float x, float z, float footprint) {
    float dark = 0.0F;
    for (int k = 0; k < 3; ++k) {
        const float up = 0.45F * static_cast<float>(k) * b.height;
        const float dx = x - b.x - up * kSunX;
        const float dz = z - b.z - up * kSunZ;
        const float along = dx * b.along_x + dz * b.along_z;
        const float across = dx * b.along_z - dz * b.along_x;
        const float shrink = k == 2 ? 0.2F : 0.02F;
        const float edge = 0.06F + footprint + 0.04F * up;
        const float in_a = b.half_length - shrink - (along < 0.0F ? -along : along);
        const float in_b = b.half_width - shrink - (across < 0.0F ? -across : across);
        const float d = soft(in_a, edge) * soft(in_b, edge);
        dark = d > dark ? d : dark;
    }
    return dark;
}

float crown_shadow(const ShadowBlock& b, float x, float z, float footprint) {
    const float dx = x - b.x - b.height * kSunX;
    const float dz = z - b.z - b.height * kSunZ;
    const float r = std::sqrt(dx * dx + dz * dz) / b.half_length;
    const float n = octaves2(x, z, footprint, {0.8F, 4, 0.8F}, 515U);
    return 0.85F * clamp01(0.5F + 2.2F * (1.05F - r) + 0.9F * n - 0.4F);
}

}  // namespace

GroundShadow::GroundShadow(const Scene& scene, const std::vector<ShadowBlock>& blocks)
    : houses_(scene.shadow_houses()), blocks_(blocks) {
    constexpr float kReach_m = 12.0F;
    float last = 0.0F;
    for (const ShadowHouse& h : houses_) {
        first_z_ = h.from_z < first_z_ ? h.from_z : first_z_;
        last = h.to_z > last ? h.to_z : last;
    }
    const std::size_t n = static_cast<std::size_t>(last - first_z_) + 1U;
    blocks_at_.resize(n);
    houses_at_.resize(n);
    const auto mark = [&](std::vector<std::vector<int>>& at, float z0, float z1, int index) {
        for (int m = floor_int(z0 - first_z_); m <= floor_int(z1 - first_z_); ++m) {
            if (m >= 0 && m < static_cast<int>(n)) {
                at[static_cast<std::size_t>(m)].push_back(index);
            }
        }
    };
    for (std::size_t k = 0; k < houses_.size(); ++k) {
        if (houses_[k].front_x < 0.0F) {
            mark(houses_at_, houses_[k].from_z, houses_[k].to_z + kReach_m, static_cast<int>(k));
        }
    }
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
        const ShadowBlock& b = blocks_[k];
        const float r = b.half_length + b.half_width;
        mark(blocks_at_, b.z - r, b.z + r + b.height * kSunZ + 1.0F, static_cast<int>(k));
    }
}

float GroundShadow::lit(float x, float z, float footprint) const {
    const int m = floor_int(z - first_z_);
    if (m < 0 || m >= static_cast<int>(blocks_at_.size())) {
        return 1.0F;
    }
    float dark = 0.0F;
    for (const int k : houses_at_[static_cast<std::size_t>(m)]) {
        const ShadowHouse& h = houses_[static_cast<std::size_t>(k)];
        const float over = (x - h.front_x) / kSunX;  // height of the sun's ray over the house front
        const float from = z - over * kSunZ;
        if (over <= 0.0F) {
            continue;
        }
        const float edge = 0.05F + footprint;
        const float d =
            soft(h.eaves - over, 0.1F + footprint) * soft(from - h.from_z, edge) * soft(h.to_z - from, edge);
        dark = d > dark ? d : dark;
    }
    for (const int k : blocks_at_[static_cast<std::size_t>(m)]) {
        const ShadowBlock& b = blocks_[static_cast<std::size_t>(k)];
        const float d = b.crown ? crown_shadow(b, x, z, footprint) : block_shadow(b, x, z, footprint);
        dark = d > dark ? d : dark;
    }
    return 1.0F - dark;
}

Shader::Shader(const Scene& scene, const View& view, const std::vector<Shade>& shades,
               const std::vector<ShadowBlock>& blocks)
    : view_(view),
      shades_(shades),
      shadow_(scene, blocks),
      per_pixel_x_(kSampleShare / view.fx),
      per_pixel_y_(kSampleShare * view.row_scale),
      sun_(static_cast<float>(scene.scenario().street.sun)),
      ambient_(static_cast<float>(scene.scenario().street.ambient)) {}

float Shader::face(const Shade& f, double q, double x, double y) const {
    const double depth = 1.0 / q;
    const double s = f.s.at(x, y);
    const double t = f.t.at(x, y);
    SurfacePoint at;
    at.s = static_cast<float>(s * depth + f.s0);
    at.t = static_cast<float>(t * depth + f.t0);
    const double sz = s * depth;
    const double tz = t * depth;
    at.fs = static_cast<float>(
        depth * (magnitude(f.s.a - sz * f.q.a) * per_pixel_x_ + magnitude(f.s.b - sz * f.q.b) * per_pixel_y_));
    at.ft = static_cast<float>(
        depth * (magnitude(f.t.a - tz * f.q.a) * per_pixel_x_ + magnitude(f.t.b - tz * f.q.b) * per_pixel_y_));
    float light = ambient_ * f.skylight;
    float direct = sun_ * f.direct;
    if (f.ground) {
        const float foot = at.fs > at.ft ? at.fs : at.ft;
        const float lit = shadow_.lit(-at.t, at.s, foot);
        direct *= lit;
        light *= 0.6F + 0.4F * lit;
    }
    return reflectance(f.surface, at) * (light + direct);
}

float Shader::ellipsoid(const Shade& f, double q, double x, double y) const {
    const Piece& p = *f.ellipsoid;
    const double depth = 1.0 / q;
    const Vec3 on = p.R.transpose() * (view_.T_n_c * Vec3(x * depth, y * depth, depth) - p.centre);
    Vec3 normal = on.cwiseQuotient(p.radii.cwiseProduct(p.radii));
    normal = p.R * (normal / std::sqrt(normal.dot(normal)));
    const double direct = normal.dot(sun_direction());
    const float light = ambient_ * static_cast<float>(0.7 - 0.3 * normal(1)) +
                        sun_ * (direct > 0.0 ? static_cast<float>(direct) : 0.0F);
    return reflectance(f.surface, static_cast<float>(on(0)), static_cast<float>(on(1)), static_cast<float>(on(2)),
                       static_cast<float>(depth * per_pixel_x_)) *
           light;
}

float Shader::radiance(std::uint32_t id, float inverse_depth, double x, double y) const {
    const float brightness = 0.75F * sun_ + 0.45F * ambient_;
    if (id == 0U) {
        const Vec3 d = view_.T_n_c.R * Vec3(x, y, 1.0);
        return brightness * sky(d(0), d(1), d(2), static_cast<float>(per_pixel_x_));
    }
    const Shade& f = shades_[id];
    const double q = static_cast<double>(inverse_depth);
    const float r = f.ellipsoid != nullptr ? ellipsoid(f, q, x, y) : face(f, q, x, y);
    const float depth = 1.0F / inverse_depth;
    return blend(r, 0.8F * brightness, depth / (depth + kHaze_m));
}

}  // namespace semtrack::sil::world
