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

TEST(EdgeAgreement, CountsEdgesInTheirSigmas) {
    TrackBox track{{100, 100, 140, 200}, ObjectClass::kPedestrian, {2.0, 4.0, 1.0, 0.0}};
    const auto moved = [](double l, double r, double t, double b) {
        return detection(100 + l, 100 + t, 140 + r, 200 + b);
    };
    EXPECT_EQ(edge_agreement(track, moved(0, 0, 0, 0)), 1.0);
    EXPECT_EQ(edge_agreement(track, moved(0, 0, 0, 50)), 1.0);                  // that edge has no sigma
    EXPECT_NEAR(edge_agreement(track, moved(4, -8, 2, 0)), 0.5, 1e-15);         // two sigmas each
    EXPECT_NEAR(edge_agreement(track, moved(-6, 0, 0, 0)), 1.0 / 1.75, 1e-15);  // 9 / (3 x 4)
    track.sigma_px = {};
    EXPECT_EQ(edge_agreement(track, moved(40, 40, 40, 40)), 1.0);
}

TEST(PairWorth, AFifthOfItDoesNotDependOnTheEdges) {
    TrackBox track{{100, 100, 140, 200}, ObjectClass::kPedestrian};
    const Detection same = detection(100, 100, 140, 200, ObjectClass::kPedestrian);
    EXPECT_NEAR(pair_worth(track, same), 1.0 - kLostSimilarity, 1e-15);
    const Detection lower = detection(100, 110, 140, 210, ObjectClass::kPedestrian);
    const double blind = pair_worth(track, lower);
    EXPECT_NEAR(blind, 1.0 - 0.6 * 0.1 - kLostSimilarity, 1e-12);  // centres a tenth of the height apart
    track.sigma_px = {0.0, 0.0, 1e-6, 1e-6};
    EXPECT_NEAR(pair_worth(track, lower), 0.2 * blind, 1e-9);
    EXPECT_EQ(pair_worth(track, detection(300, 100, 340, 200, ObjectClass::kPedestrian)), 0.0);
}

// Three people one behind the other, 16, 18.5 and 21 m away: feet at rows 249, 239, 231. The noise of the sides is
// larger than what sets them apart sideways; feet and heads tell them.
TEST_F(AssociateTest, PeopleOneBehindTheOtherKeepTheirBoxes) {
    track(849, 169, 866, 249, ObjectClass::kPedestrian);
    track(848, 173, 862, 239, ObjectClass::kPedestrian);
    track(847, 169, 860, 231, ObjectClass::kPedestrian);
    detect(detection(848, 168, 861, 232, ObjectClass::kPedestrian));
    detect(detection(850, 170, 864, 248, ObjectClass::kPedestrian));
    detect(detection(849, 172, 866, 240, ObjectClass::kPedestrian));
    for (TrackBox& t : tracks_) {
        t.sigma_px = {4.0, 4.0, 2.5, 2.5};
    }
    run();
    EXPECT_EQ(out_.detection_of_track[0], 1);
    EXPECT_EQ(out_.detection_of_track[1], 2);
    EXPECT_EQ(out_.detection_of_track[2], 0);
}

TEST_F(AssociateTest, EdgesNeverRefuseAPairThatIsSimilar) {
    track(100, 100, 150, 140);
    tracks_[0].sigma_px = {0.1, 0.1, 0.1, 0.1};
    detect(detection(108, 104, 161, 146));
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
