// End-to-end protection against published vectors.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "publish/e2e.hpp"

namespace semtrack {
namespace {

std::string hex(const FrameBytes& data, int length) {
    std::string out;
    for (int i = 0; i < length; ++i) {
        char byte[3];
        (void)std::snprintf(byte, sizeof byte, "%02x", data[static_cast<std::size_t>(i)]);
        out += byte;
    }
    return out;
}

FrameBytes ramp(int length) {
    FrameBytes data{};
    for (int i = 0; i < length; ++i) {
        data[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i);
    }
    return data;
}

std::string profile5(FrameBytes data, int length, std::uint16_t id, std::uint8_t counter, int shown) {
    protect_profile5(data, length, id, counter);
    return hex(data, shown);
}

std::string profile11(FrameBytes data, int length, std::uint16_t id, std::uint8_t counter, int shown) {
    protect_profile11(data, length, id, counter);
    return hex(data, shown);
}

TEST(Crc, SixteenBitCheckValueOfNineDigits) {
    std::uint16_t crc = 0xFFFF;
    for (const char c : std::string("123456789")) {
        crc = crc16_1021(crc, static_cast<std::uint8_t>(c));
    }
    EXPECT_EQ(crc, 0x29B1);
}

TEST(Crc, EightBitCheckValueOfNineDigitsWithStartAndFinalXorOfJ1850) {
    std::uint8_t crc = 0xFF;
    for (const char c : std::string("123456789")) {
        crc = crc8_1d(crc, static_cast<std::uint8_t>(c));
    }
    EXPECT_EQ(crc ^ 0xFF, 0x4B);
}

TEST(E2eProfile5, EightZeroBytes) {
    EXPECT_EQ(profile5({}, 8, 0x1234, 0, 3), "1cca00");
    EXPECT_EQ(profile5({}, 8, 0x1234, 1, 3), "cf8d01");
}

TEST(E2eProfile5, SixtyFourBytesAtEveryEndOfTheCounter) {
    EXPECT_EQ(profile5(ramp(64), 64, 0x0601, 0, 4), "bd340003");
    EXPECT_EQ(profile5(ramp(64), 64, 0x0601, 1, 4), "efea0103");
    EXPECT_EQ(profile5(ramp(64), 64, 0x0601, 255, 4), "fda6ff03");
}

TEST(E2eProfile5, DataIdIsProtected) {
    EXPECT_EQ(profile5(ramp(64), 64, 0x0602, 1, 4), "bcbf0103");
    EXPECT_EQ(profile5(ramp(8), 8, 0x0600, 5, 8), "3b46050304050607");
}

TEST(E2eProfile11, NibbleModeVectors) {
    EXPECT_EQ(profile11({}, 8, 0x123, 0, 2), "2a10");
    EXPECT_EQ(profile11({}, 8, 0x123, 1, 2), "7711");
    EXPECT_EQ(profile11(ramp(8), 8, 0x123, 3, 8), "de13020304050607");
}

TEST(E2e, EveryFlippedBitChangesTheCrc) {
    FrameBytes fd = ramp(64);
    protect_profile5(fd, 64, 0x0601, 7);
    const std::uint16_t crc5 = profile5_crc(fd, 64, 0x0601);
    for (unsigned bit = 16; bit < 512; ++bit) {
        FrameBytes broken = fd;
        broken[bit / 8] = static_cast<std::uint8_t>(broken[bit / 8] ^ (1U << (bit % 8)));
        EXPECT_NE(profile5_crc(broken, 64, 0x0601), crc5) << bit;
    }
    FrameBytes classic = ramp(8);
    protect_profile11(classic, 8, 0x0604, 7);
    const std::uint8_t crc11 = profile11_crc(classic, 8, 0x0604);
    for (unsigned bit = 8; bit < 64; ++bit) {
        FrameBytes broken = classic;
        broken[bit / 8] = static_cast<std::uint8_t>(broken[bit / 8] ^ (1U << (bit % 8)));
        EXPECT_NE(profile11_crc(broken, 8, 0x0604), crc11) << bit;
    }
}

/// CRCs are linear: a pattern of flipped bits goes unseen when the bits' own changes of the check cancel each other.
/// The change of a bit of the CRC itself is that bit.
TEST(E2e, AnyTwoFlippedBitsOfAClassicFrameAndAnyThreeOfAnFdFrameAreFound) {
    std::set<unsigned> changes8;
    for (unsigned bit = 0; bit < 64; ++bit) {
        FrameBytes one{};
        one[bit / 8] = static_cast<std::uint8_t>(1U << (bit % 8));
        const auto change = static_cast<unsigned>(profile11_crc(one, 8, 0) ^ profile11_crc({}, 8, 0) ^ one[0]);
        EXPECT_NE(change, 0U);
        EXPECT_TRUE(changes8.insert(change).second) << "two bits cancel: " << bit;
    }
    std::set<unsigned> changes16;
    for (unsigned bit = 0; bit < 512; ++bit) {
        FrameBytes one{};
        one[bit / 8] = static_cast<std::uint8_t>(1U << (bit % 8));
        const unsigned own = one[0] | static_cast<unsigned>(one[1]) << 8U;
        const auto change = static_cast<unsigned>(profile5_crc(one, 64, 0) ^ profile5_crc({}, 64, 0)) ^ own;
        EXPECT_NE(change, 0U);
        EXPECT_TRUE(changes16.insert(change).second) << "two bits cancel: " << bit;
    }
    for (const unsigned a : changes16) {
        for (const unsigned b : changes16) {
            ASSERT_FALSE(a != b && changes16.count(a ^ b) > 0) << "three bits cancel";
        }
    }
}

}  // namespace
}  // namespace semtrack
