#include "sil/world/export.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <fstream>
#include <sstream>

#include "sil/world/export_text.hpp"

namespace semtrack::sil {
namespace {

namespace fs = std::filesystem;

class WorldExport : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        out_ = fs::path(::testing::TempDir()) / (std::string("semtrack_export_") + info->name());
        fs::remove_all(out_);
    }
    void TearDown() override { fs::remove_all(out_); }

    [[nodiscard]] std::size_t rows(const fs::path& path) const {
        std::ifstream file(out_ / path);
        EXPECT_TRUE(file) << path;
        std::size_t n = 0;
        for (std::string line; std::getline(file, line);) {
            ++n;
        }
        return n;
    }
    [[nodiscard]] std::size_t columns(const fs::path& path) const {
        std::ifstream file(out_ / path);
        std::string line;
        std::getline(file, line);
        std::istringstream words(line);
        std::size_t n = 0;
        for (std::string word; words >> word;) {
            ++n;
        }
        return n;
    }

    fs::path out_;
    WorldSequence world_{"street", WorldOptions{2, false, 2}};
};

GreyImage read_png(const fs::path& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    GreyImage image;
    if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
        return image;
    }
    EXPECT_EQ(png.format & PNG_FORMAT_FLAG_COLOR, 0U);
    png.format = PNG_FORMAT_GRAY;
    image.width = static_cast<int>(png.width);
    image.height = static_cast<int>(png.height);
    image.pixels.resize(PNG_IMAGE_SIZE(png));
    EXPECT_NE(png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr), 0);
    return image;
}

TEST_F(WorldExport, RawHasImagesStampsCalibrationLabelsAndPoses) {
    const ExportedDrive d = export_world(world_, ExportLayout::kRaw, out_);
    EXPECT_EQ(d.id, "2026_01_01_drive_0001");
    const fs::path date = "2026_01_01";
    const fs::path sync = date / (d.id + "_sync");
    EXPECT_EQ(rows(date / "calib_cam_to_cam.txt"), 34U);
    EXPECT_EQ(rows(date / "calib_velo_to_cam.txt"), 5U);
    EXPECT_EQ(rows(date / "calib_imu_to_velo.txt"), 3U);
    for (const char* camera : {"image_00", "image_01"}) {
        EXPECT_EQ(rows(sync / camera / "timestamps.txt"), 2U);
        EXPECT_TRUE(fs::exists(out_ / sync / camera / "data" / "0000000001.png"));
    }
    for (const char* file : {"frames.txt", "times.txt", "poses.txt", "label_02/labelled_frames.txt"}) {
        EXPECT_EQ(rows(sync / file), 2U) << file;
    }
    EXPECT_EQ(columns(sync / "poses.txt"), 12U);
    EXPECT_EQ(rows(sync / "vehicle_motion.txt"), 2U);
    EXPECT_EQ(columns(sync / "vehicle_motion.txt"), 3U);
    EXPECT_EQ(rows(sync / "calib.txt"), 4U);
    EXPECT_EQ(rows(sync / "label_02" / "0001.txt"), world_.labels().size());
    EXPECT_EQ(columns(sync / "label_02" / "0001.txt"), 17U);
    EXPECT_TRUE(fs::exists(d.detections));
}

TEST_F(WorldExport, ImagesSurviveTheFileToTheLastBit) {
    const ExportedDrive d = export_world(world_, ExportLayout::kOdometry, out_);
    GreyImage left;
    GreyImage right;
    world_.render(1, left, right);
    const fs::path dir = out_ / "sequences" / d.id;
    EXPECT_EQ(read_png(dir / "image_0" / "000001.png").pixels, left.pixels);
    EXPECT_EQ(read_png(dir / "image_1" / "000001.png").pixels, right.pixels);
    EXPECT_EQ(rows("sequences/00/calib.txt"), 4U);
    EXPECT_EQ(rows("sequences/00/times.txt"), 2U);
    EXPECT_EQ(rows("poses/00.txt"), 2U);
}

TEST_F(WorldExport, TrackingHasLabelsViewpointsDetectionsAndEgoPoses) {
    const ExportedDrive d = export_world(world_, ExportLayout::kTracking, out_);
    EXPECT_TRUE(fs::exists(out_ / "training/image_02/0000/000000.png"));
    EXPECT_TRUE(fs::exists(out_ / "training/image_03/0000/000001.png"));
    EXPECT_EQ(rows("training/calib/0000.txt"), 7U);
    EXPECT_EQ(rows("training/label_02/0000.txt"), world_.labels().size());
    EXPECT_EQ(rows("training/labels_viewpoints/0000.txt"), world_.labels().size());
    EXPECT_EQ(columns("training/labels_viewpoints/0000.txt"), 4U);
    EXPECT_EQ(rows("training/ego_pose/0000.txt"), 2U);
    std::size_t detections = 0;
    for (const auto& [frame, list] : world_.label_detections()) {
        detections += list.empty() ? 1U : list.size();
    }
    EXPECT_EQ(rows("training/detections/0000.txt"), detections);
    EXPECT_EQ(columns("training/detections/0000.txt"), 9U);
}

TEST_F(WorldExport, AnEmptyListIsARowOfItsOwn) {
    const WorldSequence none("empty", WorldOptions{1, true, 1});
    EXPECT_EQ(world::detection_rows(none), "0 none 0 0 0 0 0 -1 -1\n");
    EXPECT_EQ(world::label_rows(none), "");
}

TEST_F(WorldExport, StampsAreATenthOfASecondApart) {
    EXPECT_EQ(world::time_stamps(world_), "2026-01-01 12:00:00.000000000\n2026-01-01 12:00:00.100000000\n");
}

TEST_F(WorldExport, RefusesUnknownLayoutsAndUnwritablePlaces) {
    EXPECT_EQ(export_layout("tracking"), ExportLayout::kTracking);
    EXPECT_THROW(static_cast<void>(export_layout("kitti")), InputError);
    std::ofstream(out_).put('x');  // a file where the folder should be
    EXPECT_THROW(export_world(world_, ExportLayout::kRaw, out_), std::runtime_error);
}

}  // namespace
}  // namespace semtrack::sil
