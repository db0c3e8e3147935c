#include "sil/world/detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sil/world/world_sequence.hpp"
#include "world_cases.hpp"

namespace semtrack::sil::world {
namespace {

TEST(WorldDetector, IdealBoxesAreTheVisibleSilhouettes) {
    const Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, 15.0, 0.0);
    const Scene scene(s, 1);
    const Calibration c = world_calibration(s);
    const std::vector<Silhouette> seen = Renderer(scene, c).silhouettes(0);
    const std::vector<Detection> d = detect(scene, c, 0, seen, DetectorMode::kIdeal);
    ASSERT_EQ(d.size(), 1U);
    EXPECT_EQ(d[0].box.left, seen[0].visible.left);
    EXPECT_EQ(d[0].box.bottom, seen[0].visible.bottom);
    EXPECT_EQ(d[0].viewpoint.horizontal, 6);
    EXPECT_EQ(d[0].score, 1.0);
}

TEST(WorldDetector, SmallAndHiddenThingsAreNotDetected) {
    Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, 90.0, 0.0);
    s = with_user(s, ObjectClass::kTruck, 0.0, 14.0, 0.0);
    s = with_user(s, ObjectClass::kCar, 0.0, 24.0, 0.0);
    const Scene scene(s, 1);
    const Calibration c = world_calibration(s);
    const std::vector<Detection> d = detect(scene, c, 0, Renderer(scene, c).silhouettes(0), DetectorMode::kIdeal);
    ASSERT_EQ(d.size(), 1U);
    EXPECT_EQ(d[0].object_class, ObjectClass::kTruck);
}

// The same silhouettes in a thousand frames: only the errors differ.
TEST(WorldDetector, ErrorsAreOfTheStatedSizeAndRepeatable) {
    const Scenario s = with_user(quiet_street(), ObjectClass::kCar, 0.0, 15.0, 0.4);
    const Scene scene(s, 1000);
    const Calibration c = world_calibration(s);
    const std::vector<Silhouette> seen = Renderer(scene, c).silhouettes(0);
    int found = 0;
    int wrong = 0;
    int extra = 0;
    double squares = 0.0;
    for (int frame = 0; frame < 1000; ++frame) {
        const std::vector<Detection> d = detect(scene, c, frame, seen, DetectorMode::kRealistic);
        const std::vector<Detection> again = detect(scene, c, frame, seen, DetectorMode::kRealistic);
        ASSERT_EQ(d.size(), again.size());
        for (const Detection& x : d) {
            EXPECT_GE(x.box.left, 0.0);
            EXPECT_LE(x.box.right, c.width - 1.0);
            EXPECT_GE(x.box.top, 0.0);
            EXPECT_LE(x.box.bottom, c.height - 1.0);
            EXPECT_GT(x.score, 0.0);
            EXPECT_LE(x.score, 1.0);
            const double e = x.box.left - seen[0].visible.left;
            if (std::fabs(e) > 12.0) {
                ++extra;
                continue;
            }
            ++found;
            squares += e * e;
            wrong += x.viewpoint.horizontal != 7 ? 1 : 0;
        }
    }
    EXPECT_NEAR(found, 970, 20);
    EXPECT_NEAR(wrong, 39, 20);
    EXPECT_NEAR(extra, 30, 18);
    const double sigma = std::sqrt(squares / found);
    const double width = seen[0].visible.right - seen[0].visible.left;
    EXPECT_NEAR(sigma, std::max(1.0, 0.015 * width), 0.12);
}

TEST(WorldSequence, ListsEveryFrameThatTheDetectorAnswered) {
    const WorldSequence w("street", WorldOptions{4, false, 2});
    EXPECT_EQ(w.label_detections().size(), 4U);
    EXPECT_EQ(w.first_frame(), 0);
    EXPECT_EQ(w.last_frame(), 3);
    EXPECT_EQ(w.time_us(3), 300000);
    EXPECT_EQ(w.labelled_frames().size(), 4U);
    EXPECT_EQ(w.ego_truth().size(), 4U);
    EXPECT_FALSE(w.labels().empty());
    for (const Label& l : w.labels()) {
        EXPECT_LT(l.box.left, l.box.right);
        EXPECT_LT(l.box.top, l.box.bottom);
    }
}

TEST(WorldSequence, RefusesUnknownScenariosAndFrames) {
    EXPECT_THROW(WorldSequence("no such street"), InputError);
    EXPECT_THROW(WorldSequence("street", WorldOptions{-1, false, 1}), InputError);
    const WorldSequence w("empty", WorldOptions{1, false, 1});
    GreyImage left;
    GreyImage right;
    EXPECT_THROW(w.render(1, left, right), InputError);
    EXPECT_TRUE(w.labels().empty());
    EXPECT_EQ(w.label_detections().size(), 1U);
}

TEST(WorldSequence, EveryScenarioBearsItsNameAndUniqueIds) {
    for (const std::string& name : scenario_names()) {
        const Scenario s = find_scenario(name);
        EXPECT_EQ(s.name, name);
        for (std::size_t i = 0; i < s.users.size(); ++i) {
            for (std::size_t j = i + 1; j < s.users.size(); ++j) {
                EXPECT_NE(s.users[i].id, s.users[j].id) << name;
            }
        }
    }
}

TEST(WorldSequence, TrafficCoversMoreThanHalfOfTheImage) {
    const Scenario s = find_scenario("traffic");
    const Scene scene(s, 31);
    const Calibration c = world_calibration(s);
    for (const int frame : {0, 15, 30}) {
        std::int64_t covered = 0;
        for (const Silhouette& x : Renderer(scene, c).silhouettes(frame)) {
            covered += x.visible_samples;
        }
        const double share = static_cast<double>(covered) / (4.0 * c.width * c.height);
        EXPECT_GT(share, 0.5) << frame;
    }
}

}  // namespace
}  // namespace semtrack::sil::world
