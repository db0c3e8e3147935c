#include "front/associate/associate.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "math/so3.hpp"

namespace semtrack {
namespace {

Detection detection(double left, double top, double right, double bottom, ObjectClass c = ObjectClass::kCar) {
    Detection d;
    d.box = {left, top, right, bottom};
    d.object_class = c;
    d.score = 0.9;
    return d;
}

class AssociateTest : public testing::Test {
protected:
    std::unique_ptr<Associator> associator_ = std::make_unique<Associator>();
    TrackBoxes tracks_;
    DetectionList list_;
    Assignment out_;
    void track(double l, double t, double r, double b, ObjectClass c = ObjectClass::kCar) {
        ASSERT_TRUE(tracks_.try_push_back({{l, t, r, b}, c}));
    }
    void detect(const Detection& d) { ASSERT_TRUE(list_.items.try_push_back(d)); }
    void run() { associator_->run(tracks_, list_, out_); }
};

TEST_F(AssociateTest, NothingMeetsNothing) {
    run();
    EXPECT_EQ(out_.detection_of_track[0], -1);
    detect(detection(0, 0, 10, 10));
    run();
    EXPECT_FALSE(out_.detection_used[0]);
}

TEST_F(AssociateTest, EachTrackGetsItsOwnBox) {
    track(100, 100, 150, 140);
    track(300, 100, 400, 180);
    detect(detection(305, 102, 404, 181));
    detect(detection(102, 101, 153, 141));
    run();
    EXPECT_EQ(out_.detection_of_track[0], 1);
    EXPECT_EQ(out_.detection_of_track[1], 0);
}

TEST_F(AssociateTest, TheBestSumWinsOverTheGreedyChoice) {
    // Greedy would give detection 0 to track 1 (nearer) and leave track 0 without any: 1 is too far for it.
    track(100, 100, 200, 200);
    track(130, 100, 230, 200);
    detect(detection(120, 100, 220, 200));
    detect(detection(201, 100, 301, 200));
    run();
    EXPECT_EQ(out_.detection_of_track[0], 0);
    EXPECT_EQ(out_.detection_of_track[1], 1);
}

TEST_F(AssociateTest, APedestrianIsNeverACarButAVanMayBe) {
    track(100, 100, 150, 140, ObjectClass::kPedestrian);
    detect(detection(100, 100, 150, 140, ObjectClass::kCar));
    run();
    EXPECT_EQ(out_.detection_of_track[0], -1);
    tracks_[0].object_class = ObjectClass::kVan;
    run();
    EXPECT_EQ(out_.detection_of_track[0], 0);
}

TEST_F(AssociateTest, FullTablesAreSolvedToTheLastPair) {
    for (int i = 0; i < kMaxObjects; ++i) {
        track(30.0 * i, 100, 30.0 * i + 28, 130);
    }
    for (int i = kMaxDetections - 1; i >= 0; --i) {
        detect(detection(30.0 * i + 2, 101, 30.0 * i + 30, 131));
    }
    run();
    for (int i = 0; i < kMaxObjects; ++i) {
        EXPECT_EQ(out_.detection_of_track[static_cast<std::size_t>(i)], kMaxDetections - 1 - i);
    }
}

TEST_F(AssociateTest, ABoxMovesWithTheCamerasRotation) {
    const PinholeCamera camera{700, 700, 600, 180};
    const Box2d moved = rotated_box({590, 170, 610, 190}, so3_exp(Vec3(0, 0.05, 0)), camera);
    EXPECT_NEAR(0.5 * (moved.left + moved.right), 600 + 700 * 0.05004, 0.1);
    EXPECT_NEAR(moved.right - moved.left, 20.0, 1e-9);
}

}  // namespace
}  // namespace semtrack
