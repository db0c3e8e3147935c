#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

// Where the machine has them: integer products of four lanes take one instruction, not six. The same bits: integers,
// and floats whose operations are written one by one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SEMTRACK_WIDER __attribute__((target_clones("sse4.1", "default")))
#else
#define SEMTRACK_WIDER
#endif

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

// Four octaves at a time in the compiler's own vectors (g++ and clang++): the same operations on the same values as
// noise2, so the same bits; a compiler without vector registers splits them.
constexpr int kLanes = 4;
using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));
using Words = std::uint32_t __attribute__((vector_size(16)));

__attribute__((always_inline)) inline Floats lattices(Words h) {
    h *= 0x2c1b3c6dU;
    h ^= h >> 15U;
    h *= 0x297a2d39U;
    return __builtin_convertvector(reinterpret_cast<Ints>(h >> 8U), Floats) * (1.0F / 16777216.0F);
}

__attribute__((always_inline)) inline Ints floor_ints(Floats x) {
    const Ints i = __builtin_convertvector(x, Ints);
    return i + (x < __builtin_convertvector(i, Floats));  // true is -1
}

__attribute__((always_inline)) inline Floats smooth(Floats x) {
    return x * x * (3.0F - 2.0F * x);
}

__attribute__((always_inline)) inline Floats noises(Floats s, Floats t, Words seed) {
    const Ints i = floor_ints(s);
    const Ints j = floor_ints(t);
    const Floats a = smooth(s - __builtin_convertvector(i, Floats));
    const Floats b = smooth(t - __builtin_convertvector(j, Floats));
    const Words h = reinterpret_cast<Words>(i) * kX + seed;
    const Words k = reinterpret_cast<Words>(j) * kY;
    const Floats n00 = lattices(h ^ k);
    const Floats n10 = lattices((h + kX) ^ k);
    const Floats n01 = lattices(h ^ (k + kY));
    const Floats n11 = lattices((h + kX) ^ (k + kY));
    const Floats low = n00 + (n10 - n00) * a;
    const Floats high = n01 + (n11 - n01) * a;
    return low + (high - low) * b;
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

SEMTRACK_WIDER float octaves2(float s, float t, float footprint, const Octaves& o, std::uint32_t seed) {
    float sum = 0.0F;
    float amplitude = 1.0F;
    // An octave's weight is 0 where its cells are below 0.7 footprints and 1 from 1.5 footprints on.
    float weight = o.cell / (0.8F * footprint + 1e-9F);
    float inverse = 1.0F / o.cell;
    constexpr std::uint32_t kNext = 0x51ed270bU;
    for (int first = 0; first < o.count && weight > 0.875F; first += kLanes) {
        const Floats scale{inverse, 2.0F * inverse, 4.0F * inverse, 8.0F * inverse};
        const Floats n = noises(s * scale, t * scale, Words{seed, seed + kNext, seed + 2U * kNext, seed + 3U * kNext});
        for (int k = 0; k < kLanes && first + k < o.count && weight > 0.875F; ++k) {
            const float w = weight < 1.875F ? weight - 0.875F : 1.0F;
            sum += amplitude * w * (2.0F * n[k] - 1.0F);
            amplitude *= o.gain;
            weight *= 0.5F;
        }
        inverse *= 16.0F;
        seed += static_cast<std::uint32_t>(kLanes) * kNext;
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
