#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "sil/report/picture_overlay.hpp"
#include "sil/report/picture_trajectory.hpp"
#include "sil/report/picture_writer.hpp"

namespace semtrack::sil {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

Calibration kitti_like() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = c.right = c.detection = {721.5, 721.5, 609.6, 172.9};
    c.baseline_m = 0.54;
    return c;
}

TrackedObject car(std::uint32_t id, double x, double y, double yaw, double speed) {
    TrackedObject o;
    o.id = id;
    o.slot = static_cast<int>(id % 32);
    o.status = TrackStatus::kMeasured;
    o.movement = speed > 0.5 ? MovementState::kMoving : MovementState::kStanding;
    o.has_heading = true;
    o.position_v = {x, y, -0.9};
    o.position_w = o.position_v;
    o.yaw_v = o.yaw_w = yaw;
    o.speed = speed;
    o.velocity_v = {speed * std::cos(yaw), speed * std::sin(yaw)};
    o.size = {3.9, 1.6, 1.5};
    const double u = 609.6 - 721.5 * y / x;
    const double half = 721.5 * 1.2 / x;
    o.box = {u - half, 172.9 + 721.5 * 0.15 / x, u + half, 172.9 + 721.5 * 1.65 / x};
    o.box_valid = true;
    return o;
}

Output street(double ego_x) {
    Output output;
    output.ego.status = EgoStatus::kTracked;
    output.ego.speed = 9.8;
    output.ego.features = 480;
    output.ego.inliers = 401;
    output.ego.T_w_v.t = {ego_x, 0.02 * ego_x * ego_x / 10.0, 0.0};
    const auto add = [&](TrackedObject o) {
        o.position_w[0] += output.ego.T_w_v.t[0];
        o.position_w[1] += output.ego.T_w_v.t[1];
        EXPECT_TRUE(output.objects.try_push_back(o));
    };
    add(car(1, 12.0, 3.5, kHalfTurn, 8.0));
    add(car(2, 25.0, 0.0, 0.0, 9.5));
    add(car(3, 18.0, -4.0, 0.3, 0.0));
    add(car(4, 2.0, -3.0, 0.0, 0.0));  // partly behind the image plane
    TrackedObject coasted = car(9, 40.0, 6.0, 1.2, 0.0);
    coasted.status = TrackStatus::kCoasted;
    add(coasted);
    TrackedObject lost = car(11, 15.0, 1.0, 0.0, 0.0);
    lost.status = TrackStatus::kLost;
    add(lost);
    for (int i = 0; i < 200; ++i) {
        SparsePoint p;
        p.owner = static_cast<std::uint8_t>(i % 5 == 0 ? 3 : 0);
        p.has_position = i % 3 != 0;
        p.u = static_cast<float>((i * 173) % 1242);
        p.v = static_cast<float>((i * 89) % 375);
        EXPECT_TRUE(output.points.try_push_back(p));
    }
    return output;
}

GreyImage plain_image() {
    GreyImage image{1242, 375, {}};
    image.pixels.assign(static_cast<std::size_t>(1242 * 375), 120);
    return image;
}

int differing(const Canvas& a, const Canvas& b) {
    int n = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Colour p = a.at(x, y);
            const Colour q = b.at(x, y);
            n += p.r != q.r || p.g != q.g || p.b != q.b ? 1 : 0;
        }
    }
    return n;
}

