// What every FeatureExtractor promises, checked on each that is built.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "front/feature/orb_extractor.hpp"
#include "math/rng.hpp"
#include "tests/hal/extractor/fake_hardware.hpp"
#ifdef SEMTRACK_HAS_OPENCV
#include "hal/opencv/opencv_extractor.hpp"
#endif

namespace semtrack {
namespace {

/// Blocks of random brightness with a little noise: corners everywhere, at several scales.
struct Picture {
    int width;
    int height;
    std::vector<std::uint8_t> pixels;
    std::vector<std::uint8_t> owners;
    Picture(int w, int h, std::uint32_t seed)
        : width(w),
          height(h),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)),
          owners(pixels.size()) {
        Rng rng(seed);
        std::vector<int> coarse(static_cast<std::size_t>((w / 23 + 1) * (h / 23 + 1)));
        std::vector<int> fine(static_cast<std::size_t>((w / 7 + 1) * (h / 7 + 1)));
        for (int& c : coarse) {
            c = rng.below(120);
        }
        for (int& c : fine) {
            c = rng.below(90);
        }
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                at(x, y) = static_cast<std::uint8_t>(coarse[static_cast<std::size_t>(y / 23 * (w / 23 + 1) + x / 23)] +
                                                     fine[static_cast<std::size_t>(y / 7 * (w / 7 + 1) + x / 7)] +
                                                     rng.below(6));
            }
        }
    }
    std::uint8_t& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    void own(int x0, int y0, int x1, int y1, std::uint8_t owner) {
        for (int y = y0; y < y1; ++y) {
            std::memset(owners.data() + static_cast<std::ptrdiff_t>(y) * width + x0, owner,
                        static_cast<std::size_t>(x1 - x0));
        }
    }
    [[nodiscard]] ImageView view() const { return {pixels.data(), width, height, width}; }
    [[nodiscard]] OwnerMaskView mask() const { return {owners.data(), width, height}; }
};

enum class Kind { kNative, kNativeTurned, kNativeStrongest, kNativeEightLevels, kNativeOneLevel, kHardware, kOpenCv };

class ExtractorConformance : public ::testing::TestWithParam<Kind> {
protected:
    void SetUp() override {
        OrbOptions options;
        options.upright = GetParam() != Kind::kNativeTurned;
        options.levels = GetParam() == Kind::kNativeEightLevels ? 8 : GetParam() == Kind::kNativeOneLevel ? 1 : 4;
        options.spread = GetParam() != Kind::kNativeStrongest;
        native_ = std::make_unique<OrbExtractor>(options);
        extractor_ = native_.get();
        if (GetParam() == Kind::kHardware) {
            extractor_ = &hardware_;
        }
#ifdef SEMTRACK_HAS_OPENCV
        if (GetParam() == Kind::kOpenCv) {
            opencv_ = std::make_unique<OpenCvExtractor>();
            extractor_ = opencv_.get();
        }
#endif
    }
    Status extract(const Picture& p, const FeatureBudget& budget) {
        return extractor_->extract(p.view(), p.mask(), budget, *out_);
    }
    static FeatureBudget budget(int background, int object) {
        FeatureBudget b{};
        b.fill(static_cast<std::int16_t>(object));
        b[0] = static_cast<std::int16_t>(background);
        return b;
    }
    [[nodiscard]] int count(int owner) const {
        int n = 0;
        for (const Keypoint& k : *out_) {
            n += k.owner == owner ? 1 : 0;
        }
        return n;
    }
    void expect_contract(const Picture& p, const FeatureBudget& b) const {
        std::vector<int> counts(kMaxOwners, 0);
        for (int i = 0; i < out_->size(); ++i) {
            const Keypoint& k = (*out_)[i];
            ASSERT_LT(k.owner, kMaxOwners);
            ++counts[k.owner];
            const int x = static_cast<int>(std::lround(k.u));
            const int y = static_cast<int>(std::lround(k.v));
            ASSERT_TRUE(x >= 0 && y >= 0 && x < p.width && y < p.height) << k.u << ' ' << k.v;
            EXPECT_EQ(p.mask().at(x, y), k.owner) << k.u << ' ' << k.v;
            if (i > 0) {
                const Keypoint& before = (*out_)[i - 1];
                EXPECT_LE(std::make_tuple(before.owner, before.v, before.u), std::make_tuple(k.owner, k.v, k.u));
            }
        }
        for (int o = 0; o < kMaxOwners; ++o) {
            EXPECT_LE(counts[static_cast<std::size_t>(o)], b[static_cast<std::size_t>(o)]) << o;
        }
    }
    static bool same(const Keypoint& a, const Keypoint& b) {
        return a.u == b.u && a.v == b.v && a.owner == b.owner && a.level == b.level && a.score == b.score &&
               a.descriptor == b.descriptor;
    }

