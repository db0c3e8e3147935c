#include "sil/world/material_vehicle.hpp"

#include <cmath>

#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

float larger(float a, float b) {
    return a > b ? a : b;
}

// A painted panel: the surroundings reflected as broad streaks that stick to the panel, dirt, fine speckle.
float paint(const Surface& f, const SurfacePoint& at) {
    const float foot = larger(at.fs, at.ft);
    const float streaks = octaves2(0.5F * at.s, 2.5F * at.t, foot, {0.7F, 3, 0.6F}, f.seed);
    const float dirt = octaves2(at.s, at.t, foot, {0.06F, 4, 0.97F}, f.seed + 1U);
    const float shine = 0.025F + 0.07F * f.tone;
    return f.tone * (1.0F + 0.10F * dirt) + shine * streaks + 0.03F * dirt;
}

float seam(float x, float f, float at) {
    return cover(x, f, at - 0.008F, at + 0.008F);
}

float car_side(const Surface& f, const SurfacePoint& at) {
    float r = paint(f, at);
    const float front = f.p[0];
    const float rear = f.p[1];
    const float radius = f.p[2];
    const float belt = f.p[3];
    const float foot = larger(at.fs, at.ft);
    const float low = cover(at.t, at.ft, 0.0F, 0.22F * belt + 0.1F);
    r = blend(r, 0.06F, 0.8F * low);                                          // sill in shade
    r = blend(r, 0.55F * r, cover(at.t, at.ft, 0.58F * belt, 0.61F * belt));  // side strip
    const float doors = cover(at.t, at.ft, 0.3F * belt, belt + 0.1F);
    const float middle = 0.5F * (front + rear);
    const float lines =
        seam(at.s, at.fs, middle + 0.08F) + seam(at.s, at.fs, front - 0.45F) + seam(at.s, at.fs, rear + 0.42F);
    r = blend(r, 0.03F, 0.9F * (lines > 1.0F ? 1.0F : lines) * doors);
    const float handle =
        cover(at.s, at.fs, middle + 0.16F, middle + 0.36F) + cover(at.s, at.fs, rear + 0.5F, rear + 0.7F);
    r = blend(r, f.tone > 0.4F ? 0.12F : 0.7F, handle * cover(at.t, at.ft, 0.78F * belt, 0.83F * belt));
    for (const float axle : {front, rear}) {  // wheel arches
        const float ds = at.s - axle;
        const float dt = at.t - radius;
        const float d = std::sqrt(ds * ds + dt * dt);
        r = blend(r, 0.02F, cover(d, foot, 0.0F, radius + 0.06F));
        r = blend(r, 0.6F * f.tone + 0.12F, 0.7F * cover(d, foot, radius + 0.06F, radius + 0.085F));
    }
    return r;
}

// Characters as a hashed grid of strokes: 8 columns of 3 x 5 dots.
float plate(const SurfacePoint& at, float z, std::uint32_t seed) {
    const float face = cover(at.s, at.fs, -0.26F, 0.26F) * cover(at.t, at.ft, z - 0.055F, z + 0.055F);
    if (face <= 0.0F) {
        return -1.0F;
    }
    const int i = floor_int((at.s + 0.26F) / 0.0163F);
    const int j = floor_int((at.t - z + 0.055F) / 0.0183F);
    const bool dot = (i % 4) != 3 && j > 0 && j < 5 &&
                     hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), seed) % 2U == 0U;
    const float w = larger(at.fs, at.ft) > 0.03F ? 0.45F : 1.0F;
    return (dot ? 0.85F - 0.75F * w : 0.85F) * face;
}