TEST(PictureOverlay, ObjectsArePaintedWhereTheyAre) {
    Output empty;
    Output one;
    ASSERT_TRUE(one.objects.try_push_back(car(2, 25.0, 0.0, 0.0, 9.5)));
    const Canvas without = draw_overlay(7, plain_image(), kitti_like(), empty);
    const Canvas with = draw_overlay(7, plain_image(), kitti_like(), one);
    EXPECT_EQ(with.width(), 1242);
    EXPECT_EQ(with.height(), 375);
    EXPECT_GT(differing(without, with), 100);
    for (int x = 0; x < 1242; ++x) {  // nothing right of the car, nor below it
        const Colour p = with.at(x, 330);
        EXPECT_EQ(p.r, p.g);
    }
    bool painted = false;  // the rear face's lower edge: 23.05 m away, 1.65 m down
    const int v = static_cast<int>(std::lround(172.9 + 721.5 * 1.65 / 23.05));
    for (int d = -1; d <= 1; ++d) {
        const Colour p = with.at(609, v + d);
        painted = painted || p.r != p.g || p.g != p.b;
    }
    EXPECT_TRUE(painted);
}

TEST(PictureOverlay, LostTracksAreNotDrawn) {
    Output lost;
    TrackedObject o = car(2, 25.0, 0.0, 0.0, 9.5);
    o.status = TrackStatus::kLost;
    ASSERT_TRUE(lost.objects.try_push_back(o));
    EXPECT_EQ(differing(draw_overlay(7, plain_image(), kitti_like(), Output{}),
                        draw_overlay(7, plain_image(), kitti_like(), lost)),
              0);
}

TEST(PictureOverlay, WithoutAnImageTheGroundHasTheCalibrationsSize) {
    const Canvas canvas = draw_overlay(7, GreyImage{}, kitti_like(), street(0.0));
    EXPECT_EQ(canvas.width(), 1242);
    EXPECT_EQ(canvas.height(), 375);
}

TEST(PictureOverlay, WildValuesAreSurvived) {
    Output output;
    TrackedObject o = car(2, 0.0, 0.0, 0.0, 0.0);  // around the camera
    ASSERT_TRUE(output.objects.try_push_back(o));
    o.position_v[0] = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(output.objects.try_push_back(o));
    o = car(3, 1e9, -1e9, 0.0, 0.0);
    o.box = {-1e9, -1e9, 1e9, 1e9};
    ASSERT_TRUE(output.objects.try_push_back(o));
    PlanHistory history;
    history.add(output);
    EXPECT_EQ(draw_overlay(1, plain_image(), kitti_like(), output).width(), 1242);
    EXPECT_EQ(draw_birdseye(600, 300, output, history, {}).width(), 600);
    EXPECT_GT(draw_map(history, {}, {}).width(), 0);
}

TEST(PictureBirdseye, ThingsAheadAreToTheRightAndThingsToTheLeftAreAbove) {
    Output output;
    ASSERT_TRUE(output.objects.try_push_back(car(2, 30.0, 10.0, 0.0, 0.0)));
    PlanHistory history;
    const Canvas without = draw_birdseye(1200, 480, Output{}, history, {});
    const Canvas with = draw_birdseye(1200, 480, output, history, {});
    double x_sum = 0.0;
    double y_sum = 0.0;
    int n = 0;
    for (int y = 0; y < 480; ++y) {
        for (int x = 0; x < 1200; ++x) {
            const Colour p = with.at(x, y);
            const Colour q = without.at(x, y);
            if (p.r != q.r || p.g != q.g || p.b != q.b) {
                x_sum += x;
                y_sum += y;
                ++n;
            }
        }
    }
    ASSERT_GT(n, 100);
    EXPECT_NEAR(x_sum / n, 12 * (14 + 30), 15);
    EXPECT_NEAR(y_sum / n, 240 - 12 * 10, 15);
}

TEST(PictureBirdseye, LabelsInCameraZeroLandInTheVehicleFrame) {
    Label l;
    l.x = 2.0;
    l.y = 1.65;
    l.z = 20.0;
    l.height = 1.5;
    l.length = 4.0;
    l.width = 1.6;
    l.rotation_y = -0.5 * kHalfTurn;  // driving ahead
    const PlanBox b = plan_box(l, Calibration{}.T_v_c, {-0.06, 0.0, 0.0});
    EXPECT_NEAR(b.x, 20.0, 1e-12);
    EXPECT_NEAR(b.y, -2.06, 1e-12);
    EXPECT_NEAR(b.yaw, 0.0, 1e-12);
}

