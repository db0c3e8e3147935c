#include "hal/opencv/opencv_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>
#include <vector>

#include "hal/opencv/opencv_headers.hpp"

namespace semtrack {

namespace {

constexpr float kScale = 1.2F;
constexpr int kPatch_px = 31;
constexpr int kMinCandidates = 2000;  // cv::ORB keeps the strongest of the image: objects need more than their share
constexpr int kCandidatesPerFeature = 4;
constexpr int kMaxRounds = 8;
constexpr double kScorePerResponse = 1e8;  // Harris responses are below 0.1

using Found = std::vector<cv::KeyPoint>;

int owner_at(const OwnerMaskView& mask, const cv::Point2f& p) {
    const int x = static_cast<int>(std::lround(p.x));
    const int y = static_cast<int>(std::lround(p.y));
    return x < 0 || y < 0 || x >= mask.width || y >= mask.height ? kNoOwner : mask.at(x, y);
}

std::int32_t score_of(const cv::KeyPoint& k) {
    const double score = kScorePerResponse * static_cast<double>(k.response);
    return static_cast<std::int32_t>(std::lround(std::clamp(score, 0.0, 2e9)));
}

bool stronger(const cv::KeyPoint& a, const cv::KeyPoint& b) {
    return std::make_tuple(-a.response, a.pt.y, a.pt.x, a.octave) <
           std::make_tuple(-b.response, b.pt.y, b.pt.x, b.octave);
}

// In rounds: the best of every cell, then the second best, ...
void choose(Found& candidates, int owner, int budget, int width, Found& chosen) {
    std::sort(candidates.begin(), candidates.end(), stronger);
    const int cell_px = owner == 0 ? 32 : 8;
    const int columns = width / cell_px + 1;
    std::map<int, int> filled;
    std::vector<bool> taken(candidates.size(), false);
    int count = 0;
    for (int round = 1; round <= kMaxRounds; ++round) {
        for (std::size_t i = 0; i < candidates.size() && count < budget; ++i) {
            const cv::Point2f& p = candidates[i].pt;
            int& n = filled[static_cast<int>(p.y) / cell_px * columns + static_cast<int>(p.x) / cell_px];
            if (!taken[i] && n < round) {
                taken[i] = true;
                ++n;
                ++count;
                chosen.push_back(candidates[i]);
                chosen.back().class_id = owner;
            }
        }
    }
}

Keypoint to_keypoint(const cv::KeyPoint& from, const std::uint8_t* descriptor) {
    Keypoint to;
    to.u = from.pt.x;
    to.v = from.pt.y;
    to.owner = static_cast<std::uint8_t>(from.class_id);
    to.level = static_cast<std::uint8_t>(from.octave);
    to.score = score_of(from);
    for (std::size_t w = 0; w < to.descriptor.size(); ++w) {
        to.descriptor[w] = 0;
        for (std::size_t b = 0; b < 4; ++b) {
            to.descriptor[w] |= static_cast<std::uint32_t>(descriptor[4 * w + b]) << (8 * b);
        }
    }
    return to;
}

}  // namespace

struct OpenCvExtractor::Inside {
    cv::Ptr<cv::ORB> orb;
};

OpenCvExtractor::OpenCvExtractor(int levels, int threshold) : inside_(std::make_unique<Inside>()) {
    cv::setNumThreads(1);
    inside_->orb =
        cv::ORB::create(kMinCandidates, kScale, levels, kPatch_px, 0, 2, cv::ORB::HARRIS_SCORE, kPatch_px, threshold);
}

OpenCvExtractor::~OpenCvExtractor() = default;

Status OpenCvExtractor::extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                                Keypoints& out) noexcept {
    out.clear();
    if (image.empty() || image.width <= 0 || image.height <= 0 || image.stride < image.width || mask.data == nullptr ||
        mask.width != image.width || mask.height != image.height) {
        return Status::kInvalidArgument;
    }
    int wanted = 0;
    FeatureBudget most{};
    for (std::size_t o = 0; o < budget.size(); ++o) {
        const int slots = o == 0 ? kMaxBackgroundFeatures : kMaxObjectFeatures;
        most[o] = static_cast<std::int16_t>(std::clamp<int>(budget[o], 0, slots));
        wanted += most[o];
    }
    if (wanted == 0 || std::min(image.width, image.height) <= 2 * kPatch_px) {
        return Status::kOk;
    }
    try {
        // cv::Mat has no const form: the pixels are only read.
        const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                             static_cast<std::size_t>(image.stride));
        inside_->orb->setMaxFeatures(std::max(kMinCandidates, kCandidatesPerFeature * wanted));
        Found everywhere;
        inside_->orb->detect(pixels, everywhere);
        std::array<Found, static_cast<std::size_t>(kMaxOwners)> by_owner;
        for (const cv::KeyPoint& k : everywhere) {
            const int owner = owner_at(mask, k.pt);
            if (owner < kMaxOwners) {
                by_owner[static_cast<std::size_t>(owner)].push_back(k);
            }
        }
        Found chosen;
        for (int o = 0; o < kMaxOwners; ++o) {
            choose(by_owner[static_cast<std::size_t>(o)], o, most[static_cast<std::size_t>(o)], image.width, chosen);
        }
        cv::Mat descriptors;
        if (!chosen.empty()) {
            inside_->orb->compute(pixels, chosen, descriptors);
        }
        std::vector<Keypoint> described;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            described.push_back(to_keypoint(chosen[i], descriptors.ptr<std::uint8_t>(static_cast<int>(i))));
        }
        std::sort(described.begin(), described.end(), [](const Keypoint& a, const Keypoint& b) {
            return std::tie(a.owner, a.v, a.u, a.level, a.descriptor) <
                   std::tie(b.owner, b.v, b.u, b.level, b.descriptor);
        });
        for (const Keypoint& k : described) {
            if (!out.try_push_back(k)) {
                break;
            }
        }
    } catch (const std::exception&) {
        out.clear();
        return Status::kNotObservable;
    }
    return Status::kOk;
}

}  // namespace semtrack
