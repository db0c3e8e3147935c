// How good are an extractor's keypoints and descriptors? Two shares, summed over pairs of frames:
//
//   repeatability       of the keypoints of left frame k whose place in another image is known: the share that has a
//                       keypoint there within 2 px; the other image is left frame k + 1 (in time) or right frame k.
//   stereo inlier ratio of the pairs of left and right keypoints that are each other's nearest by descriptor, among all
//                       of both images: the share whose rows agree within 2 px (after the calibration's row offset),
//                       whose disparity is possible (0 to 200 px) and within 1.5 px of the truth.
//
// Points whose place is not known do not count for repeatability; a match whose place is not known is no inlier.
// matches, inliers: per pair of images. chance: the share of the next image that lies within 2 px of some keypoint,
// which a keypoint at a random place would reach. Only extractors that choose alike can be compared: strong corners
// come back more often than spread ones, whoever finds them.
#ifndef SEMTRACK_TESTS_BENCH_EXTRACTOR_QUALITY_HPP
#define SEMTRACK_TESTS_BENCH_EXTRACTOR_QUALITY_HPP

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "semtrack/hal/feature_extractor.hpp"
#include "tests/bench/pair_truth.hpp"

namespace semtrack::bench {

struct Quality {
    double features{0};  ///< per image
    double repeatability{0};
    double repeatability_right{0};
    double inlier_ratio{0};
    double matches{0};
    double inliers{0};
    double chance{0};
};

using Extract = std::function<std::unique_ptr<Keypoints>(const ImageView&)>;

[[nodiscard]] Quality measure(const std::vector<FramePair>& pairs, const Extract& extract);

/// One line of a table, and its head.
[[nodiscard]] std::string quality_head();
[[nodiscard]] std::string quality_line(const std::string& name, const Quality& q);

/// Which corners of the image are taken.
enum class Choice {
    kStrongest,  ///< wherever they are: cv::ORB as it comes
    kSpread      ///< over cells: what the tracker wants
};

/// The extractors that are compared: `features` of the whole image, scale 1.2, FAST threshold 10 unless given.
[[nodiscard]] Extract own_orb(int features, int levels, Choice choice, bool upright = false);
[[nodiscard]] Extract cv_orb(int features, int levels, Choice choice);

}  // namespace semtrack::bench

#endif
