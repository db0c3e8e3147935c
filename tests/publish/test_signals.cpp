// The table of signals and the places of the messages.
#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "publish/e2e.hpp"
#include "publish/messages.hpp"

namespace semtrack {
namespace {

constexpr std::array<CanDialect, 2> kDialects{CanDialect::kFd, CanDialect::kClassic};

TEST(Bits, WrittenBitsAreReadAndNeighboursStay) {
    FrameBytes data{};
    data.fill(0xA5);
    const FrameBytes before = data;
    put_bits(data, 13, 40, 0x12'3456'789AULL);
    EXPECT_EQ(get_bits(data, 13, 40), 0x12'3456'789AULL);
    EXPECT_EQ(get_bits(data, 0, 13), get_bits(before, 0, 13));
    EXPECT_EQ(get_bits(data, 53, 11), get_bits(before, 53, 11));
}

TEST(Bits, LowestBitComesFirstAsInIntelOrder) {
    FrameBytes data{};
    put_bits(data, 4, 12, 0xABC);
    EXPECT_EQ(data[0], 0xC0);
    EXPECT_EQ(data[1], 0xAB);
}

TEST(Signals, NamesAreUniqueAndEveryOneHasAPositiveScale) {
    std::set<std::string> names;
    for (int i = 0; i < kSignals; ++i) {
        const SignalSpec& s = signal_spec(static_cast<SignalId>(i));
        EXPECT_TRUE(names.insert(s.name).second) << s.name;
        EXPECT_GT(s.scale, 0.0) << s.name;
        EXPECT_LE(s.length, 40) << s.name;
    }
}

TEST(Signals, QuantisedWithinHalfABitOverTheWholeRange) {
    for (int i = 0; i < kSignals; ++i) {
        const SignalSpec& s = signal_spec(static_cast<SignalId>(i));
        const double lowest = physical(s, 0);
        const double highest = physical(s, max_raw(s));
        for (int k = 0; k <= 1000; ++k) {
            const double x = lowest + (highest - lowest) * k / 1000.0;
            const Quantised q = quantise(s, {x, true});
            EXPECT_FALSE(q.saturated) << s.name << " " << x;
            EXPECT_LE(std::fabs(physical(s, q.raw) - x), 0.5 * s.scale * (1.0 + 1e-6)) << s.name << " " << x;
        }
    }
}

TEST(Signals, BeyondTheRangeIsTheEndOfItAndFlaggedNeverWrapped) {
    const SignalSpec& s = signal_spec(SignalId::kPositionX);
    const Quantised above = quantise(s, {1e6, true});
    EXPECT_EQ(above.raw, max_raw(s));
    EXPECT_TRUE(above.saturated);
    const Quantised below = quantise(s, {-1e6, true});
    EXPECT_EQ(below.raw, 0U);
    EXPECT_TRUE(below.saturated);
}

TEST(Signals, MissingAndNotFiniteValuesAreAllOnes) {
    const SignalSpec& s = signal_spec(SignalId::kYaw);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const SignalValue& v : {SignalValue{0.0, false}, SignalValue{nan, true}, SignalValue{inf, true}}) {
        EXPECT_EQ(quantise(s, v).raw, all_ones(s.length));
        EXPECT_FALSE(quantise(s, v).saturated);
    }
}

TEST(Signals, RangesCoverTheRoad) {
    const auto covers = [](SignalId id, double low, double high, double resolution) {
        const SignalSpec& s = signal_spec(id);
        return physical(s, 0) <= low && physical(s, max_raw(s)) >= high && s.scale <= resolution;
    };
    EXPECT_TRUE(covers(SignalId::kPositionX, -200.0, 200.0, 0.01));
    EXPECT_TRUE(covers(SignalId::kPositionY, -200.0, 200.0, 0.01));
    EXPECT_TRUE(covers(SignalId::kVelocityX, -70.0, 70.0, 0.01));
    EXPECT_TRUE(covers(SignalId::kVelocityY, -70.0, 70.0, 0.01));
    EXPECT_TRUE(covers(SignalId::kYaw, -3.1416, 3.1416, 0.001));
}

TEST(Messages, EveryFrameHoldsItsSignals) {
    for (const CanDialect dialect : kDialects) {
        const DialectSpec& d = dialect_spec(dialect);
        for (int m = 0; m < d.messages; ++m) {
            const MessageSpec& spec = d.message[static_cast<std::size_t>(m)];
            const int records = spec.records > 0 ? spec.records : 1;
            EXPECT_LE(first_signal_bit(d, spec) + records * record_bits(spec), 8 * spec.length) << spec.name;
            EXPECT_EQ(spec.records == 0, m < d.header_messages) << spec.name;
        }
    }
}

TEST(Messages, EverySignalIsSentExactlyOnce) {
    for (const CanDialect dialect : kDialects) {
        const DialectSpec& d = dialect_spec(dialect);
        std::bitset<kListSignals> sent;
        sent.set(static_cast<std::size_t>(SignalId::kListCounter));
        for (int m = 0; m < d.messages; ++m) {
            const MessageSpec& spec = d.message[static_cast<std::size_t>(m)];
            for (int i = 0; i < spec.signals; ++i) {
                const auto id = static_cast<std::size_t>(spec.signal[static_cast<std::size_t>(i)]);
                EXPECT_FALSE(sent.test(id)) << spec.name;
                EXPECT_EQ(id >= static_cast<std::size_t>(kFirstObjectSignal), spec.records > 0) << spec.name;
                sent.set(id);
            }
        }
        EXPECT_TRUE(sent.all()) << d.name;
    }
}

TEST(Messages, RecordIndexHoldsTheHighestFrameOfAList) {
    for (const CanDialect dialect : kDialects) {
        const DialectSpec& d = dialect_spec(dialect);
        for (int m = d.header_messages; m < d.messages; ++m) {
            const int records = d.message[static_cast<std::size_t>(m)].records;
            EXPECT_LE((d.max_objects - 1) / records, static_cast<int>(all_ones(kRecordIndexBits)));
        }
    }
}

}  // namespace
}  // namespace semtrack
