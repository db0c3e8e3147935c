// Sub-pixel stereo against planted disparities: does the measured disparity lean towards some part of a pixel, or with
// the right camera's brightness?
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "front/match/patch_align.hpp"
#include "support/planted_pair.hpp"
#include "support/sweep.hpp"

namespace semtrack {
namespace {

constexpr int kTextures = 6;
constexpr int kStep = 2;  // sixteenths of a pixel between two phases

struct Light {
    int lens;  ///< sixteenths of a pixel
    double limit_px;
    double gain;
    double offset;
    double sigma;
};

constexpr std::array<float, 4> kLeftPhases{0.0F, 0.25F, 0.5F, 0.75F};  // where in a pixel left patches start
constexpr std::size_t kPhases = 8;                                     // of the right image, kStep / 16 px apart

/// Errors along the row, px.
struct ErrorSum {
    double sum{0};
    int n{0};
};
using ErrorSums = std::array<std::array<ErrorSum, kPhases>, kLeftPhases.size()>;

ErrorSum errors(const ImageView& left, const ImageView& right, float left_phase, float shift_px, ErrorSum s) {
    for (int y = 12; y < PlantedTexture::kHeight - 12; y += 4) {
        for (int x = 16; x < PlantedTexture::kWidth - 24; x += 4) {
            const float u = static_cast<float>(x) + left_phase;
            const float truth = u - shift_px;
            PatchTemplate patch;
            float at = truth + (x % 8 == 0 ? 0.4F : -0.4F);
            float ncc = 0.0F;
            if (patch.build_at(left, u, static_cast<float>(y), 0.0F) &&
                patch.align_row(right, 3.0F, at, static_cast<float>(y), ncc) && ncc > 0.8F) {
                s.sum += static_cast<double>(at - truth);
                ++s.n;
            }
        }
    }
    return s;
}

/// Each texture and image is made once: they take longer than the matching.
ErrorSums error_sums(const Light& light) {
    ErrorSums out{};
    for (std::uint32_t t = 0; t < kTextures; ++t) {
        const PlantedTexture texture(t + 1U);
        const auto left = texture.image(0, 1.0, 0.0, light.sigma, 100U + t, light.lens);
        for (std::size_t phase = 0; phase < kPhases; ++phase) {
            const int shift = static_cast<int>(phase) * kStep;
            const auto right = texture.image(shift, light.gain, light.offset, light.sigma, 200U + t, light.lens);
            const float shift_px = static_cast<float>(shift) / PlantedTexture::kFine;
            for (std::size_t l = 0; l < kLeftPhases.size(); ++l) {
                out[l][phase] = errors(PlantedTexture::view(left), PlantedTexture::view(right), kLeftPhases[l],
                                       shift_px, out[l][phase]);
            }
        }
    }
    return out;
}

TEST(DisparityBias, IsSmallAtEveryPhaseAndBrightnessAndAveragesOut) {
    int total = 0;
    constexpr std::array<Light, 5> kLights{Light{16, 0.027, 1.0, 0.0, 2.0}, Light{16, 0.027, 0.85, -15.0, 2.0},
                                           Light{16, 0.027, 1.1, 5.0, 4.0}, Light{32, 0.02, 1.0, 0.0, 2.0},
                                           Light{32, 0.02, 0.85, -15.0, 2.0}};
    // Limits rest on all textures and phases: a share of the sweep is the first and the last light.
    for (std::size_t i = 0; i < kLights.size(); i += kSweepShare > 1 ? kLights.size() - 1 : 1) {
        const Light& light = kLights[i];
        double mean = 0.0;
        double worst = 0.0;
        for (const auto& of_left_phase : error_sums(light)) {
            for (const ErrorSum& s : of_left_phase) {
                const double bias = s.sum / s.n;
                EXPECT_LT(std::fabs(bias), light.limit_px) << light.gain;
                mean += bias / 32.0;
                worst = std::fabs(bias) > worst ? std::fabs(bias) : worst;
                total += s.n;
            }
        }
        std::printf("lens %d gain %.2f offset %5.1f noise %.1f: worst phase %.4f px, mean %+.4f px\n", light.lens,
                    light.gain, light.offset, light.sigma, worst, mean);
        EXPECT_LT(std::fabs(mean), 0.004) << light.gain;
    }
    EXPECT_GT(total, 100000 / kSweepShare);
}

}  // namespace
}  // namespace semtrack
