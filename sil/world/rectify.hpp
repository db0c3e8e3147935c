// What rectification does to a real image: bilinear resampling (a little blur, noise that correlates with its
// neighbours) and a residual of the calibration, a smooth field of fractions of a pixel that no calibration knows.
#ifndef SEMTRACK_SIL_WORLD_RECTIFY_HPP
#define SEMTRACK_SIL_WORLD_RECTIFY_HPP

#include <cstdint>

#include "sil/sequence.hpp"

namespace semtrack::sil::world {

/// Resamples in place: pixel (x, y) shows what stood at (x + dx, y + dy), |dx|, |dy| <= 1.4 amplitude_px. The field is
/// the camera's (`seed`), the same in every frame. amplitude_px 0: untouched. Cost: about 15 ms an image.
void rectify(GreyImage& image, double amplitude_px, std::uint32_t seed);

}  // namespace semtrack::sil::world

#endif