float car_end(const Surface& f, const SurfacePoint& at, bool is_front) {
    float r = paint(f, at);
    const float half = 0.5F * f.p[0];
    const float belt = f.p[1];
    const float y = at.s < 0.0F ? -at.s : at.s;
    const float foot = larger(at.fs, at.ft);
    r = blend(r, 0.05F, 0.85F * cover(at.t, at.ft, 0.0F, 0.33F * belt));  // lower lip
    r = blend(r, 0.4F * r, cover(at.t, at.ft, 0.52F * belt, 0.545F * belt));
    const float lamp = cover(y, at.fs, half - (is_front ? 0.42F : 0.28F), half - 0.04F) *
                       cover(at.t, at.ft, (is_front ? 0.62F : 0.66F) * belt, (is_front ? 0.84F : 0.98F) * belt);
    if (is_front) {
        const float grille = cover(y, at.fs, -1.0F, half - 0.46F) * cover(at.t, at.ft, 0.60F * belt, 0.80F * belt);
        const float bars = cover_periodic(at.t, at.ft, 0.05F, 0.0F, 0.02F);
        r = blend(r, 0.05F + 0.35F * bars, grille);
        const float intake = cover(y, at.fs, -1.0F, half - 0.35F) * cover(at.t, at.ft, 0.36F * belt, 0.46F * belt);
        r = blend(r, 0.03F, intake);
        const float glass = 0.75F + 0.25F * octaves2(at.s, at.t, foot, {0.12F, 3, 0.9F}, f.seed + 4U);
        r = blend(r, glass, lamp);
    } else {
        const float glass = 0.22F + 0.2F * cover_periodic(at.t, at.ft, 0.12F, 0.0F, 0.04F);
        r = blend(r, glass, lamp);
        r = blend(r, 0.03F, seam(at.t, at.ft, 0.6F * belt) * cover(y, at.fs, 0.0F, half - 0.2F));
    }
    const float number = plate(at, is_front ? 0.52F * belt : 0.78F * belt, f.seed);
    if (number >= 0.0F) {
        r = number > 0.1F ? number : 0.1F;
    }
    return r;
}

float car_top(const Surface& f, const SurfacePoint& at) {
    float r = paint(f, at) + 0.10F;
    const float y = at.t < 0.0F ? -at.t : at.t;
    r = blend(r, 0.05F, seam(y, at.ft, 0.5F * f.p[1] - 0.13F));
    return r;
}

// Side windows: three panes between pillars, in the trapezoid of the cabin.
float glass_side(const Surface& f, const SurfacePoint& at) {
    const float belt = f.p[0];
    const float top = f.p[1];
    const float length = f.p[2];
    const float foot = larger(at.fs, at.ft);
    const float frame = paint(f, at);
    const float up = (at.t - belt) / (top - belt);
    const float lean = 0.17F * length * up;  // the panes' ends follow the screens
    const float from = -0.40F * length + 0.5F * lean;
    const float to = 0.20F * length - lean;
    float pane = cover(at.s, at.fs, from, -0.17F * length) + cover(at.s, at.fs, -0.15F * length, 0.035F * length) +
                 cover(at.s, at.fs, 0.055F * length, to);
    pane *= cover(at.t, at.ft, belt + 0.03F, top - 0.1F);
    float glass = 0.07F + 0.16F * up * unit(hash(f.seed, 2U));
    glass += 0.035F * octaves2(at.s + 0.4F * at.t, at.t, foot, {0.5F, 6, 0.9F}, f.seed + 3U);
    return blend(frame, glass, pane > 1.0F ? 1.0F : pane);
}

