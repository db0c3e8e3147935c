// lanes_plain.hpp on x86-64: every function is one to four instructions of SSE2, which each such processor has.
// MISRA deviation D-04: intrinsics.
#ifndef SEMTRACK_MATH_LANES_SSE2_HPP
#define SEMTRACK_MATH_LANES_SSE2_HPP

#include <emmintrin.h>

#include <cstdint>

namespace semtrack::lanes_sse2 {

struct U8x16 {
    __m128i v;
};
struct I16x8 {
    __m128i v;
};
struct I32x4 {
    __m128i v = _mm_setzero_si128();
};

[[nodiscard]] inline U8x16 load(const std::uint8_t* p) {
    return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))};
}
[[nodiscard]] inline U8x16 load_halves(const std::uint8_t* low, const std::uint8_t* high) {
    return {_mm_unpacklo_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(low)),
                               _mm_loadl_epi64(reinterpret_cast<const __m128i*>(high)))};
}
inline void store(std::uint8_t* p, const U8x16& a) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v);
}
inline void store_low(std::uint8_t* p, const U8x16& a) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(p), a.v);
}
[[nodiscard]] inline U8x16 splat(std::uint8_t x) {
    return {_mm_set1_epi8(static_cast<char>(x))};
}
[[nodiscard]] inline U8x16 add_saturated(const U8x16& a, const U8x16& b) {
    return {_mm_adds_epu8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 sub_saturated(const U8x16& a, const U8x16& b) {
    return {_mm_subs_epu8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 min(const U8x16& a, const U8x16& b) {
    return {_mm_min_epu8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 max(const U8x16& a, const U8x16& b) {
    return {_mm_max_epu8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 bit_and(const U8x16& a, const U8x16& b) {
    return {_mm_and_si128(a.v, b.v)};
}
[[nodiscard]] inline U8x16 equal(const U8x16& a, const U8x16& b) {
    return {_mm_cmpeq_epi8(a.v, b.v)};
}
[[nodiscard]] inline std::uint32_t sign_bits(const U8x16& a) {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(a.v));
}

struct SadSum {
    __m128i sum = _mm_setzero_si128();
    void add(const U8x16& a, const U8x16& b) { sum = _mm_add_epi32(sum, _mm_sad_epu8(a.v, b.v)); }
    [[nodiscard]] std::int32_t total() const {
        return _mm_cvtsi128_si32(_mm_add_epi32(sum, _mm_unpackhi_epi64(sum, sum)));
    }
};

[[nodiscard]] inline I16x8 load16(const std::int16_t* p) {
    return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))};
}
inline void store16(std::int16_t* p, const I16x8& a) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v);
}
[[nodiscard]] inline I16x8 splat16(std::int16_t x) {
    return {_mm_set1_epi16(x)};
}
[[nodiscard]] inline I16x8 widen_low(const U8x16& a) {
    return {_mm_unpacklo_epi8(a.v, _mm_setzero_si128())};
}
[[nodiscard]] inline I16x8 widen_high(const U8x16& a) {
    return {_mm_unpackhi_epi8(a.v, _mm_setzero_si128())};
}
[[nodiscard]] inline I16x8 widen_even(const U8x16& a) {
    return {_mm_and_si128(a.v, _mm_set1_epi16(0xFF))};
}
[[nodiscard]] inline I16x8 widen_odd(const U8x16& a) {
    return {_mm_srli_epi16(a.v, 8)};
}
[[nodiscard]] inline U8x16 narrow(const I16x8& a, const I16x8& b) {
    return {_mm_packus_epi16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 add(const I16x8& a, const I16x8& b) {
    return {_mm_add_epi16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 sub(const I16x8& a, const I16x8& b) {
    return {_mm_sub_epi16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 mul(const I16x8& a, const I16x8& b) {
    return {_mm_mullo_epi16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 mul_high(const I16x8& a, const I16x8& b) {
    return {_mm_mulhi_epi16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 bit_and(const I16x8& a, const I16x8& b) {
    return {_mm_and_si128(a.v, b.v)};
}
template <int n>
[[nodiscard]] inline I16x8 shift_left(const I16x8& a) {
    return {_mm_slli_epi16(a.v, n)};
}
template <int n>
[[nodiscard]] inline I16x8 shift_right(const I16x8& a) {
    return {_mm_srli_epi16(a.v, n)};
}
inline void add_products(I32x4& sum, const I16x8& a, const I16x8& b) {
    sum.v = _mm_add_epi32(sum.v, _mm_madd_epi16(a.v, b.v));
}
[[nodiscard]] inline std::int32_t total(const I32x4& a) {
    const __m128i pairs = _mm_add_epi32(a.v, _mm_unpackhi_epi64(a.v, a.v));
    return _mm_cvtsi128_si32(_mm_add_epi32(pairs, _mm_shuffle_epi32(pairs, 1)));
}

[[nodiscard]] inline I32x4 splat32(std::int32_t x) {
    return {_mm_set1_epi32(x)};
}
[[nodiscard]] inline I32x4 add(const I32x4& a, const I32x4& b) {
    return {_mm_add_epi32(a.v, b.v)};
}
template <int n>
[[nodiscard]] inline I32x4 shift_right(const I32x4& a) {
    return {_mm_srli_epi32(a.v, n)};
}
[[nodiscard]] inline U8x16 narrow(const I32x4& a, const I32x4& b, const I32x4& c, const I32x4& d) {
    return {_mm_packus_epi16(_mm_packs_epi32(a.v, b.v), _mm_packs_epi32(c.v, d.v))};
}

}  // namespace semtrack::lanes_sse2

#endif
