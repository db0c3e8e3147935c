#include "pipeline/usable_detections.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace semtrack {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

Detection box(double left, double right, double score = 0.5, ObjectClass object_class = ObjectClass::kCar) {
    Detection d;
    d.object_class = object_class;
    d.score = score;
    d.box = {left, 100.0, right, 200.0};
    return d;
}

struct Taken {
    DetectionList list;
    std::uint32_t dropped;
};

Taken take(std::initializer_list<Detection> detections) {
    DetectionList in;
    in.time_us = 77;
    for (const Detection& d : detections) {
        EXPECT_TRUE(in.items.try_push_back(d));
    }
    Taken out{};
    out.dropped = take_usable(in, kWidth, kHeight, out.list);
    return out;
}

TEST(UsableDetections, WholeListsStayAsTheyAreWithTheirTime) {
    const Taken t = take({box(10, 60), box(100, 160), box(70, 90)});
    ASSERT_EQ(t.list.items.size(), 3);
    EXPECT_EQ(t.list.time_us, 77);
    EXPECT_EQ(t.list.items[1].box.left, 100.0);
    EXPECT_EQ(t.dropped, 0U);
    EXPECT_EQ(take({}).list.items.size(), 0);
}

TEST(UsableDetections, BoxesThatAreNoneOrLieOutsideAreDroppedAndCounted) {
    Detection nan = box(10, 60);
    nan.box.top = std::numeric_limits<double>::quiet_NaN();
    Detection endless = box(10, 60);
    endless.score = std::numeric_limits<double>::infinity();
    const Taken t = take({nan, endless, box(60, 10), box(30, 30), box(-50, -10), box(700, 800), box(-20, 20)});
    EXPECT_EQ(t.dropped, 6U);
    ASSERT_EQ(t.list.items.size(), 1);
    EXPECT_EQ(t.list.items[0].box.left, 0.0);
}

TEST(UsableDetections, TheSameObjectTwiceIsOneDetectionTheBetterOne) {
    const Taken same = take({box(10, 60), box(10, 60)});
    EXPECT_EQ(same.list.items.size(), 1);
    EXPECT_EQ(same.dropped, 1U);
    const Taken better = take({box(10, 60, 0.4), box(200, 260), box(11, 61, 0.7, ObjectClass::kVan)});
    ASSERT_EQ(better.list.items.size(), 2);
    EXPECT_EQ(better.list.items[0].object_class, ObjectClass::kVan);
    EXPECT_EQ(take({box(10, 60, 0.5), box(10, 60, 0.5, ObjectClass::kVan)}).list.items[0].object_class,
              ObjectClass::kCar);
}

TEST(UsableDetections, NeighboursAndAPersonBeforeACarAreTwoObjects) {
    EXPECT_EQ(take({box(0, 100), box(12, 112)}).list.items.size(), 2);  // intersection over union 88 / 112
    EXPECT_EQ(take({box(0, 100), box(11, 111)}).list.items.size(), 1);  // 89 / 111
    EXPECT_EQ(take({box(10, 60), box(10, 60, 0.9, ObjectClass::kPedestrian)}).list.items.size(), 2);
}

TEST(UsableDetections, AFullListIsTakenWhole) {
    DetectionList in;
    while (!in.items.full()) {
        const double left = 4.0 * in.items.size();
        EXPECT_TRUE(in.items.try_push_back(box(left, left + 3.0)));
    }
    DetectionList out;
    EXPECT_EQ(take_usable(in, kWidth, kHeight, out), 0U);
    EXPECT_EQ(out.items.size(), in.items.size());
}

}  // namespace
}  // namespace semtrack