    std::unique_ptr<OrbExtractor> native_;
    FakeHardwareExtractor hardware_;
#ifdef SEMTRACK_HAS_OPENCV
    std::unique_ptr<OpenCvExtractor> opencv_;
#endif
    FeatureExtractor* extractor_{nullptr};
    std::unique_ptr<Keypoints> out_ = std::make_unique<Keypoints>();
};

TEST_P(ExtractorConformance, FillsTheBudgetOfATexturedImageAndKeepsToIt) {
    Picture p(1242, 375, 1);
    p.own(200, 150, 400, 300, 1);
    p.own(660, 150, 860, 300, 7);
    p.own(900, 0, 1242, 375, kNoOwner);
    const FeatureBudget b = budget(500, 100);
    ASSERT_EQ(extract(p, b), Status::kOk);
    expect_contract(p, b);
    EXPECT_EQ(count(0), 500);
    EXPECT_EQ(count(1), 100);
    EXPECT_EQ(count(7), 100);
    EXPECT_EQ(out_->size(), 700);
}

TEST_P(ExtractorConformance, GivenNoBudgetForAnOwnerTakesNothingThere) {
    Picture p(640, 300, 2);
    p.own(0, 0, 320, 300, 3);
    FeatureBudget b{};
    b[3] = 40;
    ASSERT_EQ(extract(p, b), Status::kOk);
    expect_contract(p, b);
    EXPECT_EQ(out_->size(), 40);
    b[3] = -5;
    ASSERT_EQ(extract(p, b), Status::kOk);
    EXPECT_TRUE(out_->empty());
}

TEST_P(ExtractorConformance, SpreadsTheBackgroundOverTheImage) {
    const Picture p(1242, 375, 3);
    ASSERT_EQ(extract(p, budget(500, 0)), Status::kOk);
    int quarter[4] = {};
    for (const Keypoint& k : *out_) {
        ++quarter[(k.u > 621.0F ? 1 : 0) + (k.v > 187.0F ? 2 : 0)];
    }
    for (const int n : quarter) {
        EXPECT_GT(n, 80);
    }
}

TEST_P(ExtractorConformance, GivesTheSameForTheSameInputWhateverCameBefore) {
    const Picture p(800, 320, 4);
    const Picture other(600, 200, 5);
    const FeatureBudget b = budget(300, 50);
    ASSERT_EQ(extract(p, b), Status::kOk);
    const auto first = std::make_unique<Keypoints>(*out_);
    ASSERT_EQ(extract(other, b), Status::kOk);
    ASSERT_EQ(extract(p, b), Status::kOk);
    ASSERT_EQ(out_->size(), first->size());
    for (int i = 0; i < out_->size(); ++i) {
        ASSERT_TRUE(same((*out_)[i], (*first)[i])) << i;
    }
}

TEST_P(ExtractorConformance, DoesNotReadBetweenTheRowsOfAnImageWithStride) {
    const Picture p(500, 200, 6);
    const FeatureBudget b = budget(200, 0);
    ASSERT_EQ(extract(p, b), Status::kOk);
    const auto dense = std::make_unique<Keypoints>(*out_);
    std::vector<std::uint8_t> wide(static_cast<std::size_t>(640) * 200);
    Rng rng(9);
    for (std::uint8_t& x : wide) {
        x = static_cast<std::uint8_t>(rng.below(256));
    }
    for (int y = 0; y < 200; ++y) {
        std::memcpy(wide.data() + static_cast<std::ptrdiff_t>(y) * 640, p.view().row(y), 500);
    }
    ASSERT_EQ(extractor_->extract({wide.data(), 500, 200, 640}, p.mask(), b, *out_), Status::kOk);
    ASSERT_EQ(out_->size(), dense->size());
    for (int i = 0; i < out_->size(); ++i) {
        ASSERT_TRUE(same((*out_)[i], (*dense)[i])) << i;
    }
}

