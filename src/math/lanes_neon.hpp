// lanes_plain.hpp on ARM with NEON (all AArch64; ARMv7 when the compiler is told so). Integers only: NEON's
// flush-to-zero of ARMv7 never matters.
// MISRA deviation D-04: intrinsics.
#ifndef SEMTRACK_MATH_LANES_NEON_HPP
#define SEMTRACK_MATH_LANES_NEON_HPP

#include <arm_neon.h>

#include <cstdint>

namespace semtrack::lanes_neon {

struct U8x16 {
    uint8x16_t v;
};
struct I16x8 {
    int16x8_t v;
};
struct I32x4 {
    int32x4_t v = vdupq_n_s32(0);
};

[[nodiscard]] inline U8x16 load(const std::uint8_t* p) {
    return {vld1q_u8(p)};
}
[[nodiscard]] inline U8x16 load_halves(const std::uint8_t* low, const std::uint8_t* high) {
    return {vcombine_u8(vld1_u8(low), vld1_u8(high))};
}
inline void store(std::uint8_t* p, const U8x16& a) {
    vst1q_u8(p, a.v);
}
inline void store_low(std::uint8_t* p, const U8x16& a) {
    vst1_u8(p, vget_low_u8(a.v));
}
[[nodiscard]] inline U8x16 splat(std::uint8_t x) {
    return {vdupq_n_u8(x)};
}
[[nodiscard]] inline U8x16 add_saturated(const U8x16& a, const U8x16& b) {
    return {vqaddq_u8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 sub_saturated(const U8x16& a, const U8x16& b) {
    return {vqsubq_u8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 min(const U8x16& a, const U8x16& b) {
    return {vminq_u8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 max(const U8x16& a, const U8x16& b) {
    return {vmaxq_u8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 bit_and(const U8x16& a, const U8x16& b) {
    return {vandq_u8(a.v, b.v)};
}
[[nodiscard]] inline U8x16 equal(const U8x16& a, const U8x16& b) {
    return {vceqq_u8(a.v, b.v)};
}
[[nodiscard]] inline std::uint32_t sign_bits(const U8x16& a) {
    static const std::uint8_t kWeights[16] = {1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
    const uint8x16_t sign = vreinterpretq_u8_s8(vshrq_n_s8(vreinterpretq_s8_u8(a.v), 7));
    const uint64x2_t sums = vpaddlq_u32(vpaddlq_u16(vpaddlq_u8(vandq_u8(sign, vld1q_u8(kWeights)))));
    return static_cast<std::uint32_t>(vgetq_lane_u64(sums, 0)) |
           (static_cast<std::uint32_t>(vgetq_lane_u64(sums, 1)) << 8U);
}

struct SadSum {
    uint32x4_t sum = vdupq_n_u32(0);
    void add(const U8x16& a, const U8x16& b) { sum = vpadalq_u16(sum, vpaddlq_u8(vabdq_u8(a.v, b.v))); }
    [[nodiscard]] std::int32_t total() const {
        const uint64x2_t pairs = vpaddlq_u32(sum);
        return static_cast<std::int32_t>(vgetq_lane_u64(pairs, 0) + vgetq_lane_u64(pairs, 1));
    }
};

[[nodiscard]] inline I16x8 load16(const std::int16_t* p) {
    return {vld1q_s16(p)};
}
inline void store16(std::int16_t* p, const I16x8& a) {
    vst1q_s16(p, a.v);
}
[[nodiscard]] inline I16x8 splat16(std::int16_t x) {
    return {vdupq_n_s16(x)};
}
[[nodiscard]] inline I16x8 widen_low(const U8x16& a) {
    return {vreinterpretq_s16_u16(vmovl_u8(vget_low_u8(a.v)))};
}
[[nodiscard]] inline I16x8 widen_high(const U8x16& a) {
    return {vreinterpretq_s16_u16(vmovl_u8(vget_high_u8(a.v)))};
}
[[nodiscard]] inline I16x8 widen_even(const U8x16& a) {
    return {vreinterpretq_s16_u16(vandq_u16(vreinterpretq_u16_u8(a.v), vdupq_n_u16(0xFF)))};
}
[[nodiscard]] inline I16x8 widen_odd(const U8x16& a) {
    return {vreinterpretq_s16_u16(vshrq_n_u16(vreinterpretq_u16_u8(a.v), 8))};
}
[[nodiscard]] inline U8x16 narrow(const I16x8& a, const I16x8& b) {
    return {vcombine_u8(vqmovun_s16(a.v), vqmovun_s16(b.v))};
}
[[nodiscard]] inline I16x8 add(const I16x8& a, const I16x8& b) {
    return {vaddq_s16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 sub(const I16x8& a, const I16x8& b) {
    return {vsubq_s16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 mul(const I16x8& a, const I16x8& b) {
    return {vmulq_s16(a.v, b.v)};
}
[[nodiscard]] inline I16x8 mul_high(const I16x8& a, const I16x8& b) {
    return {vcombine_s16(vshrn_n_s32(vmull_s16(vget_low_s16(a.v), vget_low_s16(b.v)), 16),
                         vshrn_n_s32(vmull_s16(vget_high_s16(a.v), vget_high_s16(b.v)), 16))};
}
[[nodiscard]] inline I16x8 bit_and(const I16x8& a, const I16x8& b) {
    return {vandq_s16(a.v, b.v)};
}
template <int n>
[[nodiscard]] inline I16x8 shift_left(const I16x8& a) {
    return {vshlq_n_s16(a.v, n)};
}
template <int n>
[[nodiscard]] inline I16x8 shift_right(const I16x8& a) {
    return {vreinterpretq_s16_u16(vshrq_n_u16(vreinterpretq_u16_s16(a.v), n))};
}
inline void add_products(I32x4& sum, const I16x8& a, const I16x8& b) {
    const int32x4_t low = vmull_s16(vget_low_s16(a.v), vget_low_s16(b.v));
    const int32x4_t high = vmull_s16(vget_high_s16(a.v), vget_high_s16(b.v));
    sum.v = vaddq_s32(sum.v, vcombine_s32(vpadd_s32(vget_low_s32(low), vget_high_s32(low)),
                                          vpadd_s32(vget_low_s32(high), vget_high_s32(high))));
}
[[nodiscard]] inline std::int32_t total(const I32x4& a) {
    const int32x2_t pairs = vadd_s32(vget_low_s32(a.v), vget_high_s32(a.v));
    return vget_lane_s32(pairs, 0) + vget_lane_s32(pairs, 1);
}

[[nodiscard]] inline I32x4 splat32(std::int32_t x) {
    return {vdupq_n_s32(x)};
}
[[nodiscard]] inline I32x4 add(const I32x4& a, const I32x4& b) {
    return {vaddq_s32(a.v, b.v)};
}
template <int n>
[[nodiscard]] inline I32x4 shift_right(const I32x4& a) {
    return {vshrq_n_s32(a.v, n)};
}
[[nodiscard]] inline U8x16 narrow(const I32x4& a, const I32x4& b, const I32x4& c, const I32x4& d) {
    const int16x8_t low = vcombine_s16(vmovn_s32(a.v), vmovn_s32(b.v));
    const int16x8_t high = vcombine_s16(vmovn_s32(c.v), vmovn_s32(d.v));
    return {vcombine_u8(vqmovun_s16(low), vqmovun_s16(high))};
}

}  // namespace semtrack::lanes_neon

#endif
