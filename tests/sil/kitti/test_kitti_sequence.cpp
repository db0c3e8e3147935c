#include "sil/kitti/kitti_sequence.hpp"

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

const std::string kPair = "P0: 700 0 600 0 0 700 170 0 0 0 1 0\nP1: 700 0 600 -350 0 700 170 0 0 0 1 0\n";
const std::string kFour = kPair + "P2: 700 0 600 42 0 700 170 0 0 0 1 0\nP3: 700 0 600 -308 0 700 170 0 0 0 1 0\n";
const std::string kEye = "1 0 0 0 0 1 0 0 0 0 1 0\n";
const std::string kId = "2011_09_26_drive_0039";

class KittiSequences : public TempFiles {
protected:
    void make_odometry(int frames) const {
        std::string times;
        for (int n = 0; n < frames; ++n) {
            write_grey("sequences/06/image_0/00000" + std::to_string(n) + ".png", 20, 10, static_cast<std::uint8_t>(n));
            write_grey("sequences/06/image_1/00000" + std::to_string(n) + ".png", 20, 10, 99);
            times += std::to_string(0.1 * n) + "\n";
        }
        write("sequences/06/calib.txt", kPair);
        write("sequences/06/times.txt", times);
    }
    void make_raw(const std::string& stamps) const {
        const std::string drive = "2011_09_26/" + kId + "_sync/";
        write("2011_09_26/calib_cam_to_cam.txt",
              "P_rect_00: 700 0 600 0 0 700 170 0 0 0 1 0\nP_rect_01: 700 0 600 -350 0 700 170 0 0 0 1 0\n"
              "P_rect_02: 700 0 600 42 0 700 170 0 0 0 1 0\nR_rect_00: 1 0 0 0 1 0 0 0 1\n");
        write(drive + "image_00/timestamps.txt", stamps);
        for (const char* n : {"2", "3"}) {
            write_grey(drive + "image_00/data/000000000" + n + ".png", 20, 10, 1);
            write_grey(drive + "image_01/data/000000000" + n + ".png", 20, 10, 2);
        }
    }
    void make_tracking() const {
        write("training/calib/0010.txt", kFour);
        write_grey("training/image_02/0010/000000.png", 20, 10, 1);
        write_grey("training/image_03/0010/000000.png", 20, 10, 2);
        write_grey("training/image_02/0010/000001.png", 20, 10, 1);
        write_grey("training/image_03/0010/000001.png", 20, 10, 2);
    }
    [[nodiscard]] SequenceOptions options(const std::string& layout, const std::string& id) const {
        SequenceOptions o;
        o.layout = layout;
        o.root = root_;
        o.sequence = id;
        return o;
    }
};

const std::string kStamps =
    "2011-09-26 13:00:00.0\n2011-09-26 13:00:00.1\n2011-09-26 13:00:00.2\n2011-09-26 13:00:00.3\n";

TEST_F(KittiSequences, OdometryDrivesHaveImagesTimesAndNoTruthUnlessThereIsAFile) {
    make_odometry(3);
    auto s = open_kitti_sequence(options("odometry", "06"));
    EXPECT_EQ(s->first_frame(), 0);
    EXPECT_EQ(s->last_frame(), 2);
    EXPECT_EQ(s->time_us(2), 200000);
    EXPECT_EQ(s->cameras().calibration.width, 20);
    EXPECT_EQ(s->cameras().calibration.height, 10);
    EXPECT_TRUE(s->ego_truth().empty());
    EXPECT_TRUE(s->labels().empty());
    GreyImage left;
    GreyImage right;
    s->load(1, left, right);
    EXPECT_EQ(left.pixels.at(0), 1);
    EXPECT_EQ(right.pixels.at(0), 99);
    write("poses/06.txt", kEye + kEye + kEye);
    EXPECT_EQ(open_kitti_sequence(options("odometry", "06"))->ego_truth().size(), 3U);
}

TEST_F(KittiSequences, MissingImagesAreDroppedFramesOrDroppedRightImages) {
    make_odometry(4);
    std::filesystem::remove(at("sequences/06/image_1/000001.png"));
    std::filesystem::remove(at("sequences/06/image_1/000002.png"));
    std::filesystem::remove(at("sequences/06/image_0/000002.png"));
    auto s = open_kitti_sequence(options("odometry", "06"));
    GreyImage left;
    GreyImage right;
    s->load(1, left, right);
    EXPECT_FALSE(left.empty());
    EXPECT_TRUE(right.empty());
    s->load(2, left, right);
    EXPECT_TRUE(left.empty());
    EXPECT_TRUE(right.empty());
    s->load(3, left, right);
    EXPECT_FALSE(right.empty());
}

