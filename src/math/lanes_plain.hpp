// Sixteen bytes or eight 16-bit integers at once, in plain C++: the meaning of lanes_sse2.hpp and lanes_neon.hpp, and
// what targets without either run. Integers only: every implementation gives the same bits by definition.
#ifndef SEMTRACK_MATH_LANES_PLAIN_HPP
#define SEMTRACK_MATH_LANES_PLAIN_HPP

#include <array>
#include <cstdint>

namespace semtrack::lanes_plain {

struct U8x16 {
    std::array<std::uint8_t, 16> v{};
};
struct I16x8 {
    std::array<std::int16_t, 8> v{};
};
struct I32x4 {
    std::array<std::int32_t, 4> v{};
};

template <class F>
[[nodiscard]] inline U8x16 each(const U8x16& a, const U8x16& b, F f) {
    U8x16 out;
    for (std::size_t i = 0; i < 16; ++i) {
        out.v[i] = static_cast<std::uint8_t>(f(static_cast<int>(a.v[i]), static_cast<int>(b.v[i])));
    }
    return out;
}
template <class F>
[[nodiscard]] inline I16x8 each(const I16x8& a, const I16x8& b, F f) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = static_cast<std::int16_t>(f(static_cast<int>(a.v[i]), static_cast<int>(b.v[i])));
    }
    return out;
}

[[nodiscard]] inline U8x16 load(const std::uint8_t* p) {
    U8x16 out;
    for (std::size_t i = 0; i < 16; ++i) {
        out.v[i] = p[i];
    }
    return out;
}
/// Eight bytes at `low`, eight at `high`.
[[nodiscard]] inline U8x16 load_halves(const std::uint8_t* low, const std::uint8_t* high) {
    U8x16 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = low[i];
        out.v[i + 8] = high[i];
    }
    return out;
}
inline void store(std::uint8_t* p, const U8x16& a) {
    for (std::size_t i = 0; i < 16; ++i) {
        p[i] = a.v[i];
    }
}
inline void store_low(std::uint8_t* p, const U8x16& a) {
    for (std::size_t i = 0; i < 8; ++i) {
        p[i] = a.v[i];
    }
}
[[nodiscard]] inline U8x16 splat(std::uint8_t x) {
    U8x16 out;
    out.v.fill(x);
    return out;
}
[[nodiscard]] inline U8x16 add_saturated(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x + y > 255 ? 255 : x + y; });
}
[[nodiscard]] inline U8x16 sub_saturated(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x > y ? x - y : 0; });
}
[[nodiscard]] inline U8x16 min(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x < y ? x : y; });
}
[[nodiscard]] inline U8x16 max(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x > y ? x : y; });
}
[[nodiscard]] inline U8x16 bit_and(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x & y; });
}
/// 255 where equal, else 0.
[[nodiscard]] inline U8x16 equal(const U8x16& a, const U8x16& b) {
    return each(a, b, [](int x, int y) { return x == y ? 255 : 0; });
}
/// Bit i: the highest bit of byte i.
[[nodiscard]] inline std::uint32_t sign_bits(const U8x16& a) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        bits |= static_cast<std::uint32_t>(a.v[i] >> 7) << i;
    }
    return bits;
}

/// Sum of absolute differences, 16 bytes at a time, at most 256 times.
struct SadSum {
    std::int32_t sum{0};
    void add(const U8x16& a, const U8x16& b) {
        for (std::size_t i = 0; i < 16; ++i) {
            sum += a.v[i] > b.v[i] ? a.v[i] - b.v[i] : b.v[i] - a.v[i];
        }
    }
    [[nodiscard]] std::int32_t total() const { return sum; }
};

