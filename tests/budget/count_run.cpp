// usage: semtrack-count-run SCENE BACKGROUND_FEATURES OBJECT_FEATURES [GIVEN_OBJECTS]
// Runs a scene under an instruction counter. The counter (callgrind, or the plugin of qemu-user) watches the functions
// semtrack_count_*: from one to the next, every instruction belongs to the stage that the first one names.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "budget/load_scene.hpp"
#include "budget/scene_run.hpp"

// Not inlined, not merged with each other: each has an address and a name of its own.
#define SEMTRACK_MARKER(name)                                          \
    extern "C" __attribute__((noinline)) void semtrack_count_##name(); \
    extern "C" void semtrack_count_##name() {                          \
        __asm__ volatile("/* " #name " */" ::: "memory");              \
    }
SEMTRACK_MARKER(infer)
SEMTRACK_MARKER(associate)
SEMTRACK_MARKER(mask)
SEMTRACK_MARKER(extract)
SEMTRACK_MARKER(match)
SEMTRACK_MARKER(reject)
SEMTRACK_MARKER(ego)
SEMTRACK_MARKER(objects)
SEMTRACK_MARKER(align)
SEMTRACK_MARKER(lifecycle)
SEMTRACK_MARKER(encode)
SEMTRACK_MARKER(between)  // of the stages: the pipeline's own work
SEMTRACK_MARKER(outside)  // of the frame
#undef SEMTRACK_MARKER

namespace {

using namespace semtrack;

constexpr int kMostFrames = 100;

class Marker final : public StageObserver {
public:
    void begin(Stage stage) noexcept override {
        using Mark = void (*)();
        constexpr Mark kMarks[kStages] = {semtrack_count_infer,     semtrack_count_associate, semtrack_count_mask,
                                          semtrack_count_extract,   semtrack_count_match,     semtrack_count_reject,
                                          semtrack_count_ego,       semtrack_count_objects,   semtrack_count_align,
                                          semtrack_count_lifecycle, semtrack_count_encode};
        kMarks[static_cast<int>(stage)]();
    }
    void end(Stage) noexcept override { semtrack_count_between(); }
};

std::vector<std::uint8_t> read_scene(const char* file) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return {bytes.begin(), bytes.end()};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        (void)std::fputs("usage: semtrack-count-run SCENE BACKGROUND_FEATURES OBJECT_FEATURES [GIVEN]\n", stderr);
        return 2;
    }
    const std::vector<std::uint8_t> scene = read_scene(argv[1]);
    Config config;
    config.background_features = std::atoi(argv[2]);
    config.object_features = std::atoi(argv[3]);
    Marker marker;
    std::unique_ptr<budget::LoadFeatures> given;
    if (argc > 4) {
        given = std::make_unique<budget::LoadFeatures>(std::atoi(argv[4]), kMostFrames);
    }
    const auto run = std::make_unique<budget::SceneRun>(scene, config, &marker, given.get());
    for (int frame = 0; frame < run->frames(); ++frame) {
        semtrack_count_between();
        const bool processed = run->step();
        semtrack_count_outside();
        if (!processed) {
            return 1;
        }
        const budget::Load load = run->load();
        (void)std::printf("frame %d: %d objects, %d background features, %d on objects (%d at least on each)\n", frame,
                          load.objects, load.background, load.on_objects, load.least_on_object);
    }
    return run->frames() > 0 ? 0 : 1;
}
