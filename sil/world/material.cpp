#include "sil/world/material.hpp"

#include <cmath>

#include "sil/world/material_vehicle.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

float larger(float a, float b) {
    return a > b ? a : b;
}

float plain(const Surface& f, const SurfacePoint& at) {
    return f.tone * (1.0F + 0.16F * octaves2(at.s, at.t, larger(at.fs, at.ft), {0.4F, 6, 0.9F}, f.seed));
}

// Dashed centre line, kerb-side line of the parking lane.
float lane_marks(const Surface& f, const SurfacePoint& at) {
    const float centre = 0.5F * f.p[0];
    float paint = cover(at.t, at.ft, centre - 0.06F, centre + 0.06F) * cover_periodic(at.s, at.fs, 9.0F, 0.0F, 3.0F);
    paint += cover(at.t, at.ft, -centre - 0.05F, -centre + 0.05F) * cover_periodic(at.s, at.fs, 2.0F, 0.0F, 1.0F);
    const float parking = f.p[0] * (f.p[1] + 0.5F);
    paint += cover(at.t, at.ft, parking - 0.05F, parking + 0.05F) * cover_periodic(at.s, at.fs, 2.0F, 0.0F, 1.0F);
    return paint > 1.0F ? 1.0F : paint;
}

// Manholes and repairs: one candidate per cell of 6 m by 3 m.
float repairs(const Surface& f, const SurfacePoint& at) {
    const int i = floor_int(at.s / 6.0F);
    const int j = floor_int(at.t / 3.0F);
    const std::uint32_t h = hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), f.seed);
    const float s = at.s - 6.0F * static_cast<float>(i);
    const float t = at.t - 3.0F * static_cast<float>(j);
    if (h % 5U == 0U) {
        const float r = std::sqrt((s - 3.0F) * (s - 3.0F) + (t - 1.5F) * (t - 1.5F));
        const float bars = cover_periodic(t, at.ft, 0.12F, 0.0F, 0.05F);
        return 1.0F - 0.55F * cover(r, larger(at.fs, at.ft), 0.0F, 0.33F) * (0.6F + 0.4F * bars);
    }
    if (h % 5U < 3U) {
        const float a = 0.4F + 2.0F * unit(mix(h));
        const float b = a + 1.0F + 2.4F * unit(mix(h + 1U));
        const float c = 0.3F + 0.8F * unit(mix(h + 2U));
        const float patch = cover(s, at.fs, a, b) * cover(t, at.ft, c, c + 1.4F);
        const float seam = patch - cover(s, at.fs, a + 0.04F, b - 0.04F) * cover(t, at.ft, c + 0.04F, c + 1.36F);
        return 1.0F + (unit(mix(h + 3U)) - 0.55F) * 0.5F * patch - 0.35F * seam;
    }
    return 1.0F;
}

float asphalt(const Surface& f, const SurfacePoint& at) {
    const float foot = larger(at.fs, at.ft);
    float grain = 0.07F * octaves2(at.s, at.t, foot, {2.0F, 3, 0.8F}, f.seed);
    grain += 0.17F * octaves2(at.s, at.t, foot, {0.14F, 5, 0.97F}, f.seed + 1U);
    // Cracks: zero line of a smooth noise, a few centimetres wide; out of sight where a sample covers more than that.
    float crack = 0.0F;
    if (foot < 0.08F) {
        const float n = noise2(at.s * 0.45F, at.t * 0.45F, f.seed + 5U) +
                        0.12F * noise2(at.s * 2.3F, at.t * 2.3F, f.seed + 6U) - 0.56F;
        crack = cover(n, 0.05F + 0.6F * foot, -0.008F, 0.008F) * (1.0F - foot / 0.08F);
    }
    float r = f.tone * (1.0F + grain) * repairs(f, at) * (1.0F - 0.7F * crack);
    const float paint = lane_marks(f, at);
    if (paint > 0.0F) {
        const float worn = 0.62F + 0.18F * octaves2(at.s, at.t, foot, {0.3F, 4, 0.9F}, f.seed + 9U);
        r = blend(r, worn, paint * 0.85F);
    }
    return r;
}

