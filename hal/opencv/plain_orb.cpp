#include "hal/opencv/plain_orb.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>
#include <vector>

#include "hal/opencv/opencv_headers.hpp"

namespace semtrack {

namespace {
constexpr float kScale = 1.2F;
constexpr int kPatch_px = 31;
}  // namespace

struct PlainOrb::Inside {
    cv::Ptr<cv::ORB> orb;
    std::vector<cv::KeyPoint> found;
    cv::Mat descriptors;
};

PlainOrb::PlainOrb(int features, int levels, int threshold) : inside_(std::make_unique<Inside>()) {
    cv::setNumThreads(1);
    inside_->orb =
        cv::ORB::create(features, kScale, levels, kPatch_px, 0, 2, cv::ORB::HARRIS_SCORE, kPatch_px, threshold);
}

PlainOrb::~PlainOrb() = default;

void PlainOrb::run(const ImageView& image) {
    // cv::Mat has no const form: the pixels are only read.
    const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                         static_cast<std::size_t>(image.stride));
    inside_->orb->detectAndCompute(pixels, cv::noArray(), inside_->found, inside_->descriptors);
}

std::unique_ptr<Keypoints> PlainOrb::keypoints() const {
    std::vector<Keypoint> all;
    for (std::size_t i = 0; i < inside_->found.size(); ++i) {
        const cv::KeyPoint& from = inside_->found[i];
        Keypoint k;
        k.u = from.pt.x;
        k.v = from.pt.y;
        k.level = static_cast<std::uint8_t>(from.octave);
        std::memcpy(k.descriptor.data(), inside_->descriptors.ptr<std::uint8_t>(static_cast<int>(i)),
                    sizeof(k.descriptor));
        all.push_back(k);
    }
    std::sort(all.begin(), all.end(), [](const Keypoint& a, const Keypoint& b) {
        return std::tie(a.v, a.u, a.level, a.descriptor) < std::tie(b.v, b.u, b.level, b.descriptor);
    });
    auto out = std::make_unique<Keypoints>();
    for (const Keypoint& k : all) {
        if (!out->try_push_back(k)) {
            break;
        }
    }
    return out;
}

}  // namespace semtrack
