// Outlier rejection, paper Sect. 4: RANSAC with a local fundamental matrix test, for the background and for each object
// on its own. Bounded trials, seeded by frame and owner: the same features, the same verdicts.
#ifndef SEMTRACK_FRONT_RANSAC_REJECT_HPP
#define SEMTRACK_FRONT_RANSAC_REJECT_HPP

#include <array>
#include <cstdint>

#include "front/ransac/fundamental.hpp"
#include "front/ransac/rigid_check.hpp"
#include "model/feature.hpp"
#include "semtrack/calibration.hpp"

namespace semtrack {

class OutlierRejection {
public:
    /// Judges every feature that was tracked; new ones are kept. features must be sorted by owner.
    /// - Epipolar geometry (8 pairs or more, most of them moving by more than a pixel): Sampson distance below 1 px.
    /// - Stereo pairs (5 or more) must share a rigid motion, within 2 px of (u, v, disparity): it also sees errors
    /// along
    ///   the epipolar line. Where the epipolar geometry is degenerate it decides alone; pairs without depth must then
    ///   fit it at some depth.
    /// - Where neither finds a majority, a standing scene (most flow below a pixel) rejects what moves; else all stay.
    /// Not finite, or owner out of range: rejected. Fewer than 5 tracked features of an owner: all are kept.
    void run(const FrameFeatures& features, const Calibration& calibration, std::uint32_t frame);
    /// Of features[i] in the last run.
    [[nodiscard]] bool inlier(int i) const { return inlier_[static_cast<std::size_t>(i)]; }
    /// Rejected features of an owner in the last run.
    [[nodiscard]] int rejected(int owner) const { return rejected_[static_cast<std::size_t>(owner)]; }

private:
    void judge(const FrameFeatures& features, int begin, int end, const Calibration& calibration, std::uint32_t frame);
    void collect(const FrameFeatures& features, int begin, int end);
    void scale_pairs(const FrameFeatures& features);
    void collect_stereo(const FrameFeatures& features, const Calibration& calibration);
    void polish();
    [[nodiscard]] bool fundamental_of_motion(const Calibration& calibration, Fundamental& f) const;
    [[nodiscard]] bool improves(const Fundamental& f);
    [[nodiscard]] bool run_fundamental(const Calibration& calibration, int rigid, int trials, std::uint32_t seed);
    void apply_rigid(const FrameFeatures& features, const Calibration& calibration, bool epipolar);
    [[nodiscard]] int slow_pairs(const FrameFeatures& features) const;

    std::array<bool, static_cast<std::size_t>(kMaxFeatures)> inlier_{};
    std::array<int, static_cast<std::size_t>(kMaxOwners)> rejected_{};
    std::array<int, kMaxPairs> index_{};  // feature of each pair
    ImagePairs pairs_{};
    std::array<double, 4> mean_{};  // of the pairs' u, v before and now, px
    StereoPairs stereo_{};
    std::array<int, kMaxPairs> stereo_pair_{};    // pair of each stereo pair
    std::array<std::int8_t, kMaxPairs> depth_{};  // of each pair: 1 it is among the stereo pairs
    PairFlags agrees_{};
    PairFlags best_{};
    Fundamental best_f_{};
    int best_count_{0};
    PairFlags rigid_{};
    RigidCheck rigid_check_{};
    SevenPointSolutions solutions_{};
};

}  // namespace semtrack

#endif
