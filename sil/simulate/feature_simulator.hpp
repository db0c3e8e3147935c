// Features of labelled cars where there are no images: `--features simulated`. Seeded, the same on every machine.
//
// Fitted to the stereo matches on the 306 labels (Car, Van; occluded 1 or less) that drive 0039 frames 19-330 has
// tracks on: counts by box height h: 8, 12, 18, 30, 48, 48 (medians at h = 30, 42, 60, 84, 120, 200 px) -> min(48, 0.38
// h - 4); depth under the labelled box's faces: median 0.05 m, 5 % beyond 0.27-0.42 m -> 0 to 0.4 m, evenly; 12-15 % of
// the matches within 20 m lie more than 0.5 m off the box -> 10 % on the background behind. Real tracks last 11 frames
// in the median. Noise: 0.5 px by default, what the patch matcher's residuals on cars show is 0.3-0.8. Optimistic:
// labels' boxes are exact, noise has no tails and no correlation. No claim rests on these features.
#ifndef SEMTRACK_SIL_SIMULATE_FEATURE_SIMULATOR_HPP
#define SEMTRACK_SIL_SIMULATE_FEATURE_SIMULATOR_HPP

#include <map>
#include <vector>

#include "math/pose.hpp"
#include "sil/sequence.hpp"
#include "sil/simulate/timed_features.hpp"

namespace semtrack::sil {

class FeatureSimulator final : public TimedFeatures {
public:
    /// T_f_c0: ego poses by frame, for points on the background. noise_px: of u, v, u_right each.
    FeatureSimulator(const Sequence& sequence, const std::map<int, RigidTransform>& T_f_c0, int first, int last,
                     double noise_px);

private:
    struct Box {  // a labelled object in one frame
        int id{0};
        Pose T_c_o{};
        Vec3 size_m{Vec3::Zero()};
        Box2d box{};
        double depth_m{0};
    };
    struct Point {  // of one object, by its number
        std::uint32_t generation{0};
        Vec3 place{Vec3::Zero()};  ///< object frame; of a background point: frame of the poses' file
        int face{-1};              ///< axis of the face it lies under; -1: background
    };

    void simulate(int frame, const std::vector<Box>& boxes, const Pose& T_f_c, std::vector<ExternalFeature>& out);
    bool add(int frame, const Box& box, int number, const Pose& T_f_c, const std::vector<Box>& boxes,
             std::vector<ExternalFeature>& out);
    [[nodiscard]] static Point surface_point(const Box& box, std::uint32_t seed);
    [[nodiscard]] bool is_seen(const Box& box, const Point& point, const Vec3& x_c) const;
    [[nodiscard]] Point background_point(const Box& box, const Pose& T_f_c, std::uint32_t seed) const;

    Calibration calibration_{};
    double noise_px_;
    std::map<std::pair<int, int>, Point> points_;  // object id, number
};

}  // namespace semtrack::sil

#endif
