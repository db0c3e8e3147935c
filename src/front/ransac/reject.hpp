// Outlier rejection, paper Sect. 4: RANSAC with a local fundamental matrix, for the background and for each object on
// its own. Fixed trials, seeded by frame and owner.
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
    /// Judges every feature that was tracked; new ones are kept. features is sorted by owner. Where the epipolar
    /// geometry says nothing (hardly any flow, few points), a rigid motion of the stereo points decides instead; where
    /// that cannot either, all are kept.
    void run(const FrameFeatures& features, const Calibration& calibration, std::uint32_t frame);
    /// Of features[i] in the last run.
    [[nodiscard]] bool inlier(int i) const { return inlier_[static_cast<std::size_t>(i)]; }
    /// Rejected features of an owner in the last run.
    [[nodiscard]] int rejected(int owner) const { return rejected_[static_cast<std::size_t>(owner)]; }

private:
    void judge(const FrameFeatures& features, const Calibration& calibration, int owner, std::uint32_t frame);
    void collect(const FrameFeatures& features, int begin, int end, const Calibration& calibration);
    [[nodiscard]] bool run_fundamental(int owner, std::uint32_t frame);

    std::array<bool, kMaxFeatures> inlier_{};
    std::array<int, kMaxOwners> rejected_{};
    std::array<int, kMaxPairs> index_{};  // feature of each pair
    ImagePairs pairs_{};
    StereoPairs stereo_{};
    std::array<int, kMaxPairs> stereo_pair_{};  // pair of each stereo pair
    PairFlags agrees_{};
    PairFlags best_{};
    PairFlags rigid_{};
    RigidCheck rigid_check_{};
    SevenPointSolutions solutions_{};
};

}  // namespace semtrack

#endif
