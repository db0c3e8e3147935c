// The library's own ORB is at least as good as cv::ORB: as many features on the same levels, chosen alike, descriptors
// turned. What is measured is defined in extractor_quality.hpp; time is the benchmark's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/bench/extractor_quality.hpp"

namespace semtrack::bench {
namespace {

constexpr int kFeatures = 500;

void expect_as_good_as_opencv(const std::vector<FramePair>& pairs, Choice choice) {
    for (const int levels : {8, 4}) {
        const Quality own = measure(pairs, own_orb(kFeatures, levels, choice));
        const Quality cv = measure(pairs, cv_orb(kFeatures, levels, choice));
        const std::string table = std::to_string(levels) + " levels\n" + quality_head() + quality_line("own", own) +
                                  quality_line("cv::ORB", cv);
        EXPECT_GE(own.features, 0.99 * cv.features) << table;
        EXPECT_LE(own.features, kFeatures) << table;
        EXPECT_GE(own.repeatability, cv.repeatability) << table;
        EXPECT_GE(own.inlier_ratio, cv.inlier_ratio) << table;
    }
}

class ExtractorQuality : public testing::TestWithParam<Choice> {};

TEST_P(ExtractorQuality, OnRenderedFramesTheOwnOrbRepeatsAndMatchesAtLeastAsWellAsOpenCvs) {
    expect_as_good_as_opencv(rendered_pairs("street", {0, 20, 40}), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Chosen, ExtractorQuality, testing::Values(Choice::kStrongest, Choice::kSpread),
                         [](const auto& choice) { return choice.param == Choice::kSpread ? "Spread" : "Strongest"; });

void on_the_drive(Choice choice) {
    const char* const root = std::getenv("SEMTRACK_KITTI");
    if (root == nullptr || *root == '\0') {
        GTEST_SKIP() << "SEMTRACK_KITTI is not set";
    }
    expect_as_good_as_opencv(drive_pairs(root, {25, 60, 100, 140, 180, 220, 260, 300}), choice);
}

TEST(KittiData, OnARealDriveTheOwnOrbsStrongestCornersRepeatAndMatchAtLeastAsWellAsOpenCvs) {
    on_the_drive(Choice::kStrongest);
}

TEST(KittiData, OnARealDriveTheOwnOrbsSpreadCornersRepeatAndMatchAtLeastAsWellAsOpenCvs) {
    on_the_drive(Choice::kSpread);
}

}  // namespace
}  // namespace semtrack::bench
