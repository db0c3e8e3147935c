#include "sil/kitti/detection_file.hpp"

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class DetectionFiles : public TempFiles {
protected:
    [[nodiscard]] Detections read(const std::string& text) const {
        return read_detections(write("d.txt", text), 1242, 375);
    }
    void expect_refused(const std::string& text, const std::string& where) const {
        EXPECT_REFUSED(read_detections(write("d.txt", text), 1242, 375), at("d.txt").string() + where);
    }
};

const std::string kCar = "5 Car 0.9 100 120 200 180 5 1\n";

TEST_F(DetectionFiles, RowsBecomeListsByFrame) {
    const Detections d = read(kCar + "7 Pedestrian 0.5 10.5 20 30 90 -1 -1\n5 Van 0.8 300 120 400 180 0 0\n");
    ASSERT_EQ(d.by_frame.size(), 2U);
    ASSERT_EQ(d.by_frame.at(5).size(), 2U);
    EXPECT_EQ(d.by_frame.at(5)[0].object_class, ObjectClass::kCar);
    EXPECT_EQ(d.by_frame.at(5)[0].viewpoint.horizontal, 5);
    EXPECT_EQ(d.by_frame.at(5)[1].object_class, ObjectClass::kVan);
    EXPECT_EQ(d.by_frame.at(7)[0].box.left, 10.5);
    EXPECT_EQ(d.by_frame.at(7)[0].viewpoint.horizontal, -1);
    EXPECT_EQ(d.dropped, 0);
}

TEST_F(DetectionFiles, NothingSeenIsNotTheSameAsNoAnswer) {
    const Detections d = read("4 none 0 0 0 0 0 -1 -1\n6 Car 0.9 100 120 200 180 5 1\n6 none 0 0 0 0 0 -1 -1\n");
    EXPECT_TRUE(d.by_frame.at(4).empty());
    EXPECT_EQ(d.by_frame.count(5), 0U);
    EXPECT_EQ(d.by_frame.at(6).size(), 1U);
    EXPECT_TRUE(read("").by_frame.empty());
}

TEST_F(DetectionFiles, NonsenseIsRefusedByLine) {
    expect_refused(kCar + "5 Lorry 0.9 100 120 200 180 5 1\n", ":2: unknown class 'Lorry'");
    expect_refused(kCar + "5 DontCare 0.9 100 120 200 180 5 1\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 left 200 180 5 1\n", ":2: 'left'");
    expect_refused(kCar + "5 Car nan 100 120 200 180 5 1\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 inf 200 180 5 1\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 120 200 180 8 1\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 120 200 180 5 2\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 120 200 180 -1 1\n", ":2: ");
    expect_refused(kCar + "5 Car 0.9 100 120 200 180 5\n", ":2: ");
    expect_refused(kCar + "5.5 Car 0.9 100 120 200 180 5 1\n", ":2: ");
    expect_refused("frame class score left top right bottom h v\n" + kCar, ":1: ");
    expect_refused("5 none 0 0 0 0 x -1 -1\n", ":1: ");
    EXPECT_REFUSED(read_detections(at("missing.txt"), 10, 10), "missing.txt");
}

TEST_F(DetectionFiles, OddBoxesAreDroppedAndCountedByKind) {
    const Detections d =
        read(kCar + kCar + "5 Car 0.7 300 120 300 180 5 1\n5 Car 0.7 400 120 300 180 5 1\n" +
             "5 Car 0.7 300 180 400 120 5 1\n5 Car 0.7 -90 10 -10 50 5 1\n5 Car 0.7 10 380 60 400 5 1\n" +
             "5 Car 0.1 1241 10 1300 50 5 1\n-1 Car 0.7 10 10 60 60 5 1\n" +
             "1000000000 Car 0.7 10 10 60 60 5 1\n5 Van 0.2 100 120 200 180 5 1\n");
    ASSERT_EQ(d.by_frame.size(), 1U);
    EXPECT_EQ(d.by_frame.at(5).size(), 2U) << "the car once, and a van on the same object";
    EXPECT_EQ(d.counters.doubled, 1);
    EXPECT_EQ(d.counters.inverted, 3);
    EXPECT_EQ(d.counters.outside, 3);
    EXPECT_EQ(d.dropped, 7);
    EXPECT_EQ(d.bad_frames, 2);
}

TEST_F(DetectionFiles, BoxesAcrossTheBorderAreClipped) {
    const Detections d = read("5 Car 0.9 -20 -5 1500 400 5 1\n");
    const Box2d& box = d.by_frame.at(5).at(0).box;
    EXPECT_EQ(box.left, 0.0);
    EXPECT_EQ(box.top, 0.0);
    EXPECT_EQ(box.right, 1241.0);
    EXPECT_EQ(box.bottom, 374.0);
    EXPECT_EQ(d.counters.clipped, 1);
    EXPECT_EQ(d.dropped, 0);
}

TEST_F(DetectionFiles, AnOverfullListIsWholeWithTheHighestScoresFirst) {
    std::string text;
    for (int i = 0; i < kMaxDetections + 3; ++i) {
        text += "5 Car " + std::to_string(0.001 * i) + " " + std::to_string(i) + " 10 " + std::to_string(i + 50) +
                " 60 -1 -1\n";
    }
    const Detections d = read(text);
    ASSERT_EQ(d.by_frame.at(5).size(), static_cast<std::size_t>(kMaxDetections) + 3U);
    EXPECT_EQ(d.dropped, 0);
    EXPECT_EQ(d.by_frame.at(5).front().box.left, kMaxDetections + 2.0);
    EXPECT_EQ(d.by_frame.at(5).back().box.left, 0.0);
}

TEST_F(DetectionFiles, AListWhoseRowsAreAllDroppedIsEmpty) {
    const Detections d = read("5 Car 0.9 200 120 100 180 5 1\n");
    EXPECT_TRUE(d.by_frame.at(5).empty());
}

TEST(DetectionClasses, NamesGoBothWays) {
    for (int i = 0; i < kObjectClasses; ++i) {
        const auto c = static_cast<ObjectClass>(i);
        ObjectClass back = ObjectClass::kMisc;
        ASSERT_TRUE(class_from_name(class_name(c), back));
        EXPECT_EQ(back, c);
    }
    ObjectClass untouched = ObjectClass::kTram;
    EXPECT_FALSE(class_from_name("car", untouched));
    EXPECT_EQ(untouched, ObjectClass::kTram);
}

}  // namespace
}  // namespace semtrack::sil
