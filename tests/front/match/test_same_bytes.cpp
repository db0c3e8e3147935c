// The front end gives the same bytes on every target, with every compiler and at every level of optimisation: a hash
// over all keypoints, descriptors and matches of 20 frames. Whoever changes the front end on purpose writes the new
// hash here.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "front/feature/orb_extractor.hpp"
#include "front/match/orb_matcher.hpp"
#include "front/match/patch_matcher.hpp"
#include "support/plane_scene.hpp"
#include "support/road_scene.hpp"

namespace semtrack {
namespace {

constexpr std::uint64_t kPatchHash = 15055600916626855112ULL;
constexpr std::uint64_t kOrbHash = 8958372380185819886ULL;
constexpr std::uint64_t kKeypointHash = 12097092120181386924ULL;

/// FNV-1a.
class Hash {
public:
    void add(std::uint64_t value) {
        for (int i = 0; i < 8; ++i) {
            hash_ = (hash_ ^ (value & 0xFFU)) * 1099511628211ULL;
            value >>= 8U;
        }
    }
    void add(float value) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        add(std::uint64_t{bits});
    }
    void add(const FeatureMeasurement& m) {
        add(std::uint64_t{m.id});
        add(static_cast<std::uint64_t>(m.slot) << 8U | m.owner);
        add(std::uint64_t{m.stereo} << 2U | std::uint64_t{m.tracked} << 1U | std::uint64_t{m.previous_stereo});
        add(std::uint64_t{m.age});
        for (const float x : {m.u, m.v, m.stereo ? m.u_right : 0.0F, m.stereo ? m.v_right : 0.0F, m.previous_u,
                              m.previous_v, m.sigma_px, m.stereo ? m.sigma_right_px : 0.0F}) {
            add(x);
        }
    }
    void add(const Keypoint& k) {
        add(k.u);
        add(k.v);
        add(static_cast<std::uint64_t>(k.score) << 16U | std::uint64_t{k.owner} << 8U | k.level);
        for (const std::uint32_t word : k.descriptor) {
            add(std::uint64_t{word});
        }
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_{14695981039346656037ULL};
};

struct Hashes {
    Hash matches{};
    Hash keypoints{};
    int features{0};
    int tracked{0};
    int stereo{0};
    int points{0};
};

/// Ten frames of a wall with a board before it, ten of a road.
template <class Matcher>
Hashes run(Matcher& matcher, OrbExtractor& extractor) {
    Hashes out;
    const auto features = std::make_unique<FrameFeatures>();
    const auto keypoints = std::make_unique<Keypoints>();
    const Calibration calibration = PlaneScene{}.calibration();
    FeatureBudget budget{};
    budget[0] = 300;
    budget[1] = 60;
    const auto one = [&](const MatcherInput& in) {
        EXPECT_EQ(matcher.process(in, *features), Status::kOk);
        for (const FeatureMeasurement& m : *features) {
            out.matches.add(m);
            ++out.features;
            out.tracked += m.tracked ? 1 : 0;
            out.stereo += m.stereo ? 1 : 0;
        }
        EXPECT_EQ(extractor.extract(in.left, in.mask_left->view(), budget, *keypoints), Status::kOk);
        for (const Keypoint& k : *keypoints) {
            out.keypoints.add(k);
            ++out.points;
        }
    };
    PlaneScene scene;
    scene.board = true;
    scene.gain = 0.93;
    OwnerPriors priors = still_priors(true);
    priors[0].T_cur_prev = sideways(3.3, scene.wall_depth_m);
    priors[1].T_cur_prev = sideways(-5.2, scene.board_depth_m);
    for (int k = 0; k < 10; ++k) {
        const PlaneFrame frame(scene, 3.3 * k, 0.4 * k, -5.2 * k);
        one(frame.input(calibration, priors, k + 1));
    }
    matcher.reset();
    priors = still_priors(false);
    priors[0].T_cur_prev.t = Vec3(0.0, 0.0, -0.8);
    for (int k = 0; k < 10; ++k) {
        const RoadFrame frame(0.8 * k);
        one(frame.input(calibration, priors, k + 1, RoadScene::kHeight_m));
    }
    return out;
}

TEST(SameBytes, OfThePatchMatcher) {
    const auto matcher = std::make_unique<PatchMatcher>();
    const auto extractor = std::make_unique<OrbExtractor>();
    const Hashes h = run(*matcher, *extractor);
    EXPECT_GT(h.features, 4000);
    EXPECT_GT(h.tracked, h.features / 2);
    EXPECT_GT(h.stereo, h.features * 8 / 10);
    EXPECT_EQ(h.matches.value(), kPatchHash) << std::hex << h.matches.value();
}

TEST(SameBytes, OfTheOrbMatcherAndItsKeypoints) {
    const auto matcher = std::make_unique<OrbMatcher>();
    const auto in_matcher = std::make_unique<OrbExtractor>();
    matcher->set_extractor(in_matcher.get());
    const auto extractor = std::make_unique<OrbExtractor>();
    const Hashes h = run(*matcher, *extractor);
    EXPECT_GT(h.features, 4000);
    EXPECT_GT(h.tracked, h.features / 4);
    EXPECT_GT(h.stereo, h.features / 4);
    EXPECT_GT(h.points, 4000);
    EXPECT_EQ(h.matches.value(), kOrbHash) << std::hex << h.matches.value();
    EXPECT_EQ(h.keypoints.value(), kKeypointHash) << std::hex << h.keypoints.value();
}

}  // namespace
}  // namespace semtrack
