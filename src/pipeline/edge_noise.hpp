// What a detector's edges are worth: their scatter, and which of them are the image's border.
#ifndef SEMTRACK_PIPELINE_EDGE_NOISE_HPP
#define SEMTRACK_PIPELINE_EDGE_NOISE_HPP

#include <array>

#include "semtrack/types.hpp"

namespace semtrack {

/// Edges within 2.5 of the detector's own sigmas of the border (1.5 px at least) are put on it: detectors draw the box
/// of a cut object some pixels short of the border; of hidden edges, whose sigma is twice that, within twice as many.
/// width, height: of the image, px.
[[nodiscard]] Box2d drawn_to_border(const Box2d& box, int width, int height, const std::array<bool, 4>& hidden = {});

/// Edges (left, right, top, bottom) of box that lie behind a nearer object's box; lower in the image is nearer.
[[nodiscard]] std::array<bool, 4> hidden_edges(const Box2d& box, const Box2d& nearer);

/// Of an edge that a nearer box hides, px: the detector guesses it, or draws what is seen.
[[nodiscard]] double hidden_edge_sigma(const Box2d& box);

/// Sigmas of left, right, top, bottom of list.items[item], px; 0: the border's. Edges scatter by 0.8 px and 2 % of the
/// height; sideways more; hidden ones twice; and they are correlated over a window (0.75-0.79 from frame to frame),
/// which twice the sigma accounts for.
[[nodiscard]] std::array<double, 4> edge_sigmas(const DetectionList& list, int item, int width, int height);

}  // namespace semtrack

#endif
