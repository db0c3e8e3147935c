// An object that the image border cuts, paper Sect. 4: with fewer than four edges of its own its 2D box goes to the
// right image; one whose four edges are seen goes there as its 3D box.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

#include "math/camera.hpp"
#include "model/box_geometry.hpp"
#include "semtrack/hal/feature_extractor.hpp"
#include "semtrack/tracker.hpp"
#include "support/aligned_pair.hpp"

namespace semtrack {
namespace {

constexpr int kWidth = 1242;
constexpr int kHeight = 375;

/// Keeps the masks that the tracker hands out: left, then right.
class MaskRecorder final : public FeatureExtractor {
public:
    Status extract(const ImageView& /*image*/, const OwnerMaskView& mask, const FeatureBudget& /*budget*/,
                   Keypoints& out) noexcept override {
        out.clear();
        masks.emplace_back(mask.data, mask.data + static_cast<std::ptrdiff_t>(mask.width) * mask.height);
        return Status::kOk;
    }
    std::vector<std::vector<std::uint8_t>> masks;
};

class TruncatedMasks : public testing::Test {
protected:
    void SetUp() override {
        Config config;
        config.matcher = MatcherKind::kOrb;
        ASSERT_EQ(tracker_->init(config, calibration_, &recorder_), Status::kOk);
    }
    void process(const Box2d& box, const Viewpoint& viewpoint) {
        Detection d;
        d.box = box;
        d.viewpoint = viewpoint;
        d.score = 0.95;
        DetectionList list;
        list.time_us = 100000 * ++frame_;
        ASSERT_TRUE(list.items.try_push_back(d));
        lists_.clear();
        ASSERT_TRUE(lists_.try_push_back(list));
        Input in;
        in.time_us = list.time_us;
        in.left = in.right = {pixels_.data(), kWidth, kHeight, kWidth};
        in.detections = &lists_;
        recorder_.masks.clear();
        ASSERT_EQ(tracker_->process(in, *output_), Status::kOk);
        ASSERT_EQ(recorder_.masks.size(), 2U);
    }
    /// Share of a rectangle's pixels that this owner has.
    [[nodiscard]] double share(int image, int left, int top, int right, int bottom, int owner = 1) const {
        int owned = 0;
        for (int v = top; v <= bottom; ++v) {
            for (int u = left; u <= right; ++u) {
                const std::uint8_t here =
                    recorder_.masks[static_cast<std::size_t>(image)][static_cast<std::size_t>(v * kWidth + u)];
                owned += here == owner ? 1 : 0;
            }
        }
        return static_cast<double>(owned) / ((bottom - top + 1) * (right - left + 1));
    }

    Calibration calibration_ = aligned_pair();
    MaskRecorder recorder_{};
    std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth) * kHeight, 90);
    StaticVector<DetectionList, kMaxDetectionLists> lists_{};
    std::unique_ptr<Tracker> tracker_ = std::make_unique<Tracker>();
    std::unique_ptr<Output> output_ = std::make_unique<Output>();
    std::int64_t frame_{0};
};

TEST_F(TruncatedMasks, ACarCutAtTheRightGivesItsWholeBoxMovedByItsDisparityToTheRightImage) {
    process({1000.0, 160.0, 1241.0, 330.0}, {5, 1});  // about 6.5 m ahead: 60 px of disparity
    EXPECT_GT(share(0, 1001, 161, 1240, 329), 0.3);
    EXPECT_EQ(share(0, 1001, 161, 1240, 329, 0), 0.0);  // what is not the object's is nobody's
    EXPECT_EQ(share(1, 960, 161, 1240, 329), 1.0);      // the object goes on behind the left image's border
    EXPECT_EQ(share(1, 0, 0, 850, 374), 0.0);
    EXPECT_EQ(share(1, 960, 0, 1241, 158), 0.0);
}

TEST_F(TruncatedMasks, ACarCutAtTheLeftMovesAwayFromTheBorderByItsDisparityAlone) {
    process({0.0, 160.0, 240.0, 330.0}, {3, 1});
    EXPECT_GT(share(0, 1, 161, 239, 329), 0.3);
    EXPECT_EQ(share(1, 0, 161, 170, 329), 1.0);
    EXPECT_EQ(share(1, 235, 0, 1241, 374), 0.0);
}

TEST_F(TruncatedMasks, ACarThatIsWhollySeenHasTheContourOfItsBoxAndNotARectangle) {
    process({700.0, 160.0, 860.0, 245.0}, {5, 1});
    const double left = share(0, 700, 160, 860, 245);
    EXPECT_GT(left, 0.5);
    EXPECT_LT(left, 0.97);  // the corners of its rectangle are nobody's
    EXPECT_GT(share(1, 665, 160, 825, 245), 0.5);
    EXPECT_LT(share(1, 830, 160, 860, 245), 0.3);
}

TEST(BoxCarriedToTheRight, HoldsTheObjectAtEveryDepthBetweenTheTwo) {
    Calibration c;
    c.width = kWidth;
    c.height = kHeight;
    c.left = {721.5, 721.5, 609.6, 172.9};
    c.right = {721.5, 721.5, 605.0, 173.4};  // other principal point, and rows that differ
    c.row_offset = {-0.3, 0.001, 0.004};
    c.baseline_m = 0.54;
    const Box2d box{500.0, 150.0, 620.0, 220.0};
    const Box2d right = carried_to_right(c, box, 8.0, 20.0);
    for (double z = 8.0; z <= 20.0; z += 0.5) {
        const double d = c.left.fx * c.baseline_m / z;
        EXPECT_LE(right.left, right_column(c, box.left, z) + 1e-9);
        EXPECT_GE(right.right, right_column(c, box.right, z) - 1e-9);
        EXPECT_LE(right.top, right_row(c, box.top, d) + 1e-9);
        EXPECT_GE(right.bottom, right_row(c, box.bottom, d) - 1e-9);
    }
    EXPECT_DOUBLE_EQ(right.left, right_column(c, box.left, 8.0));
    EXPECT_DOUBLE_EQ(right.right, right_column(c, box.right, 20.0));
    const Box2d cut = carried_to_right(c, {0.0, 150.0, 1241.0, 220.0}, 8.0, 20.0);
    EXPECT_EQ(cut.left, 0.0);
    EXPECT_EQ(cut.right, 1241.0);
}

}  // namespace
}  // namespace semtrack
