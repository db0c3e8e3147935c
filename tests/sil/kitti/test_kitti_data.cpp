// The development drives, where the environment says they are. Figures are properties of the data.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/kitti_sequence.hpp"
#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class KittiData : public testing::Test {
protected:
    void SetUp() override {
        const char* root = std::getenv("SEMTRACK_KITTI");
        if (root == nullptr || *root == 0) {
            GTEST_SKIP() << "SEMTRACK_KITTI is not set";
        }
        root_ = root;
    }
    [[nodiscard]] SequenceOptions options(const std::string& layout, const std::string& id) const {
        SequenceOptions o;
        o.layout = layout;
        o.root = root_ / layout;
        o.sequence = id;
        return o;
    }
    std::filesystem::path root_;
};

TEST_F(KittiData, RawDriveHasItsPairsLabelsAndCalibration) {
    auto s = open_kitti_sequence(options("raw", "2011_09_26_drive_0039"));
    EXPECT_EQ(s->first_frame(), 19);
    EXPECT_EQ(s->last_frame(), 330);
    int pairs = 0;
    GreyImage left;
    GreyImage right;
    for (int n = 19; n <= 330; ++n) {
        s->load(n, left, right);
        pairs += !left.empty() && !right.empty() ? 1 : 0;
    }
    EXPECT_EQ(pairs, 312);
    EXPECT_EQ(left.width, 1242);
    EXPECT_EQ(left.height, 375);
    EXPECT_EQ(s->labelled_frames().size(), 155U);
    EXPECT_EQ(s->label_detections().size(), 155U);
    EXPECT_EQ(s->ego_truth().size(), 312U);
    EXPECT_NEAR(s->cameras().calibration.left.fx, 721.5377, 1e-9);
    EXPECT_NEAR(s->cameras().calibration.baseline_m, 387.5744 / 721.5377, 1e-9);
    EXPECT_NEAR(s->cameras().t_label_c[0], 0.05985, 1e-4);
    for (int n = 20; n <= 330; ++n) {
        EXPECT_NEAR(static_cast<double>(s->time_us(n) - s->time_us(n - 1)), 103600.0, 10000.0);
    }
}

TEST_F(KittiData, LabelBoxesMovedToCameraZeroAreTheIdealDetections) {
    const SequenceOptions o = options("raw", "2011_09_26_drive_0039");
    const auto s = open_kitti_sequence(o);
    const Detections ideal =
        read_detections(o.root / "2011_09_26/2011_09_26_drive_0039_sync/detections/ideal.txt", 1242, 375);
    std::vector<double> worst_edge;
    int wrong_view = 0;
    for (const auto& [frame, list] : s->label_detections()) {
        const std::vector<Detection>& theirs = ideal.by_frame.at(frame);
        EXPECT_EQ(theirs.size(), list.size());
        for (const Detection& d : list) {
            double best = 1e9;
            Viewpoint view;
            for (const Detection& e : theirs) {
                const double off =
                    std::max({std::fabs(d.box.left - e.box.left), std::fabs(d.box.top - e.box.top),
                              std::fabs(d.box.right - e.box.right), std::fabs(d.box.bottom - e.box.bottom)});
                view = off < best ? e.viewpoint : view;
                best = std::min(off, best);
            }
            worst_edge.push_back(best);
            wrong_view += view.horizontal == d.viewpoint.horizontal && view.vertical == d.viewpoint.vertical ? 0 : 1;
        }
    }
    std::sort(worst_edge.begin(), worst_edge.end());
    ASSERT_GT(worst_edge.size(), 800U);
    EXPECT_LT(worst_edge[worst_edge.size() / 2], 0.006);  // the file has two decimals
    EXPECT_LT(worst_edge[worst_edge.size() * 97 / 100], 0.05);
    EXPECT_EQ(wrong_view, 0);
}

TEST_F(KittiData, OdometryDriveHasItsPairsAndTruth) {
    auto s = open_kitti_sequence(options("odometry", "06"));
    EXPECT_EQ(s->first_frame(), 0);
    EXPECT_EQ(s->last_frame(), 50);
    EXPECT_EQ(s->cameras().calibration.width, 1226);
    EXPECT_EQ(s->cameras().calibration.height, 370);
    EXPECT_NEAR(s->cameras().calibration.left.fx, 707.0912, 1e-9);
    EXPECT_EQ(s->ego_truth().size(), 51U);
    EXPECT_EQ(s->time_us(0), 0);
    EXPECT_EQ(s->label_detections().size(), 0U);
}

TEST_F(KittiData, TrackingDriveHasItsColourPairs) {
    SequenceOptions o = options("tracking", "0010");
    auto s = open_kitti_sequence(o);
    EXPECT_EQ(s->first_frame(), 0);
    EXPECT_EQ(s->last_frame(), 20);
    GreyImage left;
    GreyImage right;
    int pairs = 0;
    for (int n = 0; n <= 20; ++n) {
        s->load(n, left, right);
        pairs += !left.empty() && !right.empty() ? 1 : 0;
    }
    EXPECT_EQ(pairs, 21);
    EXPECT_NEAR(s->cameras().calibration.baseline_m, 0.5327, 1e-3);
    EXPECT_NEAR(s->cameras().t_c0_c[0], -0.0598, 1e-3);
    EXPECT_GT(s->label_detections().at(0).size(), 1U);
    o.calib = root_ / "tracking/training/calib_fitted/0010.txt";
    EXPECT_NEAR(open_kitti_sequence(o)->cameras().calibration.right.cx - s->cameras().calibration.right.cx, 0.8, 0.05);
}

TEST_F(KittiData, EveryTrackingSequenceReadsWithoutImages) {
    int read = 0;
    for (const int n : {1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13}) {
        SequenceOptions o = options("tracking", (n < 10 ? "000" : "00") + std::to_string(n));
        o.images = false;
        const auto s = open_kitti_sequence(o);
        read += s->last_frame() + 1;
        EXPECT_EQ(s->ego_truth().size(), static_cast<std::size_t>(s->last_frame() + 1));
    }
    EXPECT_EQ(read, 3983);
}

}  // namespace
}  // namespace semtrack::sil
