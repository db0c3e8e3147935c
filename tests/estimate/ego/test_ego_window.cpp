// Landmarks of the ego window: they outlive their features, and their number is bounded.
#include <gtest/gtest.h>

#include <memory>

#include "estimate/ego/ego_problem.hpp"
#include "estimate/ego/ego_window.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {
namespace {

FeatureMeasurement sight(std::uint32_t id, int slot) {
    FeatureMeasurement m;
    m.id = id;
    m.slot = static_cast<std::int16_t>(slot);
    m.stereo = true;
    m.u = 100.0F + static_cast<float>(slot);
    m.v = 90.0F;
    m.u_right = m.u - 20.0F;
    m.sigma_px = m.sigma_right_px = 0.25F;
    return m;
}

class EgoWindowTest : public ::testing::Test {
protected:
    /// One more frame in which the slots 0 .. count - 1 show features first_id, first_id + 1, ...
    void frame(std::uint32_t first_id, int count) {
        const int leaving = window_->leaving();
        if (leaving >= 0) {
            window_->drop(leaving);
        }
        window_->push(++frame_, Pose{});
        features_->clear();
        for (int s = 0; s < count; ++s) {
            (void)features_->try_push_back(sight(first_id + static_cast<std::uint32_t>(s), s));
        }
        window_->take(*features_, calibration_);
        window_->give_birth(calibration_);
        if (frame_ % 3 == 1) {
            window_->frames.back().keyframe = true;
        }
    }
    [[nodiscard]] const EgoLandmark* find(std::uint32_t id) const {
        for (const EgoLandmark& l : window_->landmarks) {
            if (l.used && l.id == id) {
                return &l;
            }
        }
        return nullptr;
    }
    [[nodiscard]] int used() const {
        int n = 0;
        for (const EgoLandmark& l : window_->landmarks) {
            n += l.used ? 1 : 0;
        }
        return n;
    }

    Calibration calibration_ = PlaneScene{}.calibration();
    std::unique_ptr<EgoWindow> window_ = std::make_unique<EgoWindow>();
    std::unique_ptr<EgoProblem> problem_ = std::make_unique<EgoProblem>();
    std::unique_ptr<FrameFeatures> features_ = std::make_unique<FrameFeatures>();
    std::uint32_t frame_{0};

    void SetUp() override { window_->clear(); }
};

TEST_F(EgoWindowTest, ALandmarkStaysWhenItsSlotIsGivenToAnotherFeature) {
    frame(1, 10);
    frame(1, 10);
    frame(101, 10);
    ASSERT_NE(find(1), nullptr);
    EXPECT_EQ(find(1)->slot, -1);
    EXPECT_TRUE(find(1)->valid);
    ASSERT_NE(find(101), nullptr);
    EXPECT_EQ(find(101)->slot, 0);
    problem_->begin(*window_, calibration_);
    EXPECT_EQ(problem_->landmarks(), 10) << "the old ones, seen twice; the new ones are seen once";
    frame(101, 10);
    problem_->begin(*window_, calibration_);
    EXPECT_EQ(problem_->landmarks(), 20);
}

TEST_F(EgoWindowTest, ALandmarkThatTheWindowNoLongerSeesTwiceIsFreed) {
    frame(1, 10);
    frame(101, 10);  // 1 .. 10 were seen once: nothing ties two poses together
    frame(101, 10);
    EXPECT_EQ(find(1), nullptr);
    EXPECT_EQ(used(), 10);
}

TEST_F(EgoWindowTest, WithFullSlotsThatChangeEveryOtherFrameTheOldestGo) {
    for (std::uint32_t generation = 0; generation < 12; ++generation) {
        const std::uint32_t first = 1 + generation * kMaxBackgroundFeatures;
        frame(first, kMaxBackgroundFeatures);
        frame(first, kMaxBackgroundFeatures);
        EXPECT_LE(used(), kEgoLandmarks);
        for (int s = 0; s < kMaxBackgroundFeatures; ++s) {
            const int index = window_->landmark_of_slot[static_cast<std::size_t>(s)];
            ASSERT_GE(index, 0);
            EXPECT_EQ(window_->landmarks[static_cast<std::size_t>(index)].id, first + static_cast<std::uint32_t>(s));
            EXPECT_EQ(window_->landmarks[static_cast<std::size_t>(index)].slot, s);
        }
        problem_->begin(*window_, calibration_);
        EXPECT_EQ(problem_->landmarks(), kSolverPoints) << "what the newest frame sees comes first";
    }
}

TEST_F(EgoWindowTest, ClearForgetsAll) {
    frame(1, 20);
    window_->clear();
    EXPECT_EQ(used(), 0);
    EXPECT_EQ(window_->landmark_of_slot[0], -1);
    EXPECT_TRUE(window_->frames.empty());
}

}  // namespace
}  // namespace semtrack
