#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/label_detections.hpp"
#include "sil/kitti/mount_files.hpp"
#include "sil/kitti/temp_files.hpp"
#include "sil/kitti/tracklet_file.hpp"

namespace semtrack::sil {
namespace {

class Labels : public TempFiles {};

const std::string kCar = "3 7 Car 0 1 -1.5 500 160 600 220 1.53 1.63 3.88 0 1.65 20 -1.57\n";
const std::string kDontCare = "3 -1 DontCare -1 -1 -10 10 20 30 40 -1 -1 -1 -1000 -1000 -1000 -10\n";

/// Camera 2 stands 6 cm to the left of camera 0, which is the processed and the detector's one.
DriveCameras two_cameras() {
    DriveCameras d;
    d.calibration.width = 1242;
    d.calibration.height = 375;
    d.calibration.left = d.calibration.right = d.calibration.detection = d.label_camera = {720, 720, 610, 173};
    d.calibration.baseline_m = 0.54;
    d.t_label_c = {0.06, 0.0, 0.0};
    return d;
}

TEST_F(Labels, ColumnsGoWhereTheyBelong) {
    const auto labels = read_labels(write("l.txt", kCar + kDontCare + kDontCare), {});
    ASSERT_EQ(labels.size(), 3U);
    const Label& l = labels[0];
    EXPECT_EQ(l.frame, 3);
    EXPECT_EQ(l.id, 7);
    EXPECT_EQ(l.type, "Car");
    EXPECT_EQ(l.occluded, 1);
    EXPECT_EQ(l.box.left, 500.0);
    EXPECT_EQ(l.box.bottom, 220.0);
    EXPECT_EQ(l.height, 1.53);
    EXPECT_EQ(l.length, 3.88);
    EXPECT_EQ(l.z, 20.0);
    EXPECT_EQ(l.rotation_y, -1.57);
    EXPECT_EQ(l.viewpoint.horizontal, -1);
    EXPECT_EQ(labels[1].type, "DontCare");
}

TEST_F(Labels, ViewpointsComeFromTheCompanion) {
    const auto labels = read_labels(write("l.txt", kCar), write("v.txt", "2 7 1 1\n3 7 6 1\n"));
    EXPECT_EQ(labels[0].viewpoint.horizontal, 6);
    EXPECT_EQ(labels[0].viewpoint.vertical, 1);
    EXPECT_REFUSED(read_labels(at("l.txt"), write("v.txt", "3 7 300 1\n")), "v.txt:1: ");
    EXPECT_EQ(read_labels(at("l.txt"), at("no_such.txt"))[0].viewpoint.horizontal, -1);
}

TEST_F(Labels, NonsenseIsRefusedByLine) {
    EXPECT_REFUSED(read_labels(write("l.txt", kCar + kCar), {}), "l.txt:2: the same frame and id twice");
    EXPECT_REFUSED(read_labels(write("l.txt", "3 7 Car 0 1\n"), {}), "l.txt:1: ");
    EXPECT_REFUSED(read_labels(write("l.txt", "3 7 Car 0 1 -1.5 1 2 3 4 1.5 1.6 0 0 1 20 0\n"), {}), "l.txt:1: ");
    EXPECT_REFUSED(read_labels(write("l.txt", "3 7 Car 0 1 -1.5 1 2 3 4 1.5 -1 3 0 1 20 0\n"), {}), "l.txt:1: ");
    EXPECT_REFUSED(read_labels(write("l.txt", "3 7 Car 0 1 x 1 2 3 4 1.5 1 3 0 1 20 0\n"), {}), "l.txt:1: ");
    EXPECT_TRUE(read_labels(write("l.txt", ""), {}).empty());
}

TEST_F(Labels, IdealDetectionsMoveEachEdgeByItsOwnDepth) {
    // Seen from behind (rotation_y = -90 degrees): the near face lies at z - length / 2.
    const auto labels = read_labels(
        write("l.txt", "3 7 Car 0 0 -1.5 580.5 162 639.5 218 1.5 1.6 4.0 0 1.65 20 -1.5707963267948966\n"), {});
    const auto lists = detections_from_labels(labels, {3, 4}, two_cameras());
    ASSERT_EQ(lists.at(3).size(), 1U);
    const Detection& d = lists.at(3)[0];
    const double shift = 720 * 0.06 / 18.0;
    EXPECT_NEAR(d.box.left, 580.5 - shift, 1e-9);
    EXPECT_NEAR(d.box.right, 639.5 - shift, 1e-9);
    EXPECT_NEAR(d.box.top, 162.0, 1e-9);
    EXPECT_EQ(d.score, 1.0);
    EXPECT_EQ(d.viewpoint.horizontal, 6);
    EXPECT_EQ(d.viewpoint.vertical, 1);
    EXPECT_TRUE(lists.at(4).empty()) << "labelled without objects: an empty list";
    EXPECT_EQ(lists.count(5), 0U) << "not labelled: no list";
}

TEST_F(Labels, WithOneCameraTheBoxIsTheLabels) {
    DriveCameras cameras = two_cameras();
    cameras.t_label_c = {0, 0, 0};
    const auto lists = detections_from_labels(read_labels(write("l.txt", kCar), {}), {3}, cameras);
    EXPECT_EQ(lists.at(3)[0].box.left, 500.0);
    EXPECT_EQ(lists.at(3)[0].box.bottom, 220.0);
}

TEST_F(Labels, CutEdgesStayAtTheBorder) {
    const auto labels = read_labels(write("l.txt", "3 1 Car 0.5 0 0 0 150 90 300 1.5 1.6 4.0 -7 1.65 8 -1.57\n"), {});
    EXPECT_EQ(detections_from_labels(labels, {3}, two_cameras()).at(3)[0].box.left, 0.0);
}

TEST_F(Labels, ClassesAreMappedAndDontCareIsLeftOut) {
    const auto labels = read_labels(write("l.txt",
                                          "3 1 Person_sitting 0 0 0 500 150 520 220 1.2 0.6 0.8 0 1.65 15 0\n"
                                          "3 2 Tram 0 0 0 600 100 700 220 3.5 2.5 12 2 1.65 30 0\n"
                                          "3 3 Unicorn 0 0 0 600 100 700 220 3.5 2.5 12 2 1.65 30 0\n" +
                                              kDontCare),
                                    {});
    const auto list = detections_from_labels(labels, {3}, two_cameras()).at(3);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0].object_class, ObjectClass::kPedestrian);
    EXPECT_EQ(list[0].viewpoint.horizontal, -1) << "people have no viewpoint";
    EXPECT_EQ(list[1].object_class, ObjectClass::kTram);
    EXPECT_GE(list[1].viewpoint.horizontal, 0);
}