float paving(const Surface& f, const SurfacePoint& at) {
    const float foot = larger(at.fs, at.ft);
    if (at.t > -0.5F && at.t < 0.5F) {  // kerb stone, its vertical face
        const float joint = cover_periodic(at.s, at.fs, 1.0F, 0.0F, 0.02F);
        return 0.5F * (1.0F - 0.6F * joint + 0.15F * octaves2(at.s, at.t, foot, {0.3F, 5, 0.9F}, f.seed));
    }
    const float kerb = at.t - f.p[0];
    if (kerb < 0.16F && kerb > -0.16F) {
        const float joint = cover_periodic(at.s, at.fs, 1.0F, 0.0F, 0.02F);
        return 0.62F * (1.0F - 0.6F * joint + 0.12F * octaves2(at.s, at.t, foot, {0.3F, 5, 0.9F}, f.seed));
    }
    constexpr float kStone = 0.4F;
    const int row = floor_int(at.t / kStone);
    const float shift = (row & 1) != 0 ? 0.5F * kStone : 0.0F;
    const int column = floor_int((at.s + shift) / kStone);
    float joint = cover_periodic(at.s + shift, at.fs, kStone, 0.0F, 0.022F);
    joint = larger(joint, cover_periodic(at.t, at.ft, kStone, 0.0F, 0.022F));
    const float w = foot > 0.3F ? 0.0F : 1.0F - foot / 0.3F;
    const float stone = unit(hash(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), f.seed)) - 0.5F;
    const float grain = octaves2(at.s, at.t, foot, {1.6F, 7, 0.92F}, f.seed + 2U);
    return f.tone * (1.0F + 0.34F * w * stone + 0.12F * grain) * (1.0F - 0.5F * joint);
}

float brick(const SurfacePoint& at, float tone, std::uint32_t seed) {
    constexpr float kHigh = 0.077F;
    constexpr float kLong = 0.25F;
    const int row = floor_int(at.t / kHigh);
    const float shift = (row & 1) != 0 ? 0.5F * kLong : 0.0F;
    const int column = floor_int((at.s + shift) / kLong);
    const float foot = larger(at.fs, at.ft);
    float joint = cover_periodic(at.t, at.ft, kHigh, 0.0F, 0.013F);
    joint = larger(joint, cover_periodic(at.s + shift, at.fs, kLong, 0.0F, 0.013F));
    const float w = foot > 0.07F ? 0.0F : 1.0F - foot / 0.07F;
    const float one = unit(hash(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), seed)) - 0.5F;
    const float grain = octaves2(at.s, at.t, foot, {1.2F, 6, 0.9F}, seed + 1U);
    return blend(tone * 0.8F * (1.0F + 0.5F * w * one + 0.15F * grain), 0.62F, joint * 0.8F);
}

// Window of 1.1 x 1.35 m with its lower left corner at 0: frame, cross bars, curtains; shutters beside it.
float window(const SurfacePoint& at, float wall, std::uint32_t h) {
    constexpr float kWide = 1.1F;
    constexpr float kHigh = 1.35F;
    const float outer = cover(at.s, at.fs, -0.09F, kWide + 0.09F) * cover(at.t, at.ft, -0.09F, kHigh + 0.09F);
    const float sill = cover(at.s, at.fs, -0.15F, kWide + 0.15F) * cover(at.t, at.ft, -0.2F, -0.09F);
    const float frame = cover(at.s, at.fs, 0.0F, kWide) * cover(at.t, at.ft, 0.0F, kHigh);
    float pane =
        cover(at.s, at.fs, 0.07F, 0.5F * kWide - 0.03F) + cover(at.s, at.fs, 0.5F * kWide + 0.03F, kWide - 0.07F);
    pane *= cover(at.t, at.ft, 0.07F, 0.95F) + cover(at.t, at.ft, 1.0F, kHigh - 0.07F);
    const float foot = larger(at.fs, at.ft);
    float glass = 0.10F + 0.07F * octaves2(at.s, at.t, foot, {0.5F, 4, 0.8F}, h);
    if (h % 3U == 0U) {  // roller shutter, half down
        const float down = 0.3F + 0.6F * unit(mix(h));
        const float slats = 0.55F + 0.25F * cover_periodic(at.t, at.ft, 0.06F, 0.0F, 0.025F);
        glass = blend(glass, slats, cover(at.t, at.ft, kHigh - kHigh * down, kHigh));
    } else if (h % 3U == 1U) {  // curtains
        const float folds = 0.5F + 0.14F * octaves2(at.s, 0.2F * at.t, foot, {0.15F, 3, 0.9F}, h);
        glass = blend(glass, folds, 0.8F * (1.0F - cover(at.s, at.fs, 0.25F, kWide - 0.25F)));
    }
    float r = blend(wall, (h & 8U) != 0U ? 0.16F : 0.66F, outer);
    r = blend(r, 0.45F, sill);
    r = blend(r, (h & 16U) != 0U ? 0.82F : 0.3F, frame);
    r = blend(r, glass, pane);
    if ((h & 96U) == 0U) {  // folding shutters
        const float side = cover(at.s, at.fs, -0.62F, -0.12F) + cover(at.s, at.fs, kWide + 0.12F, kWide + 0.62F);
        const float slats = 0.22F + 0.12F * cover_periodic(at.t, at.ft, 0.08F, 0.0F, 0.03F);
        r = blend(r, slats, side * cover(at.t, at.ft, -0.04F, kHigh + 0.04F));
    }
    return r;
}