[[nodiscard]] inline I16x8 load16(const std::int16_t* p) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = p[i];
    }
    return out;
}
inline void store16(std::int16_t* p, const I16x8& a) {
    for (std::size_t i = 0; i < 8; ++i) {
        p[i] = a.v[i];
    }
}
[[nodiscard]] inline I16x8 splat16(std::int16_t x) {
    I16x8 out;
    out.v.fill(x);
    return out;
}
/// The first or last eight bytes as integers 0..255.
[[nodiscard]] inline I16x8 widen_low(const U8x16& a) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = static_cast<std::int16_t>(a.v[i]);
    }
    return out;
}
[[nodiscard]] inline I16x8 widen_high(const U8x16& a) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = static_cast<std::int16_t>(a.v[i + 8]);
    }
    return out;
}
/// Bytes 0, 2, 4, ... and 1, 3, 5, ... as integers 0..255.
[[nodiscard]] inline I16x8 widen_even(const U8x16& a) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = static_cast<std::int16_t>(a.v[2 * i]);
    }
    return out;
}
[[nodiscard]] inline I16x8 widen_odd(const U8x16& a) {
    I16x8 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = static_cast<std::int16_t>(a.v[2 * i + 1]);
    }
    return out;
}
/// a then b, clamped to 0..255.
[[nodiscard]] inline U8x16 narrow(const I16x8& a, const I16x8& b) {
    const auto clamped = [](int x) { return static_cast<std::uint8_t>(x < 0 ? 0 : x > 255 ? 255 : x); };
    U8x16 out;
    for (std::size_t i = 0; i < 8; ++i) {
        out.v[i] = clamped(a.v[i]);
        out.v[i + 8] = clamped(b.v[i]);
    }
    return out;
}
// 16-bit arithmetic wraps; callers stay in range.
[[nodiscard]] inline I16x8 add(const I16x8& a, const I16x8& b) {
    return each(a, b, [](int x, int y) { return x + y; });
}
[[nodiscard]] inline I16x8 sub(const I16x8& a, const I16x8& b) {
    return each(a, b, [](int x, int y) { return x - y; });
}
[[nodiscard]] inline I16x8 mul(const I16x8& a, const I16x8& b) {
    return each(a, b, [](int x, int y) { return x * y; });
}
/// The upper half of the signed product: floor(a b / 65536).
[[nodiscard]] inline I16x8 mul_high(const I16x8& a, const I16x8& b) {
    return each(a, b, [](int x, int y) {
        const int p = x * y;
        return p >= 0 ? p / 65536 : -((-p + 65535) / 65536);
    });
}
[[nodiscard]] inline I16x8 bit_and(const I16x8& a, const I16x8& b) {
    return each(a, b, [](int x, int y) { return x & y; });
}
/// To the left by n bits.
template <int n>
[[nodiscard]] inline I16x8 shift_left(const I16x8& a) {
    return each(a, a, [](int x, int) { return x * (1 << n); });
}
/// To the right by n bits; for values that are not negative.
template <int n>
[[nodiscard]] inline I16x8 shift_right(const I16x8& a) {
    return each(a, a, [](int x, int) { return (x & 0xFFFF) >> n; });
}
/// sum += products of a and b: entry i those of the pair 2 i, 2 i + 1.
inline void add_products(I32x4& sum, const I16x8& a, const I16x8& b) {
    for (std::size_t i = 0; i < 8; ++i) {
        sum.v[i / 2] += static_cast<std::int32_t>(a.v[i]) * b.v[i];
    }
}
[[nodiscard]] inline std::int32_t total(const I32x4& a) {
    return a.v[0] + a.v[1] + a.v[2] + a.v[3];
}

[[nodiscard]] inline I32x4 splat32(std::int32_t x) {
    I32x4 out;
    out.v.fill(x);
    return out;
}
[[nodiscard]] inline I32x4 add(const I32x4& a, const I32x4& b) {
    I32x4 out;
    for (std::size_t i = 0; i < 4; ++i) {
        out.v[i] = a.v[i] + b.v[i];
    }
    return out;
}
/// To the right by n bits; for values that are not negative.
template <int n>
[[nodiscard]] inline I32x4 shift_right(const I32x4& a) {
    I32x4 out;
    for (std::size_t i = 0; i < 4; ++i) {
        out.v[i] = a.v[i] >> n;
    }
    return out;
}
/// a to d one after the other; for values of 0..255.
[[nodiscard]] inline U8x16 narrow(const I32x4& a, const I32x4& b, const I32x4& c, const I32x4& d) {
    U8x16 out;
    for (std::size_t i = 0; i < 4; ++i) {
        out.v[i] = static_cast<std::uint8_t>(a.v[i]);
        out.v[i + 4] = static_cast<std::uint8_t>(b.v[i]);
        out.v[i + 8] = static_cast<std::uint8_t>(c.v[i]);
        out.v[i + 12] = static_cast<std::uint8_t>(d.v[i]);
    }
    return out;
}

}  // namespace semtrack::lanes_plain

#endif
