#include "sil/simulate/feature_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "math/camera.hpp"
#include "sil/kitti/label_detections.hpp"
#include "support/aligned_pair.hpp"

namespace semtrack::sil {
namespace {

/// A standing camera; one car ahead, a second one hidden behind it.
class OneCar final : public Sequence {
public:
    explicit OneCar(double z, bool hidden = false) {
        cameras_.calibration = aligned_pair();
        for (int frame = 0; frame < 10; ++frame) {
            Label l;
            l.frame = frame;
            l.id = 1;
            l.type = "Car";
            l.height = 1.5;
            l.width = 1.6;
            l.length = 3.9;
            l.x = 1.0;
            l.y = 1.65;
            l.z = z;
            l.rotation_y = -1.4;
            labels_.push_back(l);
            if (hidden) {
                l.id = 2;
                l.x = 2.0;
                l.z = 2.0 * z;
                labels_.push_back(l);
            }
            frames_.push_back(frame);
        }
    }
    [[nodiscard]] const DriveCameras& cameras() const override { return cameras_; }
    [[nodiscard]] int first_frame() const override { return 0; }
    [[nodiscard]] int last_frame() const override { return 9; }
    [[nodiscard]] std::int64_t time_us(int frame) const override { return 100000 * frame; }
    void load(int /*frame*/, GreyImage& /*left*/, GreyImage& /*right*/) override {}
    [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return frames_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return ego_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override { return none_; }

private:
    DriveCameras cameras_{};
    std::vector<Label> labels_;
    std::vector<int> frames_;
    std::map<int, RigidTransform> ego_;
    std::map<int, std::vector<Detection>> none_;
};

std::unique_ptr<ExternalFeatures> at(FeatureSimulator& simulator, int frame) {
    auto out = std::make_unique<ExternalFeatures>();
    EXPECT_EQ(simulator.poll(100000 * frame, *out), SourceResult::kOk);
    return out;
}

TEST(FeatureSimulator, CountsGrowWithTheHeightOfTheBoxUpToTheirCap) {
    int before = 0;
    for (const double z : {40.0, 25.0, 15.0, 8.0}) {
        OneCar drive(z);
        FeatureSimulator simulator(drive, {}, 0, 9, 0.5);
        const int count = at(simulator, 5)->size();
        EXPECT_GE(count, before) << z;
        EXPECT_LE(count, 48);
        before = count;
    }
    EXPECT_GT(before, 40);
}

TEST(FeatureSimulator, PointsLieWithinFortyCentimetresUnderFacesThatAreSeenOrBehind) {
    OneCar drive(12.0);
    FeatureSimulator simulator(drive, {}, 0, 9, 1e-6);
    const Calibration& c = drive.cameras().calibration;
    const Pose T_o_c = label_pose(drive.labels()[0]).inverse();
    int background = 0;
    int all = 0;
    for (int frame = 0; frame < 10; ++frame) {
        const auto features = at(simulator, frame);
        for (const ExternalFeature& f : *features) {
            const double d = static_cast<double>(f.u) - static_cast<double>(f.u_right);
            const Vec3 p = T_o_c * Vec3(bearing(c.left, static_cast<double>(f.u), static_cast<double>(f.v)) *
                                        (c.left.fx * c.baseline_m / d));
            ++all;
            if (p(0) > 2.5) {  // the car drives away: its front is farthest
                ++background;
                continue;
            }
            // Rear (-x), right side (-y) and roof (+z) are seen.
            const double under = std::min({p(0) + 1.95, p(1) + 0.8, 0.75 - p(2)});
            EXPECT_GT(under, -0.01) << p(0) << " " << p(1) << " " << p(2);
            EXPECT_LT(under, 0.41) << p(0) << " " << p(1) << " " << p(2);
        }
    }
    EXPECT_GT(background, all / 20);
    EXPECT_LT(background, all / 5);
}

TEST(FeatureSimulator, MostFeaturesKeepTheirIdFromFrameToFrame) {
    OneCar drive(12.0);
    FeatureSimulator simulator(drive, {}, 0, 9, 0.5);
    const auto a = at(simulator, 3);
    const auto b = at(simulator, 4);
    int same = 0;
    for (const ExternalFeature& f : *a) {
        for (const ExternalFeature& g : *b) {
            if (f.id == g.id) {
                ++same;
                EXPECT_NEAR(static_cast<double>(f.u), static_cast<double>(g.u), 6.0);
            }
        }
    }
    EXPECT_GT(same, 8 * a->size() / 10);
    EXPECT_LT(same, a->size());
}

TEST(FeatureSimulator, WhatIsHiddenBehindANearerCarHasFewerFeatures) {
    OneCar alone(30.0);
    FeatureSimulator without(alone, {}, 0, 9, 0.5);
    OneCar behind(15.0, true);
    FeatureSimulator with(behind, {}, 0, 9, 0.5);
    int deep = 0;
    const auto features = at(with, 2);
    for (const ExternalFeature& f : *features) {
        deep += f.u - f.u_right < 16.0F ? 1 : 0;  // beyond 24 m
    }
    EXPECT_LT(deep, at(without, 2)->size());
}

TEST(FeatureSimulator, TheSameSeedGivesTheSameFeaturesAndOtherTimesNone) {
    OneCar drive(12.0);
    FeatureSimulator a(drive, {}, 0, 9, 0.5);
    FeatureSimulator b(drive, {}, 0, 9, 0.5);
    const auto x = at(a, 7);
    const auto y = at(b, 7);
    ASSERT_EQ(x->size(), y->size());
    for (int i = 0; i < x->size(); ++i) {
        EXPECT_EQ((*x)[i].u, (*y)[i].u);
        EXPECT_EQ((*x)[i].id, (*y)[i].id);
    }
    ExternalFeatures none;
    EXPECT_EQ(a.poll(12345, none), SourceResult::kNone);
}

}  // namespace
}  // namespace semtrack::sil
