// Images of the street: several samples a pixel, shading, sensor noise, exposure; and the silhouettes of road users
// from the very samples that make the image.
#ifndef SEMTRACK_SIL_WORLD_RENDERER_HPP
#define SEMTRACK_SIL_WORLD_RENDERER_HPP

#include <cstdint>
#include <vector>

#include "sil/sequence.hpp"
#include "sil/world/raycast.hpp"
#include "sil/world/scene.hpp"

namespace semtrack::sil::world {

/// What the left image shows of one road user. Boxes are clipped to the image, to 1/8 px.
struct Silhouette {
    std::int64_t samples{0};          ///< inside the image, hidden or not
    std::int64_t visible_samples{0};  ///< of them, not hidden by anything nearer
    Box2d whole{};                    ///< bounds of all samples
    Box2d visible{};                  ///< bounds of the visible ones
    [[nodiscard]] double visible_share() const {
        return samples > 0 ? static_cast<double>(visible_samples) / static_cast<double>(samples) : 0.0;
    }
};

/// Geometry of the processed pair, KITTI's: 1242x375, 0.54 m. The right camera's faults are in row_offset.
[[nodiscard]] Calibration world_calibration(const Scenario& scenario);

class Renderer {
public:
    explicit Renderer(const Scene& scene, const Calibration& calibration) : scene_(scene), calibration_(calibration) {}

    /// Cost on one core: about 0.5 s a pair. The bytes do not depend on `threads` (1 or 2; others count as the nearer).
    void render(int frame, GreyImage& left, GreyImage& right, int threads = 2) const;
    /// One per road user, in the scenario's order; no shading, so about ten times cheaper than an image.
    [[nodiscard]] std::vector<Silhouette> silhouettes(int frame, int threads = 2) const;

private:
    const Scene& scene_;
    Calibration calibration_;
};

}  // namespace semtrack::sil::world

#endif
