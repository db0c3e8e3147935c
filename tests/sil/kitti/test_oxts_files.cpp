#include "sil/kitti/oxts_files.hpp"

#include <cmath>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "sil/kitti/kitti_sequence.hpp"
#include "sil/kitti/mount_files.hpp"
#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

constexpr double kEarth_m = 6378137.0;
constexpr double kDegrees = 180.0 / kPi;

/// A sensor that moves from 49 degrees north, 8 east by x (east), y (north), z m; written as KITTI does. By libm, with
/// the projection's inverse: nothing in common with the reader's own.
std::string fix_at(double x, double y, double z, double roll, double pitch, double yaw) {
    const double phi0 = 49.0 / kDegrees;
    const double scale = kEarth_m * std::cos(phi0);
    const double phi = 2.0 * std::atan(std::exp(std::log(std::tan(kPi / 4.0 + phi0 / 2.0)) + y / scale)) - kPi / 2.0;
    std::string out;
    for (const double v : {phi * kDegrees, 8.0 + x / scale * kDegrees, 110.0 + z, roll, pitch, yaw}) {
        char text[40];
        (void)std::snprintf(text, sizeof text, "%.15g ", v);
        out += text;
    }
    return out + "0 0 0\n";
}

class OxtsFiles : public TempFiles {
protected:
    void put(int frame, const std::string& text) const {
        char name[32];
        (void)std::snprintf(name, sizeof name, "oxts/data/%010d.txt", frame);
        (void)write(name, text);
    }
    [[nodiscard]] std::filesystem::path folder() const { return at("oxts/data"); }
};

TEST_F(OxtsFiles, PlacesComeBackThroughTheProjection) {
    put(3, fix_at(0, 0, 0, 0, 0, 0));
    put(4, fix_at(12.5, -3.25, 0.5, 0, 0, 0));
    put(900, fix_at(-2400.0, 5100.0, -31.0, 0, 0, 0));
    const auto poses = read_oxts(folder(), Pose{});
    ASSERT_EQ(poses.size(), 3U);
    EXPECT_NEAR(poses.at(4).t[0], 12.5, 1e-6);
    EXPECT_NEAR(poses.at(4).t[1], -3.25, 1e-6);
    EXPECT_NEAR(poses.at(4).t[2], 0.5, 1e-6);
    EXPECT_NEAR(poses.at(900).t[0], -2400.0, 1e-6);
    EXPECT_NEAR(poses.at(900).t[1], 5100.0, 1e-6);
    EXPECT_NEAR(poses.at(900).t[2], -31.0, 1e-6);
}

TEST_F(OxtsFiles, TheFirstPoseIsTheIdentityAndTheCameraSwingsAboutTheSensor) {
    // The camera looks along the sensor's x axis and stands 1 m ahead of it: axes x right, y down, z ahead.
    Pose T_c0_imu;
    T_c0_imu.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    T_c0_imu.t = Vec3(0, 0, -1);
    put(0, fix_at(5, 7, 0, 0, 0, 0.4));
    put(1, fix_at(5, 7, 0, 0, 0, 0.5));  // turns on the spot, by 0.1 rad to the left
    const auto poses = read_oxts(folder(), T_c0_imu);
    const Pose first = to_pose(poses.at(0));
    const Pose second = to_pose(poses.at(1));
    EXPECT_LT(first.t.norm() + (first.R - Mat3::Identity()).norm(), 1e-9);
    EXPECT_LT((second.R - so3_exp(Vec3(0, -0.1, 0))).norm(), 1e-9);
    EXPECT_LT((second.t - Vec3(-std::sin(0.1), 0, std::cos(0.1) - 1.0)).norm(), 1e-6);
}

TEST_F(OxtsFiles, AttitudeIsYawThenPitchThenRoll) {
    put(0, fix_at(0, 0, 0, 0, 0, 0));
    put(1, fix_at(0, 0, 0, 0.1, 0.2, 0.3));
    const Mat3 R = so3_exp(Vec3(0, 0, 0.3)) * so3_exp(Vec3(0, 0.2, 0)) * so3_exp(Vec3(0.1, 0, 0));
    EXPECT_LT((to_pose(read_oxts(folder(), Pose{}).at(1)).R - R).norm(), 1e-12);
}

TEST_F(OxtsFiles, NonsenseIsRefusedByFileAndLineAndNoFolderIsNoTruth) {
    EXPECT_TRUE(read_oxts(folder(), Pose{}).empty());
    put(0, fix_at(0, 0, 0, 0, 0, 0));
    put(1, "49 8 110 0 0\n");
    EXPECT_REFUSED(read_oxts(folder(), Pose{}), "0000000001.txt:1: ");
    put(1, "49 8 nan 0 0 0\n");
    EXPECT_REFUSED(read_oxts(folder(), Pose{}), "0000000001.txt:1: ");
    put(1, "89 8 110 0 0 0\n");
    EXPECT_REFUSED(read_oxts(folder(), Pose{}), "0000000001.txt:1: ");
    put(1, "");
    EXPECT_REFUSED(read_oxts(folder(), Pose{}), "0000000001.txt:1: ");
    EXPECT_REFUSED(read_sensor_mount(write("mount.txt", "R: 1 0 0 0 1 0 0 0 1\n")), "no row T:");
}

TEST_F(OxtsFiles, ARawDriveWithoutPosesTakesThemAsTruth) {
    const std::string drive = "2011_09_26/2011_09_26_drive_0039_sync/";
    (void)write("2011_09_26/calib_cam_to_cam.txt",
                "P_rect_00: 700 0 10 0 0 700 5 0 0 0 1 0\nP_rect_01: 700 0 10 -350 0 700 5 0 0 0 1 0\n"
                "R_rect_00: 1 0 0 0 1 0 0 0 1\n");
    (void)write("2011_09_26/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\n");
    (void)write("2011_09_26/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
    (void)write(drive + "image_00/timestamps.txt", "2011-09-26 13:00:00.0\n2011-09-26 13:00:00.1\n");
    for (const char* image : {"image_00/data/0000000000.png", "image_01/data/0000000000.png",
                              "image_00/data/0000000001.png", "image_01/data/0000000001.png"}) {
        write_grey(drive + image, 20, 10, 1);
    }
    (void)write(drive + "oxts/data/0000000000.txt", fix_at(0, 0, 0, 0, 0, 0));
    (void)write(drive + "oxts/data/0000000001.txt", fix_at(1.5, 0, 0, 0, 0, 0));
    SequenceOptions options;
    options.layout = "raw";
    options.root = root_;
    options.sequence = "2011_09_26_drive_0039";
    const auto sequence = open_kitti_sequence(options);
    ASSERT_EQ(sequence->ego_truth().size(), 2U);
    EXPECT_NEAR(sequence->ego_truth().at(1).t[2], 1.5, 1e-6);
    (void)write(drive + "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 9\n");
    EXPECT_EQ(open_kitti_sequence(options)->ego_truth().at(1).t[2], 9.0);
}

}  // namespace
}  // namespace semtrack::sil
