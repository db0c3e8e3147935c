// Which result is which label, frame by frame, by their 2D boxes.
#ifndef SEMTRACK_SIL_METRICS_TRACK_MATCHING_HPP
#define SEMTRACK_SIL_METRICS_TRACK_MATCHING_HPP

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

struct RowMatch {
    std::size_t label;
    std::size_t result;
};

/// A result and a label meet when their 2D boxes overlap by an IoU of 0.5 or more and their classes are one (Car and
/// Van count as one). A pair of the evaluated frame before stays while it still meets; the rest is matched greedily by
/// falling IoU. Index as `frames`.
[[nodiscard]] std::vector<std::vector<RowMatch>> match_rows(const std::vector<EvaluatedFrame>& frames,
                                                            const std::vector<ObjectRow>& results,
                                                            const std::vector<ObjectRow>& labels);

}  // namespace semtrack::sil

#endif
