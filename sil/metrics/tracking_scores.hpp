// Tracking scores of cars by their 2D boxes, as KITTI's tracking benchmark: HOTA (Luiten et al. 2021) and CLEAR MOT
// (Bernardin and Stiefelhagen 2008).
#ifndef SEMTRACK_SIL_METRICS_TRACKING_SCORES_HPP
#define SEMTRACK_SIL_METRICS_TRACKING_SCORES_HPP

#include <array>

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

/// Shares 0..1. Empty without labels that count; MOTP also without hits.
struct TrackingScores {
    std::int64_t labels{0};
    std::int64_t hits{0};
    std::int64_t misses{0};
    std::int64_t false_alarms{0};
    std::int64_t id_switches{0};
    std::int64_t fragmentations{0};
    std::optional<double> mota{};  ///< 1 - (misses + false alarms + switches) / labels
    std::optional<double> motp{};  ///< mean overlap of the hits
    std::optional<double> hota{};  ///< mean over overlaps 0.05, 0.10, .. 0.95 of sqrt(DetA AssA)
    std::optional<double> deta{};
    std::optional<double> assa{};
};

/// Results of one or more drives together.
///
/// What counts: labels of type Car, occluded 2 or less, truncated 0.5 or less (KITTI's level 0). Results on other
/// labels (Van; too hidden; cut) and results without label that are 25 px high or less or lie in a DontCare area are
/// taken out before anything is counted. CLEAR at an overlap of 0.5; a pair of the frame before is kept while it
/// reaches that.
class TrackingEvaluation {
public:
    void add(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames, const ObjectTruthSet& truth);
    [[nodiscard]] TrackingScores scores() const;

private:
    static constexpr std::size_t kAlphas = 19;
    struct Counts {
        std::int64_t hits{0};
        std::int64_t misses{0};
        std::int64_t false_alarms{0};
        double association{0};  // sum over hits of their association's Jaccard index
    };
    struct Frame;
    class Links;
    static std::vector<Frame> frames_of(const std::vector<ObjectRow>& results, const std::vector<int>& result_frames,
                                        const ObjectTruthSet& truth);
    void add_clear(const std::vector<Frame>& frames);
    void add_hota(const std::vector<Frame>& frames);

    std::array<Counts, kAlphas> hota_{};
    TrackingScores clear_{};
    double overlap_sum_{0};
};

}  // namespace semtrack::sil

#endif
