// Images, truth and detections of every scenario, as hashes: the same on every compiler and target. When a scenario or
// the renderer changes on purpose, the test prints the new rows.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "sil/world/export_text.hpp"
#include "world_cases.hpp"

namespace semtrack::sil::world {
namespace {

constexpr int kFrames = 3;

struct Bytes {
    std::string_view scenario;
    std::uint64_t images;  ///< both of frame 2, a quarter of their size
    std::uint64_t truth;   ///< poses, labels, viewpoints and detections of three frames, as text
};

constexpr std::array<Bytes, 30> kBytes{{
    {"street", 0x3ea63d12355f70a3ULL, 0x7bf5dc230c17c347ULL},
    {"empty", 0x4d25c6449778fc8eULL, 0x1ba1fccfb56776edULL},
    {"traffic", 0xdbe0dd5b2e3e678dULL, 0x3788ccb2ba00f44eULL},
    {"follow", 0x3293ea011e08c0bfULL, 0xc31470a40c272000ULL},
    {"crossing", 0xd68c479c472d037bULL, 0x0cd24310ffc67501ULL},
    {"cut_in", 0xe81d7c1e41320fa0ULL, 0x812a687ae0cd1138ULL},
    {"beside", 0x5a05af6e1945529fULL, 0xa8c4915e397919e4ULL},
    {"passed", 0x6a506bbf5bc39276ULL, 0x87793ce542e4aa6dULL},
    {"turning", 0x25d2afe4850d278aULL, 0x797f67edd1f9fbbcULL},
    {"reversing", 0x697138d4b48b0bb6ULL, 0x1598de57755f2d5bULL},
    {"pedestrians", 0x2c191a903739d2b7ULL, 0xa35f1ca687fc6b94ULL},
    {"far", 0x9b58a4a9615bee43ULL, 0xda58c556fc342a58ULL},
    {"occlusion", 0x2984991d1fd1395cULL, 0xde1961cc63e38446ULL},
    {"standing", 0x511435b55d73bff7ULL, 0xa55054aa91250236ULL},
    {"braking", 0x74fd8073d6617b81ULL, 0x33ee5dea002b05ceULL},
    {"hill", 0x4a96513110f430ebULL, 0x3d47d9dd3a8d31c8ULL},
    {"night", 0xef69b37f28d335cfULL, 0x7bf5dc230c17c347ULL},
    {"exposure", 0x3ea63d12355f70a3ULL, 0x7bf5dc230c17c347ULL},
    {"dropped", 0x3ea63d12355f70a3ULL, 0x7bf5dc230c17c347ULL},
    {"blackout", 0x74fd8073d6617b81ULL, 0x33ee5dea002b05ceULL},
    {"blind_right", 0x3ea63d12355f70a3ULL, 0x7bf5dc230c17c347ULL},
    {"misaligned", 0x7ea283f50e036b44ULL, 0x7bf5dc230c17c347ULL},
    {"detector_5hz", 0x3ea63d12355f70a3ULL, 0xeb32abb8e7f3cdb1ULL},
    {"detector_misses", 0x3ea63d12355f70a3ULL, 0x81cbb2d0fc7128d1ULL},
    {"no_viewpoint", 0x3ea63d12355f70a3ULL, 0x16fa4517356dd213ULL},
    {"short_street", 0x3ea63d12355f70a3ULL, 0x7bf5dc230c17c347ULL},
    {"avenue", 0x5f0d7d23f2cad4faULL, 0xf04585b728ded82fULL},
    {"avenue_residual", 0x3480398357b1c3b5ULL, 0xf04585b728ded82fULL},
    {"queue", 0xa97d70da2c1eadb5ULL, 0x3788ccb2ba00f44eULL},
    {"queue_empty", 0x2ccaa0746d408096ULL, 0xf517b20ed2f63eedULL},
}};

std::uint64_t image_bytes(const std::string& name) {
    const Scenario scenario = find_scenario(name);
    const Scene scene(scenario, kFrames);
    GreyImage left;
    GreyImage right;
    Renderer(scene, small_calibration(scenario)).render(kFrames - 1, left, right);
    left.pixels.insert(left.pixels.end(), right.pixels.begin(), right.pixels.end());
    return hash_of(left.pixels);
}

std::uint64_t truth_bytes(const std::string& name) {
    const WorldSequence world(name, WorldOptions{kFrames, false, 1});
    return hash_of(poses(world) + label_rows(world) + viewpoint_rows(world) + detection_rows(world));
}

TEST(WorldBytes, ImagesTruthAndDetectionsOfEveryScenarioAreTheSameOnEveryTarget) {
    const std::vector<std::string> names = all_scenario_names();
    ASSERT_EQ(names.size(), kBytes.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::uint64_t images = image_bytes(names[i]);
        const std::uint64_t truth = truth_bytes(names[i]);
        if (names[i] != kBytes[i].scenario || images != kBytes[i].images || truth != kBytes[i].truth) {
            std::printf("    {\"%s\", 0x%016llxULL, 0x%016llxULL},\n", names[i].c_str(),
                        static_cast<unsigned long long>(images), static_cast<unsigned long long>(truth));
            ADD_FAILURE() << names[i];
        }
    }
}

}  // namespace
}  // namespace semtrack::sil::world