TEST_F(KittiSequences, TheRangeCountsImagesOfEitherSide) {
    make_odometry(4);
    std::filesystem::remove(at("sequences/06/image_0/000000.png"));
    std::filesystem::remove(at("sequences/06/image_0/000003.png"));
    const auto s = open_kitti_sequence(options("odometry", "06"));
    EXPECT_EQ(s->first_frame(), 0);
    EXPECT_EQ(s->last_frame(), 3);
}

TEST_F(KittiSequences, ForeignFilesInAnImageFolderAreIgnored) {
    make_odometry(3);
    for (const char* name : {"._000001.png", "Thumbs.db", "0000009.png", "00009.png", "000009.PNG", "000009.png.bak",
                             "00000a.png", "-00009.png", ".png"}) {
        write(std::string("sequences/06/image_0/") + name, "no picture");
    }
    EXPECT_EQ(open_kitti_sequence(options("odometry", "06"))->last_frame(), 2);
}

TEST_F(KittiSequences, ImagesOfAnotherSizeAreRefusedByName) {
    make_odometry(3);
    write_grey("sequences/06/image_0/000001.png", 21, 10, 1);
    write_grey("sequences/06/image_1/000002.png", 20, 9, 1);
    auto s = open_kitti_sequence(options("odometry", "06"));
    GreyImage left;
    GreyImage right;
    EXPECT_REFUSED(s->load(1, left, right), at("sequences/06/image_0/000001.png").string() + ": is 21 x 10 px");
    EXPECT_REFUSED(s->load(2, left, right), at("sequences/06/image_1/000002.png").string() + ": is 20 x 9 px");
}

TEST_F(KittiSequences, FramesBeyondTheTimesAreRefused) {
    make_odometry(3);
    write("sequences/06/times.txt", "0\n0.1\n");
    EXPECT_REFUSED(open_kitti_sequence(options("odometry", "06")), "times.txt:2: ends here, frame 2 has no time");
    std::filesystem::remove(at("sequences/06/times.txt"));
    EXPECT_REFUSED(open_kitti_sequence(options("odometry", "06")), "times.txt");
}

TEST_F(KittiSequences, WhatIsNotThereIsRefusedByItsPath) {
    make_odometry(2);
    EXPECT_REFUSED(open_kitti_sequence(options("odometry", "07")), at("sequences/07").string());
    EXPECT_REFUSED(open_kitti_sequence(options("raw", kId)), kId);
    EXPECT_REFUSED(open_kitti_sequence(options("raw", "06")), "06");
    EXPECT_REFUSED(open_kitti_sequence(options("tracking", "0010")), at("training").string());
    EXPECT_REFUSED(open_kitti_sequence(options("world", "06")), "world");
    SequenceOptions o = options("odometry", "06");
    o.root = at("nowhere");
    EXPECT_REFUSED(open_kitti_sequence(o), at("nowhere").string());
    o = options("odometry", "06");
    o.calib = at("other.txt");
    EXPECT_REFUSED(open_kitti_sequence(o), at("other.txt").string());
    o = options("odometry", "06");
    o.detections_camera = 2;
    EXPECT_REFUSED(open_kitti_sequence(o), "no row P2");
    o.detections_camera = 1;
    EXPECT_REFUSED(open_kitti_sequence(o), "--detections-camera 1");
    std::filesystem::remove_all(at("sequences/06/image_1"));
    EXPECT_REFUSED(open_kitti_sequence(options("odometry", "06")), at("sequences/06/image_1").string());
}

TEST_F(KittiSequences, AnotherCalibrationIsReadInPlaceOfTheDrives) {
    make_odometry(2);
    SequenceOptions o = options("odometry", "06");
    o.calib = write("fitted.txt", "P0: 700 0 600 0 0 700 170 0 0 0 1 0\nP1: 700 0 600.8 -350 0 700 170 0 0 0 1 0\n");
    EXPECT_EQ(open_kitti_sequence(o)->cameras().calibration.right.cx, 600.8);
}

