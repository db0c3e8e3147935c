// Sub-pixel disparity of a matched corner along the row.
#ifndef SEMTRACK_FRONT_MATCH_ORB_REFINE_HPP
#define SEMTRACK_FRONT_MATCH_ORB_REFINE_HPP

#include "semtrack/image_view.hpp"

namespace semtrack {

struct RowMatch {
    float x{0};         ///< column in the right image, px
    float residual{0};  ///< mean absolute difference after removing the means, grey levels
};

/// Slides the 11 x 11 patch around (x_left, y_left) along row y_right by up to `reach` (at most 8) pixels around
/// x_right; sum of absolute differences without the patches' means (the cameras differ in brightness), then a parabola
/// through the best three. false: a patch leaves its image, or the best lies at the end of the search. Integers up to
/// the parabola; cost O(reach).
[[nodiscard]] bool refine_along_row(const ImageView& left, int x_left, int y_left, const ImageView& right, int x_right,
                                    int y_right, int reach, RowMatch& out);

}  // namespace semtrack

#endif
