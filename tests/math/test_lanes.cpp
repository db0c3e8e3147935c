// The target's integer lanes against their definition.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "math/lanes.hpp"
#include "math/lanes_plain.hpp"
#include "math/rng.hpp"

namespace semtrack {
namespace {

constexpr int kRounds = 2000;

using Bytes = std::array<std::uint8_t, 16>;
using Shorts = std::array<std::int16_t, 8>;

class Lanes : public ::testing::Test {
protected:
    Rng rng_{20};
    Bytes a_{};
    Bytes b_{};
    Shorts p_{};
    Shorts q_{};

    /// Random values with every extreme among them.
    void draw() {
        for (std::size_t i = 0; i < 16; ++i) {
            a_[i] = byte();
            b_[i] = rng_.below(4) == 0 ? a_[i] : byte();
        }
        for (std::size_t i = 0; i < 8; ++i) {
            p_[i] = static_cast<std::int16_t>(rng_.below(65536) - 32768);
            q_[i] = static_cast<std::int16_t>(rng_.below(65536) - 32768);
        }
    }
    std::uint8_t byte() {
        const int r = rng_.below(320);
        return static_cast<std::uint8_t>(r < 256 ? r : r < 288 ? 0 : 255);
    }
};

Bytes bytes(const lanes::U8x16& x) {
    Bytes out{};
    lanes::store(out.data(), x);
    return out;
}
Shorts shorts(const lanes::I16x8& x) {
    Shorts out{};
    lanes::store16(out.data(), x);
    return out;
}

TEST_F(Lanes, BytesAreAddedComparedAndCutAsDefined) {
    for (int round = 0; round < kRounds; ++round) {
        draw();
        const auto x = lanes::load(a_.data());
        const auto y = lanes::load(b_.data());
        const auto px = lanes_plain::load(a_.data());
        const auto py = lanes_plain::load(b_.data());
        EXPECT_EQ(bytes(x), a_);
        EXPECT_EQ(bytes(lanes::add_saturated(x, y)), lanes_plain::add_saturated(px, py).v);
        EXPECT_EQ(bytes(lanes::sub_saturated(x, y)), lanes_plain::sub_saturated(px, py).v);
        EXPECT_EQ(bytes(lanes::min(x, y)), lanes_plain::min(px, py).v);
        EXPECT_EQ(bytes(lanes::max(x, y)), lanes_plain::max(px, py).v);
        EXPECT_EQ(bytes(lanes::bit_and(x, y)), lanes_plain::bit_and(px, py).v);
        EXPECT_EQ(bytes(lanes::equal(x, y)), lanes_plain::equal(px, py).v);
        EXPECT_EQ(lanes::sign_bits(x), lanes_plain::sign_bits(px));
        EXPECT_EQ(bytes(lanes::load_halves(a_.data() + 8, b_.data())),
                  lanes_plain::load_halves(a_.data() + 8, b_.data()).v);
        Bytes half{};
        lanes::store_low(half.data(), x);
        EXPECT_EQ(half[7], a_[7]);
        EXPECT_EQ(half[8], 0);
    }
    EXPECT_EQ(bytes(lanes::splat(77)), lanes_plain::splat(77).v);
}

TEST_F(Lanes, DifferencesOfSixteenRowsAddUpWithoutOverflow) {
    lanes::SadSum sum;
    lanes_plain::SadSum plain;
    for (int round = 0; round < 256; ++round) {
        draw();
        sum.add(lanes::load(a_.data()), lanes::load(b_.data()));
        plain.add(lanes_plain::load(a_.data()), lanes_plain::load(b_.data()));
    }
    EXPECT_EQ(sum.total(), plain.total());
    lanes::SadSum largest;
    for (int round = 0; round < 256; ++round) {
        largest.add(lanes::splat(0), lanes::splat(255));
    }
    EXPECT_EQ(largest.total(), 256 * 16 * 255);
}

TEST_F(Lanes, SixteenBitArithmeticIsAsDefined) {
    for (int round = 0; round < kRounds; ++round) {
        draw();
        const auto x = lanes::load16(p_.data());
        const auto y = lanes::load16(q_.data());
        const auto px = lanes_plain::load16(p_.data());
        const auto py = lanes_plain::load16(q_.data());
        EXPECT_EQ(shorts(lanes::add(x, y)), lanes_plain::add(px, py).v);
        EXPECT_EQ(shorts(lanes::sub(x, y)), lanes_plain::sub(px, py).v);
        EXPECT_EQ(shorts(lanes::mul(x, y)), lanes_plain::mul(px, py).v);
        EXPECT_EQ(shorts(lanes::mul_high(x, y)), lanes_plain::mul_high(px, py).v);
        EXPECT_EQ(shorts(lanes::bit_and(x, y)), lanes_plain::bit_and(px, py).v);
        EXPECT_EQ(shorts(lanes::shift_left<7>(x)), lanes_plain::shift_left<7>(px).v);
        EXPECT_EQ(shorts(lanes::shift_right<2>(x)), lanes_plain::shift_right<2>(px).v);
        EXPECT_EQ(bytes(lanes::narrow(x, y)), lanes_plain::narrow(px, py).v);
        lanes::I32x4 sum;
        lanes_plain::I32x4 plain;
        const auto small = lanes::shift_right<3>(x);  // sums of products stay within 32 bits
        const auto plain_small = lanes_plain::shift_right<3>(px);
        lanes::add_products(sum, small, small);
        lanes::add_products(sum, y, small);
        lanes_plain::add_products(plain, plain_small, plain_small);
        lanes_plain::add_products(plain, py, plain_small);
        EXPECT_EQ(lanes::total(sum), lanes_plain::total(plain));
        lanes::I32x4 quarter;
        lanes_plain::I32x4 plain_quarter;
        lanes::add_products(quarter, small, lanes::splat16(1));
        lanes_plain::add_products(plain_quarter, plain_small, lanes_plain::splat16(1));
        const auto byte_of = lanes::shift_right<6>(lanes::add(quarter, lanes::splat32(3)));
        const auto plain_byte = lanes_plain::shift_right<6>(lanes_plain::add(plain_quarter, lanes_plain::splat32(3)));
        const auto twice = lanes::shift_right<1>(byte_of);
        const auto plain_twice = lanes_plain::shift_right<1>(plain_byte);
        EXPECT_EQ(bytes(lanes::narrow(byte_of, twice, lanes::splat32(0), lanes::splat32(255))),
                  lanes_plain::narrow(plain_byte, plain_twice, lanes_plain::splat32(0), lanes_plain::splat32(255)).v);
    }
    EXPECT_EQ(shorts(lanes::splat16(-5)), lanes_plain::splat16(-5).v);
}

TEST_F(Lanes, BytesBecomeIntegersInOrder) {
    draw();
    const auto x = lanes::load(a_.data());
    const auto px = lanes_plain::load(a_.data());
    EXPECT_EQ(shorts(lanes::widen_low(x)), lanes_plain::widen_low(px).v);
    EXPECT_EQ(shorts(lanes::widen_high(x)), lanes_plain::widen_high(px).v);
    EXPECT_EQ(shorts(lanes::widen_even(x)), lanes_plain::widen_even(px).v);
    EXPECT_EQ(shorts(lanes::widen_odd(x)), lanes_plain::widen_odd(px).v);
}

}  // namespace
}  // namespace semtrack