TEST(PictureTrajectory, TruthIsLaidOnTheFirstCommonFrame) {
    // Truth: camera 0 drives along its z by 1 m a frame, from frame 3 on. The tracker knows frames 4..6, heading left.
    std::map<int, RigidTransform> truth;
    std::map<int, RigidTransform> poses;
    for (int n = 3; n <= 6; ++n) {
        truth[n].t = {0.0, 0.0, static_cast<double>(n - 3)};
    }
    RigidTransform left;
    left.R = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    for (int n = 4; n <= 6; ++n) {
        poses[n] = left;
        poses[n].t = {5.0, static_cast<double>(n - 4), 0.0};
    }
    const auto in_w = truth_in_world(truth, poses, Calibration{}.T_v_c, {0.0, 0.0, 0.0});
    ASSERT_EQ(in_w.size(), 3U);
    EXPECT_NEAR(in_w.at(4)[0], 5.0, 1e-12);
    EXPECT_NEAR(in_w.at(6)[0], 5.0, 1e-12);
    EXPECT_NEAR(in_w.at(6)[1], 2.0, 1e-12);
    EXPECT_TRUE(truth_in_world(truth, {}, Calibration{}.T_v_c, {0.0, 0.0, 0.0}).empty());
    EXPECT_GT(draw_trajectory(poses, in_w).width(), 100);
    EXPECT_GT(draw_trajectory({}, {}).width(), 100);
}

class StreetSequence final : public Sequence {
public:
    StreetSequence() {
        for (int n = 0; n < 30; ++n) {
            Label l;
            l.frame = n;
            l.id = 1;
            l.type = n == 5 ? "DontCare" : "Car";
            l.x = -3.4;
            l.y = 1.65;
            l.z = 12.1;
            l.height = 1.5;
            l.width = 1.6;
            l.length = 3.9;
            l.rotation_y = 0.5 * kHalfTurn;
            labels_.push_back(l);
            truth_[n].t = {0.0, 0.0, 1.01 * n};
        }
        cameras_.calibration = kitti_like();
    }
    [[nodiscard]] const DriveCameras& cameras() const override { return cameras_; }
    [[nodiscard]] int first_frame() const override { return 0; }
    [[nodiscard]] int last_frame() const override { return 29; }
    [[nodiscard]] std::int64_t time_us(int frame) const override { return frame * 100000; }
    void load(int, GreyImage&, GreyImage&) override {}
    [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return frames_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return truth_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override { return lists_; }

private:
    DriveCameras cameras_;
    std::vector<Label> labels_;
    std::vector<int> frames_;
    std::map<int, RigidTransform> truth_;
    std::map<int, std::vector<Detection>> lists_;
};

TEST(PictureWriter, WritesAPictureAFrameAndTwoOfTheDrive) {
    const auto dir = std::filesystem::path(testing::TempDir()) / "semtrack_pictures";
    std::filesystem::remove_all(dir);
    {
        PictureWriter writer(dir, kitti_like(), StreetSequence{});
        for (int n = 0; n < 30; ++n) {
            writer.add(n, n == 7 ? GreyImage{} : plain_image(), street(n));
        }
        writer.finish();
    }
    for (const char* name : {"000000.png", "000007.png", "000029.png", "birdseye.png", "trajectory.png"}) {
        const auto path = dir / "pictures" / name;
        ASSERT_TRUE(std::filesystem::exists(path)) << name;
        EXPECT_GT(std::filesystem::file_size(path), 1000U) << name;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir / "pictures"), {}), 32);
    if (std::getenv("SEMTRACK_KEEP_PICTURES") == nullptr) {
        std::filesystem::remove_all(dir);
    }
}

}  // namespace
}  // namespace semtrack::sil
