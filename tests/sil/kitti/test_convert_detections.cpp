#include "sil/kitti/convert_detections.hpp"

#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class Conversions : public TempFiles {
protected:
    [[nodiscard]] Detections read_back(const ConvertOptions& options) const {
        return read_detections(write("out.txt", converted_detections(options)), 1242, 375);
    }
    [[nodiscard]] ConvertOptions from(const std::string& format, const std::string& text) const {
        ConvertOptions o;
        o.format = format;
        o.in = write("in." + format, text);
        return o;
    }
};

TEST_F(Conversions, FramesWithoutRowsAreListsOfNothing) {
    const Detections d = read_back(from("rrc", "2,100,100,150,140,0.9\n0,10,100,60,140,0.8\n"));
    ASSERT_EQ(d.by_frame.size(), 3U);
    EXPECT_TRUE(d.by_frame.at(1).empty());
    EXPECT_EQ(d.by_frame.at(2).at(0).score, 0.9);
    EXPECT_EQ(d.by_frame.at(2).at(0).viewpoint.horizontal, -1);
}

TEST_F(Conversions, RrcBoxesTakeTheViewpointOfTheLabelTheyMeet) {
    ConvertOptions o = from("rrc", "0,100,100,150,140,0.9\n0,400,100,450,140,0.7\n");
    o.labels = write("label.txt", "0 3 Car 0 0 0 102 100 152 140 1.5 1.6 3.9 1 1.6 20 0\n");
    o.labels_viewpoints = write("view.txt", "0 3 5 1\n");
    const Detections d = read_back(o);
    EXPECT_EQ(d.by_frame.at(0).at(0).viewpoint.horizontal, 5);
    EXPECT_EQ(d.by_frame.at(0).at(0).viewpoint.vertical, 1);
    EXPECT_EQ(d.by_frame.at(0).at(1).viewpoint.horizontal, -1);
    o.viewpoints = false;
    EXPECT_EQ(read_back(o).by_frame.at(0).at(0).viewpoint.horizontal, -1);
}

TEST_F(Conversions, RowsWithAClassUseCocosNumbersFromZero) {
    const Detections d =
        read_back(from("rrc", "0,2,100,100,150,140,0.9\n0,0,200,100,220,140,0.8\n0,62,300,1,320,40,1\n"));
    ASSERT_EQ(d.by_frame.at(0).size(), 2U);
    EXPECT_EQ(d.by_frame.at(0)[0].object_class, ObjectClass::kCar);
    EXPECT_EQ(d.by_frame.at(0)[1].object_class, ObjectClass::kPedestrian);
}

TEST_F(Conversions, PointRcnnRowsTakeTheViewpointOfTheirOwnAngle) {
    const Detections d = read_back(from("pointrcnn",
                                        "0,2,786,180,1241,374,12.2,1.52,1.68,4.45,2.93,1.61,6.43,-1.58,-2.01\n"
                                        "0,1,100,100,120,160,-0.5,1.7,0.6,0.8,-5,1.6,20,0.3,0.5\n"));
    const std::vector<Detection>& list = d.by_frame.at(0);
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0].object_class, ObjectClass::kCar);
    EXPECT_EQ(list[0].viewpoint.horizontal, 5);  // rear and left: driving away on our right
    EXPECT_EQ(list[0].viewpoint.vertical, 1);
    EXPECT_EQ(list[1].viewpoint.horizontal, -1);
    EXPECT_GT(list[0].score, 0.9);
    EXPECT_GT(list[1].score, 0.0);
    EXPECT_LT(list[1].score, 0.5);
}

TEST_F(Conversions, KittiResultsWithAlphaAloneGetItsClass) {
    // alpha -pi/2: driving away straight ahead; no 3D place, no size.
    const std::string no_place = " -1 -1 -1 -1000 -1000 -1000 -10 0.8\n";
    const Detections d = read_back(from(
        "kitti", "0 1 Car -1 -1 -1.5708 600 150 660 200" + no_place + "0 2 Car -1 -1 -10 300 150 360 200" + no_place));
    ASSERT_EQ(d.by_frame.at(0).size(), 2U);
    EXPECT_EQ(d.by_frame.at(0)[0].viewpoint.horizontal, 6);
    EXPECT_EQ(d.by_frame.at(0)[1].viewpoint.horizontal, -1);
}

TEST_F(Conversions, AFolderOfFramesAsInTheObjectBenchmark) {
    const std::string row = "Car 0 0 -1.57 600 150 660 200 1.5 1.6 3.9 0.5 1.65 20 -1.55 0.8\n";
    (void)write("results/000003.txt", row);
    (void)write("results/000001.txt", "");
    (void)write("results/notes.txt", "no");
    ConvertOptions o;
    o.format = "kitti";
    o.in = at("results");
    const Detections d = read_back(o);
    EXPECT_EQ(d.by_frame.size(), 4U);
    EXPECT_TRUE(d.by_frame.at(1).empty());
    EXPECT_EQ(d.by_frame.at(3).at(0).viewpoint.horizontal, 6);
}

TEST_F(Conversions, CocoBoxesAreCornersAndSizes) {
    const Detections d =
        read_back(from("coco", R"([{"image_id": 1, "category_id": 3, "bbox": [10, 20, 30, 40], "score": 0.5},
                         {"image_id": "000002.png", "category_id": 1, "bbox": [10, 20, 30, 40], "score": 0.25},
                         {"image_id": 2, "category_id": 44, "bbox": [1, 2, 3, 4], "score": 0.9}])"));
    ASSERT_EQ(d.by_frame.at(2).size(), 1U);
    EXPECT_EQ(d.by_frame.at(1).at(0).box.right, 40.0);
    EXPECT_EQ(d.by_frame.at(1).at(0).box.bottom, 60.0);
    EXPECT_EQ(d.by_frame.at(2)[0].object_class, ObjectClass::kPedestrian);
}

TEST_F(Conversions, WhatCannotBeReadIsRefusedByFileAndPlace) {
    EXPECT_REFUSED(converted_detections(from("rrc", "0,1,2,3,4\n")), "in.rrc:1");
    EXPECT_REFUSED(converted_detections(from("rrc", "0,1,2,x,4,5\n")), "in.rrc:1");
    EXPECT_REFUSED(converted_detections(from("pointrcnn", "0,9,1,2,3,4,1,1,1,1,1,1,1,1,1\n")), "in.pointrcnn:1");
    EXPECT_REFUSED(converted_detections(from("kitti", "0 1 Ship 0 0 0 1 2 3 4 1 1 1 1 1 1 1\n")), "Ship");
    EXPECT_REFUSED(converted_detections(from("coco", R"([{"image_id": 1}])")), "detection 0");
    EXPECT_REFUSED(converted_detections(from("voc", "")), "voc");
}

}  // namespace
}  // namespace semtrack::sil
