#include "sil/report/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hal/loopback/can_log.hpp"
#include "math/trig.hpp"

namespace semtrack::sil {
namespace {

Pose default_T_c_v() {
    return to_pose(Calibration{}.T_v_c).inverse();
}

TrackedObject car_at(double x_v, double y_v, double z_v, double yaw_v) {
    TrackedObject o;
    o.id = 7;
    o.position_v = {x_v, y_v, z_v};
    o.yaw_v = yaw_v;
    o.size = {3.9, 1.6, 1.5};
    o.has_heading = true;
    o.status = TrackStatus::kMeasured;
    o.box_valid = true;
    return o;
}

std::size_t columns(const std::string& row, char separator) {
    return static_cast<std::size_t>(std::count(row.begin(), row.end(), separator)) + 1U;
}

TEST(KittiPlace, ACarAheadThatDrivesAwayLooksAlongTheCamerasDepth) {
    const KittiPlace p = kitti_place(car_at(20.0, 0.0, -0.9, 0.0), default_T_c_v(), {0, 0, 0});
    EXPECT_NEAR(p.bottom_c0(0), 0.0, 1e-15);
    EXPECT_NEAR(p.bottom_c0(1), 1.65, 1e-15);  // half the height below the centre
    EXPECT_NEAR(p.bottom_c0(2), 20.0, 1e-15);
    EXPECT_NEAR(p.rotation_y, -0.5 * kPi, 1e-15);  // theta_V = -(rotation_y + pi/2)
    EXPECT_NEAR(p.alpha, -0.5 * kPi, 1e-15);
}

TEST(KittiPlace, ACarAtTheLeftThatDrivesToTheRightHasRotationZero) {
    const KittiPlace p = kitti_place(car_at(10.0, 10.0, -0.9, -0.5 * kPi), default_T_c_v(), {0, 0, 0});
    EXPECT_NEAR(p.bottom_c0(0), -10.0, 1e-14);
    EXPECT_NEAR(p.rotation_y, 0.0, 1e-15);
    EXPECT_NEAR(p.alpha, 0.25 * kPi, 1e-15);
}

TEST(KittiPlace, PlacesAreInCameraZeroWhicheverCameraIsProcessed) {
    const KittiPlace p = kitti_place(car_at(20.0, 0.0, -0.9, 0.0), default_T_c_v(), {0.06, 0.001, -0.003});
    EXPECT_NEAR(p.bottom_c0(0), 0.06, 1e-15);
    EXPECT_NEAR(p.bottom_c0(1), 1.651, 1e-14);
    EXPECT_NEAR(p.bottom_c0(2), 19.997, 1e-14);
    EXPECT_NEAR(p.alpha, p.rotation_y - atan2_rad(p.bottom_c0(0), p.bottom_c0(2)), 1e-15);
}

TEST(KittiPlace, AnglesAreWrappedToMinusPiUpToButNotPi) {
    for (int k = -8; k <= 8; ++k) {
        const KittiPlace p = kitti_place(car_at(-5.0, 3.0, 0.0, 0.25 * kPi * k), default_T_c_v(), {0, 0, 0});
        EXPECT_GE(p.rotation_y, -kPi);
        EXPECT_LT(p.rotation_y, kPi);
        EXPECT_GE(p.alpha, -kPi);
        EXPECT_LT(p.alpha, kPi);
    }
}

TEST(Tables, RowsHaveTheColumnsOfTheirHeaders) {
    const TrackedObject o = car_at(20.0, 0.0, -0.9, 0.0);
    EXPECT_EQ(columns(ego_header(), ','), columns(ego_row(1, {}, {}), ','));
    EXPECT_EQ(columns(states_header(), ','), columns(states_row(1, 2, o), ','));
    EXPECT_EQ(columns(points_header(), ','), columns(points_row(1, 0, {}), ','));
    EXPECT_EQ(columns(timing_header(), ','), columns(timing_row(1, {}, 2, 3), ','));
    EXPECT_EQ(columns(objects_row(1, o, {}), ' '), 19U);
    EXPECT_EQ(columns(pose_row(Pose{}), ' '), 12U);
}

TEST(Tables, TheFirstFrameHasNoMotionAndItsFieldsAreEmpty) {
    EgoState ego;
    ego.time_us = 5;
    Health health;
    EXPECT_EQ(ego_row(3, ego, health), "3,5,start,,,,,0,0,ok\n");
    ego.status = EgoStatus::kPredicted;
    ego.speed = 1.5;
    health.ego_degraded = true;
    health.no_detections = true;
    EXPECT_EQ(ego_row(4, ego, health), "4,5,predicted,1.5,0,0,0,0,0,ego_degraded+no_detections\n");
    health = Health{};
    health.road_not_plane = true;
    EXPECT_EQ(ego_row(4, ego, health), "4,5,predicted,1.5,0,0,0,0,0,road_not_plane\n");
}

TEST(Tables, APedestrianDoesNotSteer) {
    TrackedObject o = car_at(20.0, 0.0, -0.9, 0.0);
    o.object_class = ObjectClass::kPedestrian;
    o.has_heading = false;
    o.status = TrackStatus::kCoasted;
    EXPECT_EQ(states_row(1, 2, o),
              "1,2,7,Pedestrian,coasted,0,0,0,0,0,,3.8999999999999999,1.6000000000000001,1.5,"
              "0,0,0,0,0,0,0\n");
}

TEST(Tables, OnlyConfirmedTracksWithABoxInTheImageAreObjects) {
    TrackedObject o = car_at(20.0, 0.0, -0.9, 0.0);
    EXPECT_TRUE(belongs_in_objects(o));
    o.status = TrackStatus::kCoasted;
    EXPECT_TRUE(belongs_in_objects(o));
    for (const TrackStatus status : {TrackStatus::kNew, TrackStatus::kLost}) {
        o.status = status;
        EXPECT_FALSE(belongs_in_objects(o));
    }
    o.status = TrackStatus::kMeasured;
    o.box_valid = false;
    EXPECT_FALSE(belongs_in_objects(o));
}

std::string log_line(const CanFrame& frame, std::int64_t time_us) {
    hal::CanLogLine line{};
    const std::size_t size = hal::can_log_line(frame, time_us, "can0", line);
    return {line.data(), size};
}

TEST(CanLog, ClassicAndFdFramesAreWrittenAsCandumpDoes) {
    CanFrame f;
    f.id = 0x60A;
    f.length = 2;
    f.data[0] = 0xAB;
    f.data[1] = 0x01;
    EXPECT_EQ(log_line(f, 1317041234056789), "(1317041234.056789) can0 60A#AB01\n");
    f.fd = true;
    EXPECT_EQ(log_line(f, 100000), "(0000000000.100000) can0 60A##1AB01\n");
    f.extended = true;
    EXPECT_EQ(log_line(f, 0), "(0000000000.000000) can0 0000060A##1AB01\n");
}

TEST(CanLog, TimesBeyond32BitsAndBeforeTheEpochAreNotCut) {
    CanFrame f;
    EXPECT_EQ(log_line(f, 5000000000LL * 1000000 + 1), "(5000000000.000001) can0 000#\n");
    EXPECT_EQ(log_line(f, -1500000), "(-0000000001.500000) can0 000#\n");
    EXPECT_NE(log_line(f, std::numeric_limits<std::int64_t>::min()), "");
}

TEST(CanLog, TheLongestFrameFitsItsLine) {
    CanFrame f;
    f.id = 0x1FFFFFFF;
    f.extended = f.fd = true;
    f.length = 64;
    hal::CanLogLine line{};
    const std::size_t size =
        hal::can_log_line(f, std::numeric_limits<std::int64_t>::min(), "an_interface_name_too_long", line);
    EXPECT_GT(size, 128U);
    EXPECT_LT(size, line.size());
}

TEST(CanLog, LengthsAndIdsThatDoNotExistAreInvalid) {
    CanFrame f;
    f.length = 9;
    EXPECT_EQ(log_line(f, 0), "");
    f.fd = true;
    EXPECT_EQ(log_line(f, 0), "");
    f.length = 12;
    EXPECT_NE(log_line(f, 0), "");
    f.fd = false;
    EXPECT_EQ(log_line(f, 0), "");
    f.length = 0;
    f.id = 0x800;
    EXPECT_EQ(log_line(f, 0), "");
    std::FILE* const file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    hal::CanLog log(file);
    EXPECT_EQ(log.send(f, 0), CanTx::Result::kInvalidFrame);
    f.id = 1;
    EXPECT_EQ(log.send(f, 0), CanTx::Result::kSent);
    (void)std::fclose(file);
}

TEST(CanLog, AFileThatCannotBeWrittenIsABusThatIsOff) {
    std::FILE* const reader = std::fopen("/dev/null", "rb");
    ASSERT_NE(reader, nullptr);
    hal::CanLog log(reader);
    EXPECT_EQ(log.send(CanFrame{}, 0), CanTx::Result::kBusOff);
    EXPECT_TRUE(log.failed());
    (void)std::fclose(reader);
}

}  // namespace
}  // namespace semtrack::sil
