// Two images of one texture, the right one moved by a known part of a pixel: each pixel is the mean of the light that
// falls on it, as in a camera, from a texture sixteen times as fine.
#ifndef SEMTRACK_TESTS_SUPPORT_PLANTED_PAIR_HPP
#define SEMTRACK_TESTS_SUPPORT_PLANTED_PAIR_HPP

#include <algorithm>
#include <cstdint>
#include <vector>

#include "math/rng.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

class PlantedTexture {
public:
    static constexpr int kWidth = 160;
    static constexpr int kHeight = 64;
    static constexpr int kFine = 16;  ///< steps per px

    /// Bricks of random grey, 3 to 9 px wide and 3 to 6 px high, each with its own fine grain.
    explicit PlantedTexture(std::uint32_t seed) {
        Rng noise(seed);
        constexpr int kW = (kWidth + 2 * kMargin) * kFine;
        constexpr int kH = (kHeight + 1) * kFine;
        std::vector<float> fine(static_cast<std::size_t>(kW) * kH);
        for (int y0 = 0; y0 < kH;) {
            const int y1 = std::min(kH, y0 + 3 * kFine + static_cast<int>(noise.uniform() * 3.0 * kFine));
            for (int x0 = 0; x0 < kW;) {
                const int x1 = std::min(kW, x0 + 3 * kFine + static_cast<int>(noise.uniform() * 6.0 * kFine));
                const double grey = 50.0 + 130.0 * noise.uniform();
                const double slant = noise.uniform() - 0.5;
                for (int y = y0; y < y1; ++y) {
                    const int shift = static_cast<int>(slant * (y - y0));
                    for (int x = std::max(0, x0 + shift); x < std::min(kW, x1 + shift); ++x) {
                        fine[static_cast<std::size_t>(y) * kW + static_cast<std::size_t>(x)] = static_cast<float>(grey);
                    }
                }
                x0 = x1;
            }
            y0 = y1;
        }
        sum_.assign(static_cast<std::size_t>(kW + 1) * (kH + 1), 0.0);
        for (int y = 0; y < kH; ++y) {
            double row = 0.0;
            for (int x = 0; x < kW; ++x) {
                row += static_cast<double>(fine[static_cast<std::size_t>(y) * kW + static_cast<std::size_t>(x)]);
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }

    /// The image whose pixel x shows what lies at x + shift_steps / kFine, times gain, plus offset, with noise,
    /// through a lens that spreads a point along the row.
    [[nodiscard]] std::vector<std::uint8_t> image(int shift_steps, double gain, double offset, double sigma,
                                                  std::uint32_t seed, int lens_steps = kFine) const {
        Rng noise(seed);
        std::vector<std::uint8_t> out;
        out.reserve(static_cast<std::size_t>(kWidth) * kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double grey = gain * light((x + kMargin) * kFine + shift_steps, y * kFine, lens_steps) + offset +
                                    sigma * noise.normal();
                out.push_back(static_cast<std::uint8_t>(grey < 0.0 ? 0.0 : grey > 255.0 ? 255.0 : grey + 0.5));
            }
        }
        return out;
    }
    [[nodiscard]] static ImageView view(const std::vector<std::uint8_t>& pixels) {
        return {pixels.data(), kWidth, kHeight, kWidth};
    }

private:
    static constexpr int kMargin = 8;
    [[nodiscard]] double& at(int x, int y) {
        return sum_[static_cast<std::size_t>(y) * ((kWidth + 2 * kMargin) * kFine + 1) + static_cast<std::size_t>(x)];
    }
    /// Mean over a pixel, and over a lens that spreads a point over lens_steps.
    [[nodiscard]] double light(int x, int y, int lens_steps) const {
        const int spread = lens_steps / 4;
        double mean = 0.0;
        for (int k = 0; k < 4; ++k) {
            const int x0 = x + (2 * k - 3) * spread / 2;
            mean += sum(x0 + kFine, y + kFine) - sum(x0, y + kFine) - sum(x0 + kFine, y) + sum(x0, y);
        }
        return mean / (4.0 * kFine * kFine);
    }
    [[nodiscard]] double sum(int x, int y) const {
        return sum_[static_cast<std::size_t>(y) * ((kWidth + 2 * kMargin) * kFine + 1) + static_cast<std::size_t>(x)];
    }
    std::vector<double> sum_;
};

}  // namespace semtrack

#endif
