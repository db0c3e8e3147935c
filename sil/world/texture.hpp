// Procedural texture: value noise over several octaves, hashed by integers, and box-filtered step functions.
// Only + - * / and integers, single precision: the same grey levels on every target.
#ifndef SEMTRACK_SIL_WORLD_TEXTURE_HPP
#define SEMTRACK_SIL_WORLD_TEXTURE_HPP

#include <cstdint>

namespace semtrack::sil::world {

/// Mixes 32 bits; every output bit depends on every input bit.
[[nodiscard]] inline std::uint32_t mix(std::uint32_t h) {
    h ^= h >> 16U;
    h *= 0x7feb352dU;
    h ^= h >> 15U;
    h *= 0x846ca68bU;
    h ^= h >> 16U;
    return h;
}
[[nodiscard]] inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return mix(a * 0x9e3779b1U + mix(b));
}
[[nodiscard]] inline std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return hash(hash(a, b), c);
}
/// [0, 1), 24 bits.
[[nodiscard]] inline float unit(std::uint32_t h) {
    return static_cast<float>(h >> 8U) * (1.0F / 16777216.0F);
}

/// Largest integer not above x, |x| < 2^30.
[[nodiscard]] inline int floor_int(float x) {
    const int i = static_cast<int>(x);
    return i - (x < static_cast<float>(i) ? 1 : 0);
}

/// Lattice values in [0, 1), smoothly interpolated; one lattice cell per unit.
[[nodiscard]] float noise2(float s, float t, std::uint32_t seed);

/// Octaves of noise2 with mean 0: cell sizes `cell`, `cell` / 2, ... (m), amplitudes 1, gain, gain^2, ...
/// Octaves finer than the sample's footprint (m) fade out, so that nothing aliases.
struct Octaves {
    float cell;
    int count;
    float gain;
};
[[nodiscard]] float octaves2(float s, float t, float footprint, const Octaves& o, std::uint32_t seed);

/// Share of the interval of width f around x that lies in [a, b]: a filtered stripe.
[[nodiscard]] inline float cover(float x, float f, float a, float b) {
    const float h = 0.5F * (f < 1e-4F ? 1e-4F : f);
    const float lo = x - h > a ? x - h : a;
    const float hi = x + h < b ? x + h : b;
    return hi > lo ? (hi - lo) / (2.0F * h) : 0.0F;
}
/// The same for a stripe [a, b] that repeats every `period`; 0 <= a < b <= period.
[[nodiscard]] float cover_periodic(float x, float f, float period, float a, float b);
[[nodiscard]] inline float blend(float a, float b, float share) {
    return a + (b - a) * share;
}

}  // namespace semtrack::sil::world

#endif
