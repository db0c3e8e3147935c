// Worst case of the front end with the patch matcher: white noise in both images, new in every frame, nine owners with
// full budgets. Nothing can be followed, so every corner is searched along its whole row in every frame.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <vector>

#include "front/mask/owner_mask_builder.hpp"
#include "front/match/patch_matcher.hpp"
#include "front/ransac/reject.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"
#include "support/aligned_pair.hpp"

namespace semtrack::bench {
namespace {

constexpr int kWidth = 1242;
constexpr int kHeight = 375;
constexpr int kFrames = 12;
constexpr int kObjects = 9;
constexpr int kRuns = 5;

std::vector<std::uint8_t> noise(Rng& rng) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kWidth) * kHeight);
    for (std::uint8_t& p : pixels) {
        p = static_cast<std::uint8_t>(rng.below(256));
    }
    return pixels;
}

class FrontEnd {
public:
    FrontEnd() {
        Rng rng(7);
        for (int i = 0; i < 2 * kFrames; ++i) {
            images_.push_back(noise(rng));
        }
        priors_[0] = {true, 500, Pose{}, 2.0, 400.0};
        for (int k = 0; k < kObjects; ++k) {
            MaskItem item;
            item.owner = static_cast<std::uint8_t>(k + 1);
            item.has_box3d = true;
            item.size_m = Vec3(4.0, 1.7, 1.5);
            item.depth_m = 8.0 + 4.0 * k;
            item.T_c_o.R << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
            item.T_c_o.t = Vec3(-8.0 + 2.0 * k, 0.8, item.depth_m);
            (void)items_.try_push_back(item);
            priors_[static_cast<std::size_t>(k + 1)] = {true, 100, Pose{}, 0.7 * item.depth_m, 1.3 * item.depth_m};
        }
    }
    void start() { matcher_->reset(); }
    /// One frame; milliseconds of processor time.
    double frame(int k) {
        const std::clock_t begin = std::clock();
        masks_->build(calibration_.left, kWidth, kHeight, items_, *left_mask_, results_);
        masks_->build(calibration_.right, kWidth, kHeight, items_, *right_mask_, results_);
        MatcherInput in;
        in.left = {images_[static_cast<std::size_t>(2 * k)].data(), kWidth, kHeight, kWidth};
        in.right = {images_[static_cast<std::size_t>(2 * k + 1)].data(), kWidth, kHeight, kWidth};
        in.mask_left = left_mask_.get();
        in.mask_right = right_mask_.get();
        in.priors = &priors_;
        in.calibration = &calibration_;
        in.camera_height_m = 1.65;
        in.frame = static_cast<std::uint32_t>(k + 1);
        benchmark::DoNotOptimize(matcher_->process(in, *features_));
        reject_->run(*features_, calibration_, in.frame);
        return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }

private:
    Calibration calibration_ = aligned_pair();
    OwnerPriors priors_{};
    MaskItems items_{};
    MaskResults results_{};
    std::vector<std::vector<std::uint8_t>> images_;
    std::unique_ptr<OwnerMaskBuilder> masks_ = std::make_unique<OwnerMaskBuilder>();
    std::unique_ptr<OwnerMask> left_mask_ = std::make_unique<OwnerMask>();
    std::unique_ptr<OwnerMask> right_mask_ = std::make_unique<OwnerMask>();
    std::unique_ptr<PatchMatcher> matcher_ = std::make_unique<PatchMatcher>();
    std::unique_ptr<OutlierRejection> reject_ = std::make_unique<OutlierRejection>();
    std::unique_ptr<FrameFeatures> features_ = std::make_unique<FrameFeatures>();
};

/// Each frame's shortest time over five runs; of those the median and the longest.
void white_noise(benchmark::State& state) {
    FrontEnd front;
    for (auto _ : state) {
        std::array<double, kFrames> shortest{};
        shortest.fill(1e9);
        for (int run = 0; run < kRuns; ++run) {
            front.start();
            for (int k = 0; k < kFrames; ++k) {
                shortest[static_cast<std::size_t>(k)] = std::min(shortest[static_cast<std::size_t>(k)], front.frame(k));
            }
        }
        std::sort(shortest.begin(), shortest.end());
        state.counters["median_ms"] = shortest[kFrames / 2];
        state.counters["longest_ms"] = shortest.back();
    }
}
BENCHMARK(white_noise)->Name("front end, white noise, 500 + 9 x 100 features")->Iterations(1);

}  // namespace
}  // namespace semtrack::bench
