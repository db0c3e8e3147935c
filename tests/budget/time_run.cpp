// usage: semtrack-time-run SCENE BACKGROUND_FEATURES OBJECT_FEATURES RUNS SKIPPED_FRAMES [GIVEN_OBJECTS]
// GIVEN_OBJECTS: the scene is that of semtrack-budget-scene load, its features come from outside (LoadFeatures).
// Milliseconds of processor time a frame and stage: each frame's minimum over the runs; of those the median and the
// maximum. Rows "name median maximum", and how full the capacities were: "name median minimum". With given features
// also the boxes' errors, of position in percent of the distance and of speed, and how many boxes have no object.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "budget/load_scene.hpp"
#include "budget/scene_run.hpp"

namespace {

using namespace semtrack;

constexpr int kMostFrames = 100;

class Stopwatch final : public StageObserver {
public:
    void begin(Stage) noexcept override { start_ms_ = now_ms(); }
    void end(Stage stage) noexcept override { ms_[static_cast<std::size_t>(stage)] += now_ms() - start_ms_; }
    void start_frame() {
        ms_.fill(0.0);
        frame_start_ms_ = now_ms();
    }
    [[nodiscard]] std::array<double, kStages + 1> frame() {
        ms_[kStages] = now_ms() - frame_start_ms_;
        return ms_;
    }

private:
    /// Of this thread: other programs on the same core do not count.
    static double now_ms() {
        std::timespec now{};
        (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
    }
    double start_ms_{0};
    double frame_start_ms_{0};
    std::array<double, kStages + 1> ms_{};
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2U];
}

/// What depends on the images alone, and everything else: a scene of images and one of given features each say half of
/// the worst case.
void print_parts(const std::vector<std::array<double, kStages + 1>>& frames) {
    std::vector<double> front;
    std::vector<double> rest;
    for (const auto& ms : frames) {
        front.push_back(ms[static_cast<std::size_t>(Stage::kExtract)] + ms[static_cast<std::size_t>(Stage::kMatch)]);
        rest.push_back(ms[kStages] - front.back());
    }
    (void)std::printf("extract_and_match %.3f %.3f\n", median(front), *std::max_element(front.begin(), front.end()));
    (void)std::printf("rest %.3f %.3f\n", median(rest), *std::max_element(rest.begin(), rest.end()));
}

void print_loads(const std::vector<budget::Load>& loads) {
    const auto row = [&loads](const char* name, int budget::Load::*value) {
        std::vector<double> values;
        for (const budget::Load& load : loads) {
            values.push_back(load.*value);
        }
        (void)std::printf("%s %.0f %.0f\n", name, median(values), *std::min_element(values.begin(), values.end()));
    };
    row("measured_objects", &budget::Load::objects);
    row("background_features", &budget::Load::background);
    row("object_features", &budget::Load::on_objects);
    row("least_on_an_object", &budget::Load::least_on_object);
}

/// How far the published objects are off the boxes, over all frames of a run.
class Errors {
public:
    void add(const Output& output, const std::vector<budget::LoadBox>& boxes) {
        for (const budget::LoadBox& box : boxes) {
            const double range_m = std::hypot(box.ahead_m, box.left_m);
            double nearest_m = 1.0;
            double speed_mps = 0.0;
            for (const TrackedObject& object : output.objects) {
                const double off_m = std::hypot(object.position_v[0] - box.ahead_m, object.position_v[1] - box.left_m);
                if (off_m < nearest_m) {
                    nearest_m = off_m;
                    speed_mps = std::fabs(object.speed - box.speed_mps);
                }
            }
            if (nearest_m < 1.0) {
                position_percent_.push_back(100.0 * nearest_m / range_m);
                speed_mps_.push_back(speed_mps);
            } else {
                ++missing_;
            }
        }
    }
    void print() {
        if (position_percent_.empty()) {
            return;
        }
        const auto row = [](const char* name, std::vector<double>& values) {
            (void)std::printf("%s %.3f %.3f\n", name, median(values), *std::max_element(values.begin(), values.end()));
        };
        row("position_error_percent", position_percent_);
        row("speed_error_mps", speed_mps_);
        (void)std::printf("boxes_without_object %d %zu\n", missing_, position_percent_.size() + std::size_t(missing_));
    }

private:
    std::vector<double> position_percent_{};
    std::vector<double> speed_mps_{};
    int missing_{0};
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 6) {
        (void)std::fputs("usage: semtrack-time-run SCENE BACKGROUND_FEATURES OBJECT_FEATURES RUNS SKIPPED [GIVEN]\n",
                         stderr);
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    Config config;
    config.background_features = std::atoi(argv[2]);
    config.object_features = std::atoi(argv[3]);
    const auto skipped = static_cast<std::size_t>(std::atoi(argv[5]));
    std::unique_ptr<budget::LoadFeatures> given;
    if (argc > 6) {
        given = std::make_unique<budget::LoadFeatures>(std::atoi(argv[6]), kMostFrames);
    }
    std::vector<std::array<double, kStages + 1>> least;
    std::vector<budget::Load> loads;
    Errors errors;
    for (int k = 0; k < std::atoi(argv[4]); ++k) {
        Stopwatch watch;
        const auto run = std::make_unique<budget::SceneRun>(std::vector<std::uint8_t>(bytes.begin(), bytes.end()),
                                                            config, &watch, given.get());
        loads.clear();
        for (std::size_t frame = 0;; ++frame) {
            watch.start_frame();
            if (!run->step()) {
                break;
            }
            const auto now = watch.frame();
            loads.push_back(run->load());
            if (given != nullptr && k == 0 && frame >= skipped) {
                errors.add(run->output(), budget::load_boxes(std::atoi(argv[6]), static_cast<int>(frame)));
            }
            if (least.size() <= frame) {
                least.push_back(now);
            }
            for (std::size_t s = 0; s < now.size(); ++s) {
                least[frame][s] = std::min(least[frame][s], now[s]);
            }
        }
    }
    if (least.size() <= skipped) {
        return 1;
    }
    least.erase(least.begin(), least.begin() + static_cast<std::ptrdiff_t>(skipped));
    loads.erase(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(skipped));
    for (std::size_t s = 0; s <= kStages; ++s) {
        std::vector<double> values;
        for (const auto& frame : least) {
            values.push_back(frame[s]);
        }
        (void)std::printf("%s %.3f %.3f\n", s == kStages ? "frame" : stage_name(static_cast<Stage>(s)), median(values),
                          *std::max_element(values.begin(), values.end()));
    }
    print_parts(least);
    print_loads(loads);
    errors.print();
    return 0;
}