float door(const SurfacePoint& at, float wall, std::uint32_t h) {
    const float outer = cover(at.s, at.fs, -0.12F, 1.17F) * cover(at.t, at.ft, 0.0F, 2.3F);
    const float leaf = cover(at.s, at.fs, 0.0F, 1.05F) * cover(at.t, at.ft, 0.0F, 2.15F);
    const float light = cover(at.s, at.fs, 0.2F, 0.85F) * cover(at.t, at.ft, 1.2F, 1.9F);
    const float foot = larger(at.fs, at.ft);
    const float wood = 0.22F + 0.05F * octaves2(at.s * 3.0F, at.t, foot, {0.3F, 4, 0.9F}, h);
    const float handle = cover(at.s, at.fs, 0.92F, 1.0F) * cover(at.t, at.ft, 0.95F, 1.12F);
    return blend(blend(blend(blend(wall, 0.7F, outer), wood, leaf), 0.5F, light), 0.85F, handle);
}

float facade(const Surface& f, const SurfacePoint& at) {
    const float length = f.p[0];
    const float eaves = f.p[1];
    const float spacing = f.p[2];
    const float foot = larger(at.fs, at.ft);
    float wall = 0.0F;
    if (f.p[3] > 0.5F && f.p[3] < 1.5F) {
        wall = brick(at, 0.42F, f.seed);
    } else {
        const float stains = octaves2(at.s, 0.35F * at.t, foot, {3.0F, 3, 0.8F}, f.seed);
        const float grain = octaves2(at.s, at.t, foot, {0.12F, 5, 0.97F}, f.seed + 1U);
        wall = f.tone * (1.0F + 0.07F * stains + 0.085F * grain);
    }
    if (f.p[3] > 1.5F) {
        return window({at.s - 0.35F, at.t - 0.08F, at.fs, at.ft}, wall, f.seed);
    }
    const float plinth = 0.35F + 0.5F * unit(hash(f.seed, 3U));
    const float stone = 0.3F * (1.0F + 0.2F * octaves2(at.s, at.t, foot, {0.3F, 5, 0.9F}, f.seed + 4U));
    wall = blend(wall, stone, cover(at.t, at.ft, -1.0F, plinth));
    const int columns = floor_int((length - 0.8F) / spacing);
    const float margin = 0.5F * (length - static_cast<float>(columns) * spacing);
    const int i = floor_int((at.s - margin) / spacing);
    const int storey = floor_int((at.t - 0.15F) / 2.75F);
    if (i < 0 || i >= columns || storey < 0) {
        return wall;
    }
    const float s = at.s - margin - static_cast<float>(i) * spacing - 0.5F * (spacing - 1.1F);
    const float t = at.t - 0.15F - static_cast<float>(storey) * 2.75F;
    const std::uint32_t h = hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(storey), f.seed);
    const int door_column = static_cast<int>(f.seed % static_cast<std::uint32_t>(columns > 0 ? columns : 1));
    if (storey == 0 && i == door_column) {
        return door({s, at.t - 0.15F, at.fs, at.ft}, wall, h);
    }
    if (static_cast<float>(storey) * 2.75F + 2.6F > eaves) {
        return wall;
    }
    return window({s, t - 0.95F, at.fs, at.ft}, wall, (h & ~0x78U) | (f.seed & 0x78U));
}

float roof(const Surface& f, const SurfacePoint& at) {
    // Seen from the street the slope is a face over (length, height) or (length, depth): tiles 0.3 x 0.3 either way.
    const int row = floor_int(at.t / 0.3F);
    const float shift = (row & 1) != 0 ? 0.15F : 0.0F;
    const int column = floor_int((at.s + shift) / 0.3F);
    const float foot = larger(at.fs, at.ft);
    const float gap = cover_periodic(at.t, at.ft, 0.3F, 0.0F, 0.06F);
    const float w = foot > 0.25F ? 0.0F : 1.0F - foot / 0.25F;
    const float tile = unit(hash(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), f.seed)) - 0.5F;
    const float grain = octaves2(at.s, at.t, foot, {2.0F, 6, 0.9F}, f.seed);
    return f.tone * (1.0F + 0.6F * w * tile + 0.15F * grain) * (1.0F - 0.45F * gap);
}

float leaves(float n, float tone) {
    const float light = 0.5F + 0.75F * n;  // a leaf is lit or it is dark
    return tone * (0.2F + 1.6F * (light < 0.0F ? 0.0F : (light > 1.0F ? 1.0F : light)));
}