// Scanner x forward, y left, z up -> camera x right, y down, z forward.
const std::string kMount = "calib_time: then\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0 -0.08 -0.27\n";
const std::string kRectify = "R_rect_00: 1 0 0 0 1 0 0 0 1\n";

std::string pose_item(double x, double y, double rz) {
    return "<item class_id=\"3\">\n<tx>" + std::to_string(x) + "</tx>\n<ty>" + std::to_string(y) +
           "</ty><tz>-1.73</tz><rx>0</rx><ry>0</ry><rz>" + std::to_string(rz) +
           "</rz>\n<state>2</state><occlusion>1</occlusion></item>\n";
}

std::string tracklets(const std::string& sizes, const std::string& poses) {
    return "<?xml version=\"1.0\"?>\n<!DOCTYPE boost_serialization>\n<boost_serialization version=\"9\">\n"
           "<tracklets class_id=\"0\">\n<count>1</count>\n<item_version>1</item_version>\n<item class_id=\"1\">\n"
           "<objectType>Van</objectType>\n" +
           sizes + "<first_frame>4</first_frame>\n<poses class_id=\"2\">\n<count>2</count>\n" + poses +
           "</poses>\n<finished>1</finished>\n</item>\n</tracklets>\n</boost_serialization>\n";
}

TEST_F(Labels, TrackletsBecomeLabelsOfCameraZero) {
    const Pose T = read_velodyne_mount(write("cam.txt", kRectify), write("velo.txt", kMount));
    const auto path =
        write("t.xml", tracklets("<h>2</h><w>1.9</w><l>5</l>\n",
                                 pose_item(20.27, 3, 0) + pose_item(-30, 0, 0) + pose_item(15.27, 0, 1.0)));
    const auto labels = read_tracklets(path, T, two_cameras());
    ASSERT_EQ(labels.size(), 2U) << "the second pose is behind the camera";
    EXPECT_EQ(labels[0].frame, 4);
    EXPECT_EQ(labels[1].frame, 6);
    EXPECT_EQ(labels[0].id, 0);
    EXPECT_EQ(labels[0].type, "Van");
    EXPECT_EQ(labels[0].occluded, 1);
    EXPECT_NEAR(labels[0].x, -3.0, 1e-9);
    EXPECT_NEAR(labels[0].y, 1.65, 1e-9);
    EXPECT_NEAR(labels[0].z, 20.0, 1e-9);
    EXPECT_NEAR(labels[0].rotation_y, -1.5707963267948966, 1e-9) << "driving ahead";
    EXPECT_NEAR(labels[1].rotation_y, -1.5707963267948966 - 1.0, 1e-9);
    const Box2d& box = labels[0].box;
    EXPECT_NEAR(box.bottom, 173 + 720 * 1.65 / 17.5, 0.1);
    EXPECT_NEAR(box.left, 610 + 720 * (-3.0 - 0.95 + 0.06) / 17.5, 0.1);
    EXPECT_EQ(labels[0].truncated, 0.0);
}

TEST_F(Labels, BrokenTrackletsAreRefusedByLine) {
    const Pose T = read_velodyne_mount(write("cam.txt", kRectify), write("velo.txt", kMount));
    const std::string sizes = "<h>2</h><w>1.9</w><l>5</l>\n";
    const auto refused = [&](const std::string& text, const std::string& part) {
        EXPECT_REFUSED(read_tracklets(write("t.xml", text), T, two_cameras()), part);
    };
    refused(tracklets("<h>2</h><w>x</w><l>5</l>\n", ""), "t.xml:9: 'x' is not");
    refused(tracklets("<h>2</h><l>5</l>\n", pose_item(20, 0, 0)), "no <w>");
    refused(tracklets("<h>2</h><w>0</w><l>5</l>\n", pose_item(20, 0, 0)), "positive sizes");
    refused(tracklets(sizes, "<item><tx>1</tx></item>"), "no <ty>");
    refused(tracklets(sizes, pose_item(20, 0, 0)).substr(0, 300), "ends inside");
    refused(tracklets(sizes, "</item>"), "without its begin");
    EXPECT_REFUSED(read_velodyne_mount(at("cam.txt"), write("velo.txt", "R: 1 0 0 0 1 0 0 0 1\n")), "no row T:");
    EXPECT_REFUSED(read_velodyne_mount(write("cam.txt", ""), at("velo.txt")), "cam.txt:1: ");
}

}  // namespace
}  // namespace semtrack::sil
