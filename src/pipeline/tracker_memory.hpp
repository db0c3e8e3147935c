// What the bytes of a Tracker are spent on; docs/budgets.md has the table, and a gate keeps it true.
#ifndef SEMTRACK_PIPELINE_TRACKER_MEMORY_HPP
#define SEMTRACK_PIPELINE_TRACKER_MEMORY_HPP

#include <array>
#include <cstddef>

#include "pipeline/tracker_core.hpp"

namespace semtrack {

class TrackerMemory {
public:
    struct Part {
        const char* name;
        std::size_t bytes;
    };
    static constexpr std::size_t kTotal = sizeof(TrackerCore);
    /// Largest parts of the default capacities first; the last one is whatever else there is.
    [[nodiscard]] static constexpr std::array<Part, 11> parts() {
        std::array<Part, 11> out{{
            {"matcher: images, cells, what features look like", sizeof(TrackerCore::matcher_)},
            {"tracks: windows of all objects", sizeof(TrackerCore::tracks_)},
            {"owner masks of both images", sizeof(TrackerCore::mask_left_) + sizeof(TrackerCore::mask_right_)},
            {"solver's workspace", sizeof(ObjectWorker::system) + sizeof(ObjectWorker::step)},
            {"ego-motion: window, landmarks, history", sizeof(TrackerCore::ego_) + sizeof(TrackerCore::ego_result_)},
            {"features of the frame", sizeof(TrackerCore::features_)},
            {"features from outside", sizeof(TrackerCore::external_)},
            {"object problem", sizeof(ObjectWorker::estimator)},
            {"outlier rejection", sizeof(TrackerCore::rejection_)},
            {"association", sizeof(TrackerCore::associator_) + sizeof(TrackerCore::boxes_)},
            {"rest", 0},
        }};
        std::size_t named = 0;
        for (std::size_t i = 0; i + 1 < out.size(); ++i) {
            named += out[i].bytes;
        }
        out[out.size() - 1].bytes = kTotal - named;
        return out;
    }
};

}  // namespace semtrack

#endif
