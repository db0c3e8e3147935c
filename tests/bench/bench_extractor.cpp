// semtrack-bench: quality, and milliseconds an image on one core, of the library's own ORB and of cv::ORB, and the
// ratio of their times. Real frames where SEMTRACK_KITTI names the data, else rendered ones.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "front/feature/orb_extractor.hpp"
#include "hal/opencv/plain_orb.hpp"
#include "tests/bench/extractor_quality.hpp"

namespace semtrack::bench {
namespace {

constexpr int kFeatures = 500;
constexpr int kThreshold = 10;        // FAST, as the tracker's: both extractors always have the same
constexpr int kOpenCvThreshold = 20;  // cv::ORB's own default

bool real_frames() {
    const char* const root = std::getenv("SEMTRACK_KITTI");
    return root != nullptr && *root != '\0';
}

const std::vector<FramePair>& frames() {
    static const std::vector<FramePair> kPairs =
        real_frames() ? drive_pairs(std::getenv("SEMTRACK_KITTI"), {25, 60, 100, 140, 180, 220, 260, 300})
                      : rendered_pairs("street", {0, 20, 40});
    return kPairs;
}

ImageView image(std::size_t k) {
    const FramePair& pair = frames()[k / 2 % frames().size()];
    return k % 2 == 0 ? pair.left.view() : pair.right.view();
}

/// The own extractor with all that a call needs.
class OwnOrb {
public:
    OwnOrb(int levels, Choice choice, bool upright, int threshold) : owners_(frames().front().left.pixels.size()) {
        OrbOptions options;
        options.levels = levels;
        options.upright = upright;
        options.threshold = threshold;
        options.spread = choice == Choice::kSpread;
        orb_ = std::make_unique<OrbExtractor>(options);
        budget_[0] = kFeatures;
    }
    void run(const ImageView& image) {
        benchmark::DoNotOptimize(orb_->extract(image, {owners_.data(), image.width, image.height}, budget_, *out_));
    }

private:
    std::vector<std::uint8_t> owners_;
    FeatureBudget budget_{};
    std::unique_ptr<OrbExtractor> orb_;
    std::unique_ptr<Keypoints> out_ = std::make_unique<Keypoints>();
};

template <class Orb>
void all_images(benchmark::State& state, Orb& orb) {
    std::size_t k = 0;
    for (auto _ : state) {
        orb.run(image(k++));
    }
}

void own(benchmark::State& state) {
    const Choice choice = state.range(1) != 0 ? Choice::kSpread : Choice::kStrongest;
    OwnOrb orb(static_cast<int>(state.range(0)), choice, state.range(2) != 0, static_cast<int>(state.range(3)));
    all_images(state, orb);
}

void opencv(benchmark::State& state) {
    PlainOrb orb(kFeatures, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    all_images(state, orb);
}

BENCHMARK(own)
    ->ArgNames({"levels", "spread", "upright", "threshold"})
    ->ArgsProduct({{8, 4, 1}, {0, 1}, {0, 1}, {kThreshold, kOpenCvThreshold}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(opencv)
    ->ArgNames({"levels", "threshold"})
    ->ArgsProduct({{8, 4, 1}, {kThreshold, kOpenCvThreshold}})
    ->Unit(benchmark::kMillisecond);

template <class Orb>
double least_ms(Orb& orb, const ImageView& view, double before) {
    const std::clock_t start = std::clock();
    orb.run(view);
    const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return ms < before ? ms : before;
}

/// Processor time, image by image in turns, the least of several runs of each: what else the machine does hits both
/// alike.
void print_ratio(int levels, Choice choice, int threshold) {
    constexpr int kRuns = 9;
    OwnOrb own_orb(levels, choice, false, threshold);
    PlainOrb cv_orb(kFeatures, levels, threshold);
    double own_ms = 0.0;
    double cv_ms = 0.0;
    const std::size_t images = 2 * frames().size();
    for (std::size_t k = 0; k < images; ++k) {
        double own_least = 1e9;
        double cv_least = 1e9;
        for (int run = 0; run < kRuns; ++run) {
            own_least = least_ms(own_orb, image(k), own_least);
            cv_least = least_ms(cv_orb, image(k), cv_least);
        }
        own_ms += own_least / static_cast<double>(images);
        cv_ms += cv_least / static_cast<double>(images);
    }
    (void)std::printf("%6d %10d  %-11s %8.2f %18.2f %13.2f\n", levels, threshold,
                      choice == Choice::kSpread ? "spread" : "strongest", own_ms, cv_ms, cv_ms / own_ms);
}

void print_times() {
    (void)std::printf("\nlevels  threshold  own chooses   own, ms  cv::ORB alone, ms  times faster\n");
    for (const int threshold : {kThreshold, kOpenCvThreshold}) {
        for (const Choice choice : {Choice::kStrongest, Choice::kSpread}) {
            for (const int levels : {8, 4, 1}) {
                print_ratio(levels, choice, threshold);
            }
        }
    }
    (void)std::printf("\n");
}

void print_quality() {
    (void)std::printf("%d features, %s frames\n%s", kFeatures, real_frames() ? "real" : "rendered",
                      quality_head().c_str());
    for (const int levels : {8, 4, 1}) {
        const std::string on = " " + std::to_string(levels);
        for (const Choice choice : {Choice::kStrongest, Choice::kSpread}) {
            const std::string chosen = (choice == Choice::kSpread ? ", spread" : ", strongest") + on;
            for (const auto& [name, extract] : {std::pair{"own, turned", own_orb(kFeatures, levels, choice, false)},
                                                {"own, upright", own_orb(kFeatures, levels, choice, true)},
                                                {"cv::ORB", cv_orb(kFeatures, levels, choice)}}) {
                (void)std::printf("%s", quality_line(name + chosen, measure(frames(), extract)).c_str());
            }
        }
    }
}

}  // namespace
}  // namespace semtrack::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 1;
    }
    semtrack::bench::print_quality();
    semtrack::bench::print_times();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