float sign(const Surface& f, const SurfacePoint& at) {
    const float t = at.t - 2.3F;
    const float r = std::sqrt(at.s * at.s + t * t);
    const float foot = larger(at.fs, at.ft);
    const float rim = cover(r, foot, 0.22F, 0.4F);
    const float bar = cover(at.s, at.fs, -0.14F, 0.14F) * cover(t, at.ft, -0.04F, 0.04F);
    const float mark = (f.seed & 1U) != 0U ? bar : cover(at.s, at.fs, -0.04F, 0.04F) * cover(t, at.ft, -0.13F, 0.13F);
    return blend(blend(f.tone, 0.25F, rim), 0.08F, mark);
}

// A point of a round surface on the side of a cube around it: noise in the plane costs half of noise in space.
struct CubePoint {
    float s;
    float t;
    std::uint32_t side;
};

CubePoint on_cube(float x, float y, float z) {
    const float ax = x < 0.0F ? -x : x;
    const float ay = y < 0.0F ? -y : y;
    const float az = z < 0.0F ? -z : z;
    if (az >= ax && az >= ay) {
        return {x, y, z < 0.0F ? 11U : 12U};
    }
    if (ay >= ax) {
        return {x, z, y < 0.0F ? 13U : 14U};
    }
    return {y, z, x < 0.0F ? 15U : 16U};
}

float cloth(const Surface& f, const SurfacePoint& at) {
    const float n = octaves2(at.s, at.t, larger(at.fs, at.ft), {0.25F, 5, 0.95F}, f.seed);
    const float stripe = (f.seed & 4U) != 0U ? cover_periodic(at.t, at.ft, 0.16F, 0.0F, 0.05F) : 0.0F;
    return (f.tone * (1.0F + 0.3F * n)) * (1.0F - stripe) + stripe * (f.tone > 0.4F ? 0.15F : 0.6F);
}

}  // namespace

float reflectance(const Surface& surface, const SurfacePoint& at) {
    const float foot = larger(at.fs, at.ft);
    switch (surface.material) {
        case Material::kAsphalt:
            return asphalt(surface, at);
        case Material::kPaving:
            return paving(surface, at);
        case Material::kFacade:
            return facade(surface, at);
        case Material::kRoof:
            return roof(surface, at);
        case Material::kBrick:
            return brick(at, surface.tone, surface.seed);
        case Material::kLeaves:
            return leaves(octaves2(at.s, at.t, foot, {0.22F, 5, 0.97F}, surface.seed), surface.tone);
        case Material::kBark:
            return surface.tone *
                   (1.0F + 0.4F * octaves2(at.s * 3.0F, at.t, 3.0F * foot, {0.3F, 5, 0.9F}, surface.seed));
        case Material::kSign:
            return sign(surface, at);
        case Material::kCloth:
            return cloth(surface, at);
        case Material::kPlain:
        case Material::kSkin:
            return plain(surface, at);
        default:
            return vehicle_reflectance(surface, at);
    }
}

float reflectance(const Surface& surface, float x, float y, float z, float footprint) {
    const CubePoint m = on_cube(x, y, z);
    if (surface.material == Material::kLeaves) {
        return leaves(octaves2(m.s, m.t, footprint, {0.4F, 5, 0.95F}, surface.seed + m.side), surface.tone);
    }
    return surface.tone * (1.0F + 0.35F * octaves2(m.s, m.t, footprint, {0.12F, 3, 0.9F}, surface.seed + m.side));
}

bool leaf_at(const Surface& surface, float x, float y, float z, float footprint, float rim) {
    if (rim < 0.15F) {
        return true;
    }  // the dense middle
    const CubePoint m = on_cube(x, y, z);
    const float n = octaves2(m.s, m.t, 0.5F * footprint, {0.4F, 4, 0.9F}, surface.seed + 91U + m.side);
    return n > 1.9F * rim - 1.0F;
}

float sky(double x, double y, double z, float footprint) {
    const double norm = std::sqrt(x * x + y * y + z * z);
    const float up = static_cast<float>(-y / norm);
    float r = 0.93F - 0.28F * (up < 0.0F ? 0.0F : up);
    if (up > 0.02F) {  // clouds on a plane overhead
        const float k = 1.0F / (up + 0.08F);
        const float cloud = octaves2(static_cast<float>(x / norm) * k, static_cast<float>(z / norm) * k,
                                     footprint * k * k, {0.9F, 5, 0.6F}, 4242U);
        r += 0.06F * cloud;
    }
    return r;
}

}  // namespace semtrack::sil::world
