// The history of the ego poses: lookup, revision, frames that hang on keyframes.
#include "model/ego_history.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "math/so3.hpp"

namespace semtrack {
namespace {

Pose at(double x) {
    Pose T;
    T.t = Vec3(x, 0.0, 0.0);
    return T;
}

class EgoHistoryTest : public ::testing::Test {
protected:
    [[nodiscard]] double x_of(std::uint32_t frame) const {
        Pose T;
        return history_->find(frame, T) ? T.t(0) : -1.0;
    }
    std::unique_ptr<EgoHistory> history_ = std::make_unique<EgoHistory>();
};

TEST_F(EgoHistoryTest, EmptyOneFindsNothingAndLeavesTheOutputs) {
    Pose T = at(7.0);
    std::uint32_t frame = 3;
    EXPECT_FALSE(history_->find(1, T));
    EXPECT_FALSE(history_->find_time(100, frame, T));
    EXPECT_EQ(T.t(0), 7.0);
    EXPECT_EQ(frame, 3U);
}

TEST_F(EgoHistoryTest, TurningTurnsEveryCameraWhereItStands) {
    history_->turn(rot_z(0.1));  // empty: nothing happens
    history_->add(1, 100, at(1.0));
    history_->add(2, 200, Pose{rot_z(0.5), Vec3(2.0, 0.0, 0.0)});
    history_->turn(rot_z(0.1));
    Pose T;
    ASSERT_TRUE(history_->find(1, T));
    EXPECT_LT((T.R - rot_z(0.1)).norm(), 1e-12);
    ASSERT_TRUE(history_->find(2, T));
    EXPECT_LT((T.R - rot_z(0.6)).norm(), 1e-12);
    EXPECT_EQ(x_of(1), 1.0);
    EXPECT_EQ(x_of(2), 2.0);
}

TEST_F(EgoHistoryTest, FullOneForgetsTheOldest) {
    for (std::uint32_t f = 1; f <= kEgoHistory + 5; ++f) {
        history_->add(f, 100 * static_cast<int>(f), at(f));
    }
    EXPECT_EQ(history_->size(), kEgoHistory);
    EXPECT_EQ(x_of(5), -1.0);
    EXPECT_EQ(x_of(6), 6.0);
    EXPECT_EQ(x_of(kEgoHistory + 5), kEgoHistory + 5.0);
}

TEST_F(EgoHistoryTest, TimeFindsItsFrameExactly) {
    history_->add(1, 1000, at(1));
    history_->add(2, 2000, at(2));
    std::uint32_t frame = 0;
    Pose T;
    EXPECT_TRUE(history_->find_time(2000, frame, T));
    EXPECT_EQ(frame, 2U);
    EXPECT_FALSE(history_->find_time(1999, frame, T));
}

TEST_F(EgoHistoryTest, FramesThatHangFollowTheirKeyframe) {
    history_->add(1, 1000, at(1));
    history_->add(2, 2000, at(2));
    history_->add(3, 3000, at(3));
    history_->hang(2, 1);
    history_->revise(1, at(1.5));
    EXPECT_DOUBLE_EQ(x_of(1), 1.5);
    EXPECT_DOUBLE_EQ(x_of(2), 2.5);
    EXPECT_DOUBLE_EQ(x_of(3), 3.0);
}

TEST_F(EgoHistoryTest, WhatHungOnAFrameMovesAlongWhenThatFrameHangs) {
    for (std::uint32_t f = 1; f <= 3; ++f) {
        history_->add(f, 1000 * static_cast<int>(f), at(f));
    }
    history_->hang(3, 2);
    history_->hang(2, 1);
    history_->revise(1, at(11.0));
    EXPECT_DOUBLE_EQ(x_of(2), 12.0);
    EXPECT_DOUBLE_EQ(x_of(3), 13.0);
}

TEST_F(EgoHistoryTest, UnknownFramesAreLeftAlone) {
    history_->add(1, 1000, at(1));
    history_->hang(1, 99);
    history_->hang(99, 1);
    history_->revise(99, at(5));
    EXPECT_DOUBLE_EQ(x_of(1), 1.0);
    history_->reset();
    EXPECT_EQ(history_->size(), 0);
}

}  // namespace
}  // namespace semtrack
