// Sub-pixel stereo against planted disparities: does the measured disparity lean towards some part of a pixel, or with
// the right camera's brightness?
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "front/match/patch_align.hpp"
#include "support/planted_pair.hpp"

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

/// Mean error along the row, px, by the phase of the right image (in steps of kStep / 16 px); left patches start at
/// `left_phase` of a pixel.
std::array<double, 8> biases(const Light& light, float left_phase, int& count) {
    std::array<double, 8> out{};
    count = 0;
    for (std::size_t phase = 0; phase < out.size(); ++phase) {
        double sum = 0.0;
        int n = 0;
        for (int t = 0; t < kTextures; ++t) {
            const PlantedTexture texture(static_cast<std::uint32_t>(t + 1));
            const int shift = static_cast<int>(phase) * kStep;
            const auto left = texture.image(0, 1.0, 0.0, light.sigma, static_cast<std::uint32_t>(100 + t), light.lens);
            const auto right = texture.image(shift, light.gain, light.offset, light.sigma,
                                             static_cast<std::uint32_t>(200 + t), light.lens);
            for (int y = 12; y < PlantedTexture::kHeight - 12; y += 4) {
                for (int x = 16; x < PlantedTexture::kWidth - 24; x += 4) {
                    const float u = static_cast<float>(x) + left_phase;
                    const float truth = u - static_cast<float>(shift) / PlantedTexture::kFine;
                    PatchTemplate patch;
                    float at = truth + (x % 8 == 0 ? 0.4F : -0.4F);
                    float ncc = 0.0F;
                    if (patch.build_at(PlantedTexture::view(left), u, static_cast<float>(y), 0.0F) &&
                        patch.align_row(PlantedTexture::view(right), 3.0F, at, static_cast<float>(y), ncc) &&
                        ncc > 0.8F) {
                        sum += static_cast<double>(at - truth);
                        ++n;
                    }
                }
            }
        }
        out[phase] = sum / n;
        count += n;
    }
    return out;
}

TEST(DisparityBias, IsSmallAtEveryPhaseAndBrightnessAndAveragesOut) {
    int total = 0;
    for (const Light& light :
         {Light{16, 0.027, 1.0, 0.0, 2.0}, Light{16, 0.027, 0.85, -15.0, 2.0}, Light{16, 0.027, 1.1, 5.0, 4.0},
          Light{32, 0.02, 1.0, 0.0, 2.0}, Light{32, 0.02, 0.85, -15.0, 2.0}}) {
        double mean = 0.0;
        double worst = 0.0;
        for (const float left_phase : {0.0F, 0.25F, 0.5F, 0.75F}) {
            int count = 0;
            for (const double b : biases(light, left_phase, count)) {
                EXPECT_LT(std::fabs(b), light.limit_px) << light.gain << " " << left_phase;
                mean += b / 32.0;
                worst = std::fabs(b) > worst ? std::fabs(b) : worst;
            }
            total += count;
        }
        std::printf("lens %d gain %.2f offset %5.1f noise %.1f: worst phase %.4f px, mean %+.4f px\n", light.lens,
                    light.gain, light.offset, light.sigma, worst, mean);
        EXPECT_LT(std::fabs(mean), 0.004) << light.gain;
    }
    EXPECT_GT(total, 100000);
}

}  // namespace
}  // namespace semtrack
