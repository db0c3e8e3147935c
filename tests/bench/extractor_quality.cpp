#include "tests/bench/extractor_quality.hpp"

#include <cmath>
#include <cstdio>

#include "front/feature/brief.hpp"
#include "front/feature/orb_extractor.hpp"
#include "hal/opencv/opencv_extractor.hpp"
#include "hal/opencv/plain_orb.hpp"
#include "math/camera.hpp"

namespace semtrack::bench {

namespace {

constexpr double kSamePlace_px = 2.0;
constexpr double kSameRow_px = 2.0;
constexpr double kSameDisparity_px = 1.5;
constexpr double kMostDisparity_px = 200.0;
constexpr int kThreshold = 10;

struct Share {
    int hits{0};
    int all{0};
    [[nodiscard]] double value() const { return all > 0 ? static_cast<double>(hits) / all : 0.0; }
};

bool has_keypoint_at(const Keypoints& points, const Point& p) {
    for (const Keypoint& k : points) {
        const double du = static_cast<double>(k.u) - p.u;
        const double dv = static_cast<double>(k.v) - p.v;
        if (du * du + dv * dv <= kSamePlace_px * kSamePlace_px) {
            return true;
        }
    }
    return false;
}

void count(const std::optional<Point>& place, const Keypoints& points, Share& share) {
    if (place) {
        ++share.all;
        share.hits += has_keypoint_at(points, *place) ? 1 : 0;
    }
}

std::vector<int> nearest(const Keypoints& from, const Keypoints& to) {
    std::vector<int> out;
    for (const Keypoint& a : from) {
        int best = -1;
        int least = 257;
        for (int i = 0; i < to.size(); ++i) {
            const int distance = hamming(a.descriptor, to[i].descriptor);
            if (distance < least) {
                least = distance;
                best = i;
            }
        }
        out.push_back(best);
    }
    return out;
}

void count_matches(const FramePair& pair, const Keypoints& left, const Keypoints& right, Share& share) {
    const std::vector<int> to_right = nearest(left, right);
    const std::vector<int> to_left = nearest(right, left);
    for (int i = 0; i < left.size(); ++i) {
        const int j = to_right[static_cast<std::size_t>(i)];
        if (j < 0 || to_left[static_cast<std::size_t>(j)] != i) {
            continue;
        }
        ++share.all;
        const Point l{static_cast<double>(left[i].u), static_cast<double>(left[i].v)};
        const Point r{static_cast<double>(right[j].u), static_cast<double>(right[j].v)};
        const double d = disparity(pair.calibration, l.u, r.u);
        const bool possible =
            d >= 0.0 && d <= kMostDisparity_px && std::fabs(r.v - right_row(pair.calibration, l.v, d)) <= kSameRow_px;
        share.hits += possible && pair.truth->same_in_right(l.u, l.v, r, kSameDisparity_px) ? 1 : 0;
    }
}

Share by_chance(const Keypoints& points, int width, int height) {
    Share share;
    for (int v = 20; v < height - 20; v += 4) {
        for (int u = 20; u < width - 20; u += 4) {
            count(Point{static_cast<double>(u), static_cast<double>(v)}, points, share);
        }
    }
    return share;
}

}  // namespace

Quality measure(const std::vector<FramePair>& pairs, const Extract& extract) {
    Share in_time;
    Share in_right;
    Share matches;
    double chance = 0.0;
    double features = 0.0;
    for (const FramePair& pair : pairs) {
        const auto left = extract(pair.left.view());
        const auto right = extract(pair.right.view());
        const auto next = extract(pair.next_left.view());
        features += (left->size() + right->size()) / 2.0;
        for (const Keypoint& k : *left) {
            const auto u = static_cast<double>(k.u);
            const auto v = static_cast<double>(k.v);
            count(pair.truth->in_right(u, v), *right, in_right);
            count(pair.truth->in_next(u, v), *next, in_time);
        }
        count_matches(pair, *left, *right, matches);
        chance += by_chance(*next, pair.left.width, pair.left.height).value();
    }
    const auto n = static_cast<double>(pairs.size());
    return {features / n,    in_time.value(),  in_right.value(), matches.value(),
            matches.all / n, matches.hits / n, chance / n};
}

std::string quality_head() {
    return "                                features  repeat in time  to the right  inlier ratio  matches  inliers"
           "  by chance\n";
}

std::string quality_line(const std::string& name, const Quality& q) {
    char text[200];
    (void)std::snprintf(text, sizeof text, "%-30s %9.1f %15.3f %13.3f %13.3f %8.1f %8.1f %10.3f\n", name.c_str(),
                        q.features, q.repeatability, q.repeatability_right, q.inlier_ratio, q.matches, q.inliers,
                        q.chance);
    return text;
}

namespace {

/// Everything is background: the whole image's best.
std::unique_ptr<Keypoints> whole_image(FeatureExtractor& extractor, int features, const ImageView& image) {
    const std::vector<std::uint8_t> owners(static_cast<std::size_t>(image.width) *
                                           static_cast<std::size_t>(image.height));
    FeatureBudget budget{};
    budget[0] = static_cast<std::int16_t>(features);
    auto out = std::make_unique<Keypoints>();
    if (extractor.extract(image, {owners.data(), image.width, image.height}, budget, *out) != Status::kOk) {
        out->clear();
    }
    return out;
}

}  // namespace

Extract own_orb(int features, int levels, Choice choice, bool upright) {
    OrbOptions options;
    options.levels = levels;
    options.upright = upright;
    options.spread = choice == Choice::kSpread;
    const auto orb = std::make_shared<OrbExtractor>(options);
    return [orb, features](const ImageView& image) { return whole_image(*orb, features, image); };
}

Extract cv_orb(int features, int levels, Choice choice) {
    if (choice == Choice::kSpread) {
        const auto orb = std::make_shared<OpenCvExtractor>(levels, kThreshold);
        return [orb, features](const ImageView& image) { return whole_image(*orb, features, image); };
    }
    const auto orb = std::make_shared<PlainOrb>(features, levels, kThreshold);
    return [orb](const ImageView& image) {
        orb->run(image);
        return orb->keypoints();
    };
}

}  // namespace semtrack::bench
