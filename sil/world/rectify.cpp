#include "sil/world/rectify.hpp"

#include <algorithm>
#include <array>

#include "math/trig.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

/// One wave across an axis, sampled at every pixel of it.
std::vector<float> wave(int length, double cycles, std::uint32_t seed) {
    std::vector<float> out;
    const double phase = kTwoPi * static_cast<double>(unit(seed));
    for (int i = 0; i < length; ++i) {
        out.push_back(static_cast<float>(sin_cos(phase + kTwoPi * cycles * i / length).sin));
    }
    return out;
}

/// Product of two waves plus a slower one: changes over some 300 px, as a distortion model's residual does.
class Field {
public:
    Field(int width, int height, double amplitude, std::uint32_t seed)
        : amplitude_(static_cast<float>(amplitude)),
          x_(wave(width, 2.1, hash(seed, 1U))),
          y_(wave(height, 0.8, hash(seed, 2U))),
          slow_(wave(width, 0.7, hash(seed, 3U))) {}
    [[nodiscard]] float at(int x, int y) const {
        const auto i = static_cast<std::size_t>(x);
        return amplitude_ * (x_[i] * y_[static_cast<std::size_t>(y)] + 0.4F * slow_[i]);
    }

private:
    float amplitude_;
    std::vector<float> x_;
    std::vector<float> y_;
    std::vector<float> slow_;
};

}  // namespace

void rectify(GreyImage& image, double amplitude_px, std::uint32_t seed) {
    if (!(amplitude_px > 0.0) || image.empty()) {
        return;
    }
    const Field du(image.width, image.height, amplitude_px, hash(seed, 10U));
    const Field dv(image.width, image.height, amplitude_px, hash(seed, 20U));
    const std::vector<std::uint8_t> in = image.pixels;
    const auto pixel = [&](int x, int y) {
        x = std::clamp(x, 0, image.width - 1);
        y = std::clamp(y, 0, image.height - 1);
        return static_cast<float>(
            in[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)]);
    };
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float u = static_cast<float>(x) + du.at(x, y);
            const float v = static_cast<float>(y) + dv.at(x, y);
            const int iu = floor_int(u);
            const int iv = floor_int(v);
            const float a = u - static_cast<float>(iu);
            const float b = v - static_cast<float>(iv);
            const float top = pixel(iu, iv) + a * (pixel(iu + 1, iv) - pixel(iu, iv));
            const float bottom = pixel(iu, iv + 1) + a * (pixel(iu + 1, iv + 1) - pixel(iu, iv + 1));
            const float value = top + b * (bottom - top) + 0.5F;
            image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F));
        }
    }
}

}  // namespace semtrack::sil::world
