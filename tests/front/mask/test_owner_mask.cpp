#include <gtest/gtest.h>

#include <memory>

#include "front/mask/owner_mask_builder.hpp"
#include "math/so3.hpp"

namespace semtrack {
namespace {

const PinholeCamera kCamera{721.5, 721.5, 609.6, 172.9};

MaskItem car(std::uint8_t owner, double x, double z, double theta = 0.4) {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    MaskItem item;
    item.owner = owner;
    item.has_box3d = true;
    item.T_c_o = {R_c_l * rot_z(theta), Vec3(x, 0.9, z)};
    item.size_m = Vec3(3.9, 1.6, 1.5);
    item.depth_m = z;
    return item;
}

class OwnerMaskTest : public testing::Test {
protected:
    std::unique_ptr<OwnerMaskBuilder> builder_ = std::make_unique<OwnerMaskBuilder>();
    std::unique_ptr<OwnerMask> mask_ = std::make_unique<OwnerMask>();
    MaskItems items_;
    MaskResults results_;
    void build() { builder_->build(kCamera, 1242, 375, items_, *mask_, results_); }
    int count(std::uint8_t owner) const {
        int n = 0;
        for (int y = 0; y < 375; ++y) {
            for (int x = 0; x < 1242; ++x) {
                n += mask_->at(x, y) == owner ? 1 : 0;
            }
        }
        return n;
    }
};

TEST_F(OwnerMaskTest, WithoutObjectsEverythingIsBackground) {
    build();
    EXPECT_EQ(count(0), 1242 * 375);
}

TEST_F(OwnerMaskTest, TheContourLiesInsideTheProjectedBoxAndTouchesIt) {
    ASSERT_TRUE(items_.try_push_back(car(3, 1.0, 15.0)));
    build();
    Box2d box;
    ASSERT_EQ(projected_box(kCamera, items_[0].T_c_o, items_[0].size_m, box), Status::kOk);
    int left = 2000;
    int bottom = 0;
    for (int y = 0; y < 375; ++y) {
        for (int x = 0; x < 1242; ++x) {
            if (mask_->at(x, y) != 3) {
                continue;
            }
            EXPECT_GE(x, box.left);
            EXPECT_LE(x, box.right);
            left = x < left ? x : left;
            bottom = y > bottom ? y : bottom;
        }
    }
    EXPECT_NEAR(left, box.left, 1.01);
    EXPECT_NEAR(bottom, box.bottom, 1.01);
    EXPECT_DOUBLE_EQ(results_[0].visible_share, 1.0);
    EXPECT_DOUBLE_EQ(results_[0].truncation, 0.0);
}

TEST_F(OwnerMaskTest, TheNearerObjectHidesTheFartherWhateverTheirOrder) {
    ASSERT_TRUE(items_.try_push_back(car(1, 0.5, 10.0)));
    ASSERT_TRUE(items_.try_push_back(car(2, 1.0, 20.0)));
    build();
    const double hidden = results_[1].visible_share;
    EXPECT_DOUBLE_EQ(results_[0].visible_share, 1.0);
    EXPECT_LT(hidden, 0.9);
    const int near_pixels = count(1);
    items_.clear();
    ASSERT_TRUE(items_.try_push_back(car(2, 1.0, 20.0)));
    ASSERT_TRUE(items_.try_push_back(car(1, 0.5, 10.0)));
    build();
    EXPECT_EQ(count(1), near_pixels);
    EXPECT_DOUBLE_EQ(results_[0].visible_share, hidden);
}

TEST_F(OwnerMaskTest, PixelsOfTheDetectionOutsideTheContourAreNobodys) {
    MaskItem item = car(1, 0.0, 15.0);
    ASSERT_EQ(projected_box(kCamera, item.T_c_o, item.size_m, item.box2d), Status::kOk);
    item.has_box2d = true;
    ASSERT_TRUE(items_.try_push_back(item));
    build();
    EXPECT_GT(count(kNoOwner), 100);
}

TEST_F(OwnerMaskTest, AnObjectBesideTheCameraIsCutAndOneBehindGetsNoPixel) {
    ASSERT_TRUE(items_.try_push_back(car(1, 2.5, 1.0, 0.0)));
    ASSERT_TRUE(items_.try_push_back(car(2, 2.5, -20.0, 0.0)));
    build();
    EXPECT_GT(results_[0].truncation, 0.3);
    EXPECT_GT(count(1), 1000);
    EXPECT_EQ(count(2), 0);
    EXPECT_DOUBLE_EQ(results_[1].visible_share, 0.0);
}

}  // namespace
}  // namespace semtrack
