#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

constexpr std::uint32_t kX = 0x9e3779b1U;
constexpr std::uint32_t kY = 0x85ebca77U;

// Shorter than mix(): a lattice value needs no more, and this is the renderer's innermost loop.
float lattice(std::uint32_t h) {
    h *= 0x2c1b3c6dU;
    h ^= h >> 15U;
    h *= 0x297a2d39U;
    return unit(h);
}

float smooth(float x) {
    return x * x * (3.0F - 2.0F * x);
}

}  // namespace

float noise2(float s, float t, std::uint32_t seed) {
    const int i = floor_int(s);
    const int j = floor_int(t);
    const float a = smooth(s - static_cast<float>(i));
    const float b = smooth(t - static_cast<float>(j));
    const std::uint32_t h = static_cast<std::uint32_t>(i) * kX + seed;
    const std::uint32_t k = static_cast<std::uint32_t>(j) * kY;
    const float n00 = lattice(h ^ k);
    const float n10 = lattice((h + kX) ^ k);
    const float n01 = lattice(h ^ (k + kY));
    const float n11 = lattice((h + kX) ^ (k + kY));
    return blend(blend(n00, n10, a), blend(n01, n11, a), b);
}

float octaves2(float s, float t, float footprint, const Octaves& o, std::uint32_t seed) {
    float sum = 0.0F;
    float amplitude = 1.0F;
    // An octave's weight is 0 where its cells are below 0.7 footprints and 1 from 1.5 footprints on.
    float weight = o.cell / (0.8F * footprint + 1e-9F);
    float inverse = 1.0F / o.cell;
    for (int k = 0; k < o.count && weight > 0.875F; ++k) {
        const float w = weight < 1.875F ? weight - 0.875F : 1.0F;
        const float n = noise2(s * inverse, t * inverse, seed + static_cast<std::uint32_t>(k) * 0x51ed270bU);
        sum += amplitude * w * (2.0F * n - 1.0F);
        amplitude *= o.gain;
        weight *= 0.5F;
        inverse *= 2.0F;
    }
    return sum;
}

float cover_periodic(float x, float f, float period, float a, float b) {
    if (f >= period) {
        return (b - a) / period;
    }
    const float x0 = x - period * static_cast<float>(floor_int(x / period));
    return cover(x0, f, a, b) + cover(x0, f, a - period, b - period) + cover(x0, f, a + period, b + period);
}

}  // namespace semtrack::sil::world