float glass_end(const Surface& f, const SurfacePoint& at) {
    const float belt = f.p[0];
    const float top = f.p[1];
    const float half = 0.5F * f.p[3];
    const float foot = larger(at.fs, at.ft);
    const float frame = paint(f, at);
    const float y = at.s < 0.0F ? -at.s : at.s;
    const float up = (at.t - belt) / (top - belt);
    const float edge = half - 0.13F - 0.14F * up;
    const float pane = cover(y, at.fs, -1.0F, edge) * cover(at.t, at.ft, belt + 0.02F, top - 0.05F);
    float glass = 0.09F + 0.22F * up * up;
    glass += 0.035F * octaves2(at.s, at.t, foot, {0.5F, 6, 0.9F}, f.seed + 5U);
    // Head rests and the mirror through the glass.
    const float seats = cover(y, at.fs, 0.22F, 0.5F) * cover(at.t, at.ft, belt, belt + 0.55F * (top - belt));
    glass = blend(glass, 0.03F, 0.7F * seats);
    glass = blend(glass, 0.3F, cover(y, at.fs, -1.0F, 0.1F) * cover(at.t, at.ft, top - 0.17F, top - 0.11F));
    return blend(frame, glass, pane);
}

float wheel(const Surface& f, const SurfacePoint& at) {
    const float s = at.s - f.p[0];
    const float t = at.t - f.p[1];
    const float radius = f.p[2];
    const float foot = larger(at.fs, at.ft);
    const float d = std::sqrt(s * s + t * t);
    if (f.p[3] > 0.5F) {  // bicycle: rim, hub and spokes as a see-through grey
        const float rim = cover(d, foot, 0.86F * radius, 0.93F * radius);
        const float hub = cover(d, foot, 0.0F, 0.12F * radius);
        const float gap = 0.30F + 0.12F * octaves2(s, t, foot, {0.1F, 3, 0.9F}, f.seed);
        return blend(blend(blend(gap, 0.05F, cover(d, foot, 0.93F * radius, 2.0F)), 0.7F, rim), 0.1F, hub);
    }
    const float rim = cover(d, foot, 0.0F, 0.66F * radius);
    const bool spoke = (s * t > 0.0F) != (s * s > t * t);
    const float hub = cover(d, foot, 0.0F, 0.14F * radius);
    const float edge = cover(d, foot, 0.58F * radius, 0.66F * radius);
    float alloy = spoke ? 0.62F : 0.2F;
    alloy = blend(blend(alloy, 0.7F, edge), 0.15F, hub);
    const float tyre = 0.05F + 0.02F * octaves2(s, t, foot, {0.1F, 4, 0.9F}, f.seed);
    return blend(tyre, alloy, rim);
}

float cargo(const Surface& f, const SurfacePoint& at) {
    const float foot = larger(at.fs, at.ft);
    float r = f.tone * (1.0F + 0.10F * octaves2(at.s, at.t, foot, {1.5F, 8, 0.92F}, f.seed));
    r = blend(r, 0.5F * f.tone, cover_periodic(at.s, at.fs, 0.9F, 0.0F, 0.03F));
    // Lettering: hashed blocks in the middle of the height.
    const float z = at.t / f.p[1];
    if (z > 0.55F && z < 0.8F) {
        const int i = floor_int(at.s / 0.11F);
        const int j = floor_int((at.t - 0.55F * f.p[1]) / 0.16F);
        const bool dot = hash(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), f.seed) % 5U < 2U;
        const float in = cover_periodic(at.s, at.fs, 0.11F, 0.0F, 0.1F);
        if (dot) {
            r = blend(r, 0.12F, in);
        }
    }
    r = blend(r, 0.1F, cover(z, at.ft / f.p[1], 0.28F, 0.335F));
    return r;
}

}  // namespace

float vehicle_reflectance(const Surface& surface, const SurfacePoint& at) {
    switch (surface.material) {
        case Material::kCarSide:
            return car_side(surface, at);
        case Material::kCarFront:
            return car_end(surface, at, true);
        case Material::kCarRear:
            return car_end(surface, at, false);
        case Material::kCarTop:
            return car_top(surface, at);
        case Material::kGlassSide:
            return glass_side(surface, at);
        case Material::kGlassEnd:
            return glass_end(surface, at);
        case Material::kWheel:
            return wheel(surface, at);
        case Material::kCargo:
            return cargo(surface, at);
        default:
            return surface.tone;
    }
}

}  // namespace semtrack::sil::world
