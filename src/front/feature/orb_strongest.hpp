// The other way to choose corners: each owner's strongest, wherever they are, as cv::ORB does. They come back more
// reliably than corners that are spread over cells, but leave parts of the image without any.
#ifndef SEMTRACK_FRONT_FEATURE_ORB_STRONGEST_HPP
#define SEMTRACK_FRONT_FEATURE_ORB_STRONGEST_HPP

#include <array>
#include <cstdint>

#include "front/feature/fast.hpp"
#include "front/feature/select.hpp"
#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

class StrongestCorners {
public:
    /// Takes up to budget[owner] corners of each owner that the mask shows there, best score first; equal scores in the
    /// order of the cells. Cost O(corners).
    void select(const CornerGrid& grid, const OwnerMaskView& mask, const FeatureBudget& budget, SelectedCorners& out);

private:
    std::array<std::uint16_t, static_cast<std::size_t>(CornerGrid::kMaxCorners)> sorted_{};  // cell x kPerCell + i
    static_assert(CornerGrid::kMaxCorners <= 65536, "16 bits number the corners");
};

}  // namespace semtrack

#endif