TEST_P(ExtractorConformance, FindsNothingInAConstantOrATinyImage) {
    Picture constant(640, 300, 1);
    std::fill(constant.pixels.begin(), constant.pixels.end(), std::uint8_t{128});
    EXPECT_EQ(extract(constant, budget(500, 100)), Status::kOk);
    EXPECT_TRUE(out_->empty());
    for (const auto& [w, h] : {std::pair{1, 1}, {7, 7}, {32, 32}, {640, 5}, {5, 300}}) {
        const Picture tiny(w, h, 8);
        EXPECT_EQ(extract(tiny, budget(500, 100)), Status::kOk) << w << 'x' << h;
        EXPECT_TRUE(out_->empty());
    }
    const Picture small(90, 80, 8);
    const FeatureBudget b = budget(500, 100);
    EXPECT_EQ(extract(small, b), Status::kOk);
    expect_contract(small, b);
}

TEST_P(ExtractorConformance, KeepsTheContractOnWhiteNoiseWithEveryOwnerAtItsCapacity) {
    Picture p(kMaxImageWidth, kMaxImageHeight, 11);
    Rng rng(12);
    for (std::uint8_t& x : p.pixels) {
        x = static_cast<std::uint8_t>(rng.below(256));
    }
    for (int o = 1; o < kMaxOwners; ++o) {
        const int x = (o - 1) % 8 * 156;
        const int y = (o - 1) / 8 * 96;
        p.own(x, y, x + 120, y + 80, static_cast<std::uint8_t>(o));
    }
    const FeatureBudget b = budget(kMaxBackgroundFeatures, kMaxObjectFeatures);
    ASSERT_EQ(extract(p, b), Status::kOk);
    expect_contract(p, b);
    EXPECT_GT(out_->size(), 2000);
    FeatureBudget beyond = budget(32767, 32767);
    ASSERT_EQ(extract(p, beyond), Status::kOk);
    EXPECT_LE(count(0), kMaxBackgroundFeatures);
    EXPECT_LE(count(5), kMaxObjectFeatures);
}

TEST_P(ExtractorConformance, GivenNoImageOrAMaskOfAnotherSizeRefusesAndEmptiesTheResult) {
    const Picture p(300, 200, 13);
    const FeatureBudget b = budget(100, 0);
    const auto fill = [&] {
        ASSERT_EQ(extract(p, b), Status::kOk);
        ASSERT_FALSE(out_->empty());
    };
    fill();
    EXPECT_EQ(extractor_->extract(ImageView{}, p.mask(), b, *out_), Status::kInvalidArgument);
    EXPECT_TRUE(out_->empty());
    fill();
    EXPECT_EQ(extractor_->extract(p.view(), {p.owners.data(), 299, 200}, b, *out_), Status::kInvalidArgument);
    EXPECT_TRUE(out_->empty());
    fill();
    EXPECT_EQ(extractor_->extract(p.view(), OwnerMaskView{}, b, *out_), Status::kInvalidArgument);
    EXPECT_TRUE(out_->empty());
}

TEST_P(ExtractorConformance, DescribesTheSamePatchAlikeWhereverItIs) {
    const Picture p(700, 300, 14);
    Picture moved(700, 300, 14);
    for (int y = 0; y < 300; ++y) {
        for (int x = 20; x < 700; ++x) {
            moved.at(x - 20, y) = p.pixels[static_cast<std::size_t>(y * 700 + x)];
        }
    }
    const FeatureBudget b = budget(400, 0);
    ASSERT_EQ(extract(p, b), Status::kOk);
    const auto first = std::make_unique<Keypoints>(*out_);
    ASSERT_EQ(extract(moved, b), Status::kOk);
    int found = 0;
    int alike = 0;
    for (const Keypoint& k : *first) {
        for (const Keypoint& m : *out_) {
            if (k.level == 0 && m.level == 0 && m.u == k.u - 20.0F && m.v == k.v && k.u > 60.0F) {
                ++found;
                alike += k.descriptor == m.descriptor ? 1 : 0;
            }
        }
    }
    EXPECT_GT(found, 30);
    EXPECT_EQ(alike, found);
}

std::string name_of(const ::testing::TestParamInfo<Kind>& info) {
    static const char* const kNames[] = {"Native",         "NativeTurned", "NativeStrongest", "NativeEightLevels",
                                         "NativeOneLevel", "Hardware",     "OpenCv"};
    return kNames[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Native, ExtractorConformance,
                         ::testing::Values(Kind::kNative, Kind::kNativeTurned, Kind::kNativeStrongest,
                                           Kind::kNativeEightLevels, Kind::kNativeOneLevel),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Hardware, ExtractorConformance, ::testing::Values(Kind::kHardware), name_of);
#ifdef SEMTRACK_HAS_OPENCV
INSTANTIATE_TEST_SUITE_P(Reference, ExtractorConformance, ::testing::Values(Kind::kOpenCv), name_of);
#endif

}  // namespace
}  // namespace semtrack
