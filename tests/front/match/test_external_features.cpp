#include "front/match/external_features.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace semtrack {
namespace {

/// An image of 200 x 100 px whose right half belongs to owner 1.
class ExternalMatcherTest : public ::testing::Test {
protected:
    void SetUp() override {
        mask_->width = 200;
        mask_->height = 100;
        for (int y = 0; y < 100; ++y) {
            for (int x = 0; x < 200; ++x) {
                mask_->row(y)[x] = x < 100 ? 0 : 1;
            }
        }
        for (const std::size_t owner : {0U, 1U}) {
            priors_[owner].active = true;
            priors_[owner].budget = 20;
        }
        matcher_->reset();
    }
    static ExternalFeature feature(std::uint32_t id, float u, float v) { return {id, true, u, v, u - 10.0F, 0.5F}; }
    void run(const std::vector<ExternalFeature>& features) {
        in_->clear();
        for (const ExternalFeature& f : features) {
            ASSERT_TRUE(in_->try_push_back(f));
        }
        matcher_->process(*in_, *mask_, priors_, *out_);
    }

    std::unique_ptr<OwnerMask> mask_ = std::make_unique<OwnerMask>();
    OwnerPriors priors_{};
    std::unique_ptr<ExternalMatcher> matcher_ = std::make_unique<ExternalMatcher>();
    std::unique_ptr<ExternalFeatures> in_ = std::make_unique<ExternalFeatures>();
    std::unique_ptr<FrameFeatures> out_ = std::make_unique<FrameFeatures>();
};

TEST_F(ExternalMatcherTest, OwnersComeFromTheMaskAndRowsAreSortedByOwnerThenSlot) {
    run({feature(9, 150, 50), feature(7, 20, 20), feature(8, 180, 10), feature(3, 50, 5)});
    ASSERT_EQ(out_->size(), 4);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ((*out_)[i].owner, i < 2 ? 0 : 1);
        EXPECT_FALSE((*out_)[i].tracked);
        EXPECT_EQ((*out_)[i].slot, i % 2);
    }
    EXPECT_EQ((*out_)[0].u, 50.0F);  // new ones by their id
    EXPECT_EQ((*out_)[0].u_right, 40.0F);
}

TEST_F(ExternalMatcherTest, AFeatureKeepsSlotAndIdentityWhileItIsTracked) {
    run({feature(7, 20, 20), feature(9, 30, 20)});
    const std::uint32_t id = (*out_)[1].id;
    run({feature(9, 34, 21), feature(5, 60, 60)});
    ASSERT_EQ(out_->size(), 2);
    EXPECT_EQ((*out_)[0].u, 60.0F);  // the free slot of 7
    EXPECT_FALSE((*out_)[0].tracked);
    EXPECT_EQ((*out_)[1].id, id);
    EXPECT_EQ((*out_)[1].slot, 1);
    EXPECT_TRUE((*out_)[1].tracked);
    EXPECT_TRUE((*out_)[1].previous_stereo);
    EXPECT_EQ((*out_)[1].previous_u, 30.0F);
    EXPECT_EQ((*out_)[1].age, 1);
}

TEST_F(ExternalMatcherTest, AChangeOfOwnerOrARejectionEndsTheIdentity) {
    run({feature(7, 98, 20), feature(8, 10, 10)});
    const std::uint32_t first = (*out_)[0].id;
    const std::uint32_t second = (*out_)[1].id;
    matcher_->reject(0, (*out_)[1].slot);
    run({feature(7, 102, 20), feature(8, 12, 10)});
    ASSERT_EQ(out_->size(), 2);
    for (const FeatureMeasurement& m : *out_) {
        EXPECT_FALSE(m.tracked);
        EXPECT_NE(m.id, first);
        EXPECT_NE(m.id, second);
    }
}

TEST_F(ExternalMatcherTest, WhatCannotBeUsedIsLeftOut) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    ExternalFeature no_sigma = feature(4, 10, 10);
    no_sigma.sigma_px = 0.0F;
    run({feature(1, kNan, 5), feature(2, -1, 5), feature(3, 200, 5), no_sigma, feature(5, 5, 100),
         feature(6, 5, std::numeric_limits<float>::infinity()), feature(7, 30, 30), feature(7, 31, 31)});
    ASSERT_EQ(out_->size(), 1);  // the second with one id too
    EXPECT_EQ((*out_)[0].u, 30.0F);
}

TEST_F(ExternalMatcherTest, BudgetsHoldAndInactiveOwnersHaveNone) {
    std::vector<ExternalFeature> many;
    for (std::uint32_t i = 0; i < 90; ++i) {
        many.push_back(feature(i, static_cast<float>(i), 50));
    }
    run(many);
    EXPECT_EQ(out_->size(), 20);
    run(many);
    EXPECT_EQ(out_->size(), 20);
    EXPECT_TRUE((*out_)[0].tracked);
    priors_[0].active = false;
    run(many);
    EXPECT_TRUE(out_->empty());
    run({});
    EXPECT_TRUE(out_->empty());
}

}  // namespace
}  // namespace semtrack