TEST_F(KittiSequences, RawDrivesCountPosesByTheirFrameList) {
    make_raw(kStamps);
    const std::string drive = "2011_09_26/" + kId + "_sync/";
    write(drive + "poses.txt", kEye + "1 0 0 9 0 1 0 0 0 0 1 0\n");
    write(drive + "frames.txt", "2\n3\n");
    write(drive + "label_02/0039.txt", "3 7 Car 0 0 0 5 2 12 8 1.5 1.6 3.9 0 1.6 200 -1.57\n");
    write(drive + "label_02/labelled_frames.txt", "2\n3\n");
    const SequenceOptions o = options("raw", kId);
    const auto s = open_kitti_sequence(o);
    EXPECT_EQ(s->first_frame(), 2);
    EXPECT_EQ(s->last_frame(), 3);
    EXPECT_EQ(s->time_us(3) - s->time_us(2), 100000);
    EXPECT_EQ(s->time_us(0), 1317042000000000);
    EXPECT_EQ(s->ego_truth().at(3).t[0], 9.0);
    EXPECT_EQ(s->ego_truth().count(0), 0U);
    EXPECT_EQ(s->labelled_frames(), (std::vector<int>{2, 3}));
    EXPECT_TRUE(s->label_detections().at(2).empty());
    EXPECT_EQ(s->label_detections().at(3).size(), 1U);
    EXPECT_NEAR(s->cameras().t_label_c[0], 0.06, 1e-12);
    EXPECT_EQ(read_ego_poses(o, write("ego.txt", kEye + kEye)).begin()->first, 2);
    write(drive + "frames.txt", "3\n3\n");
    EXPECT_REFUSED(open_kitti_sequence(o), "frames.txt:2: ");
}

TEST_F(KittiSequences, RawDrivesFallBackToTracklets) {
    make_raw(kStamps);
    write("2011_09_26/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\n");
    write("2011_09_26/" + kId + "_sync/tracklet_labels.xml",
          "<boost_serialization>\n<tracklets>\n<count>1</count>\n<item>\n<objectType>Car</objectType>\n"
          "<h>1.5</h><w>1.6</w><l>4</l><first_frame>3</first_frame>\n<poses><count>1</count><item><tx>600</tx>"
          "<ty>503</ty><tz>140</tz><rz>0</rz></item></poses>\n</item>\n</tracklets>\n</boost_serialization>\n");
    const auto s = open_kitti_sequence(options("raw", kId));
    ASSERT_EQ(s->labels().size(), 1U);
    EXPECT_EQ(s->labels()[0].frame, 3);
    EXPECT_EQ(s->labelled_frames(), (std::vector<int>{2, 3}));
}

TEST_F(KittiSequences, TrackingDrivesUseTheColourPair) {
    make_tracking();
    write("training/label_02/0010.txt", "1 7 Car 0 0 0 5 2 12 8 1.5 1.6 3.9 0 1.6 200 -1.57\n");
    write("training/labels_viewpoints/0010.txt", "1 7 3 0\n");
    SequenceOptions o = options("tracking", "0010");
    auto s = open_kitti_sequence(o);
    EXPECT_EQ(s->time_us(1), 103600);
    EXPECT_NEAR(s->cameras().calibration.baseline_m, 0.5, 1e-12);
    EXPECT_NEAR(s->cameras().t_c0_c[0], -0.06, 1e-12);
    EXPECT_EQ(s->cameras().calibration.t_d_c[0], 0.0);
    EXPECT_EQ(s->label_detections().at(1)[0].viewpoint.horizontal, 3);
    EXPECT_EQ(s->label_detections().at(1)[0].box.left, 5.0);
    EXPECT_TRUE(s->label_detections().at(0).empty());
    o.detections_camera = 0;
    EXPECT_NEAR(open_kitti_sequence(o)->cameras().calibration.t_d_c[0], -0.06, 1e-12);
    EXPECT_REFUSED(open_kitti_sequence(options("tracking", "0011")), "0011");
}

TEST_F(KittiSequences, WithoutImagesTheFramesAreTheRowsOfThePosesFile) {
    write("training/calib/0010.txt", kFour);
    SequenceOptions o = options("tracking", "0010");
    o.images = false;
    o.poses = write("ego.txt", kEye + kEye + kEye);
    auto s = open_kitti_sequence(o);
    EXPECT_EQ(s->first_frame(), 0);
    EXPECT_EQ(s->last_frame(), 2);
    EXPECT_EQ(s->cameras().calibration.width, 1242);
    EXPECT_EQ(s->cameras().calibration.height, 375);
    GreyImage left;
    GreyImage right;
    s->load(0, left, right);
    EXPECT_TRUE(left.empty());
    o.width = 1249;
    EXPECT_REFUSED(open_kitti_sequence(o), "--image-size");
    o.width = 1242;
    o.poses = write("ego.txt", "");
    EXPECT_REFUSED(open_kitti_sequence(o), "ego.txt:1: ");
    EXPECT_REFUSED(open_kitti_sequence(options("tracking", "0010")), at("training/image_02/0010").string());
}

}  // namespace
}  // namespace semtrack::sil
