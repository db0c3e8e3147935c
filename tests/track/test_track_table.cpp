#include "track/track_table.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace semtrack {
namespace {

class TrackTableTest : public testing::Test {
protected:
    std::unique_ptr<TrackTable> table_ = std::make_unique<TrackTable>();
    Track* start(double score = 0.9) {
        int slot = -1;
        return table_->start(ObjectClass::kCar, score, slot);
    }
};

TEST_F(TrackTableTest, OneDetectionIsNotYetAnObjectTwoOrThreeAre) {
    Track* t = start();
    ASSERT_NE(t, nullptr);
    update_status(*t, true);
    EXPECT_EQ(t->status, TrackStatus::kNew);
    for (int k = 0; k < 2; ++k) {
        t->hit_now = true;
        update_hit(*t, 0.9);
        update_status(*t, true);
    }
    EXPECT_EQ(t->status, TrackStatus::kMeasured);
}

TEST_F(TrackTableTest, AConfirmedTrackCoastsThroughMissesAndIsLostWhenTheyGoOn) {
    Track* t = start();
    ASSERT_NE(t, nullptr);
    for (int k = 0; k < 5; ++k) {
        t->hit_now = true;
        update_hit(*t, 0.9);
        update_status(*t, true);
    }
    int coasted = 0;
    for (int k = 0; k < 30 && t->status != TrackStatus::kLost; ++k) {
        t->hit_now = false;
        update_miss(*t, detection_probability(*t, 60.0));
        update_status(*t, true);
        coasted += t->status == TrackStatus::kCoasted ? 1 : 0;
    }
    EXPECT_GE(coasted, 2);
    EXPECT_EQ(t->status, TrackStatus::kLost);
    EXPECT_TRUE(t->confirmed);
}

TEST_F(TrackTableTest, FramesWithoutAListAreNoMisses) {
    Track* t = start();
    ASSERT_NE(t, nullptr);
    for (int k = 0; k < 5; ++k) {
        t->hit_now = true;
        update_hit(*t, 0.9);
        update_status(*t, true);
    }
    const double before = t->existence;
    for (int k = 0; k < 5; ++k) {
        t->hit_now = false;
        update_status(*t, true);
    }
    EXPECT_EQ(t->status, TrackStatus::kCoasted);
    EXPECT_GT(t->existence, 0.95 * before);
}

TEST_F(TrackTableTest, AHiddenObjectIsMissedLongerThanAVisibleOne) {
    Track* t = start();
    ASSERT_NE(t, nullptr);
    const double visible = detection_probability(*t, 60.0);
    t->occlusion = 2;
    EXPECT_LT(detection_probability(*t, 60.0), visible);
    t->visible_share = 0.0;
    EXPECT_LT(detection_probability(*t, 60.0), 0.1);
}

TEST_F(TrackTableTest, AFullTableGivesWayOnlyToTentativeTracksThatWereMissed) {
    for (int s = 0; s < kMaxObjects; ++s) {
        Track* t = start();
        ASSERT_NE(t, nullptr);
        t->status = TrackStatus::kMeasured;
    }
    EXPECT_EQ(start(), nullptr);
    (*table_)[5].status = TrackStatus::kNew;
    (*table_)[5].missed_lists = 1;
    const std::uint32_t old_id = (*table_)[5].id;
    int slot = -1;
    Track* t = table_->start(ObjectClass::kVan, 0.5, slot);
    ASSERT_NE(t, nullptr);
    EXPECT_EQ(slot, 5);
    EXPECT_NE(t->id, old_id);
}

TEST_F(TrackTableTest, IdsAreNeverUsedTwice) {
    std::uint32_t last = 0;
    for (int k = 0; k < 100; ++k) {
        int slot = -1;
        Track* t = table_->start(ObjectClass::kCar, 0.5, slot);
        ASSERT_NE(t, nullptr);
        EXPECT_GT(t->id, last);
        last = t->id;
        table_->remove(slot);
    }
}

TEST_F(TrackTableTest, ATrackThatLeavesTheViewIsLostAtOnce) {
    Track* t = start();
    ASSERT_NE(t, nullptr);
    t->hit_now = true;
    update_status(*t, false);
    EXPECT_EQ(t->status, TrackStatus::kLost);
    EXPECT_FALSE(t->confirmed);
}

}  // namespace
}  // namespace semtrack
