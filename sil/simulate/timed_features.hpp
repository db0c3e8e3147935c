// Features made beforehand, by the time of their frame.
#ifndef SEMTRACK_SIL_SIMULATE_TIMED_FEATURES_HPP
#define SEMTRACK_SIL_SIMULATE_TIMED_FEATURES_HPP

#include <map>
#include <vector>

#include "math/camera.hpp"
#include "math/rng.hpp"
#include "semtrack/hal/sources.hpp"

namespace semtrack::sil {

class TimedFeatures : public FeatureSource {
public:
    /// Those of one frame, as many as the tracker has room for.
    [[nodiscard]] SourceResult poll(std::int64_t time_us, ExternalFeatures& features) noexcept override {
        const auto found = by_time_.find(time_us);
        if (found == by_time_.end()) {
            return SourceResult::kNone;
        }
        for (const ExternalFeature& f : found->second) {
            if (!features.try_push_back(f)) {
                break;
            }
        }
        return SourceResult::kOk;
    }

protected:
    ~TimedFeatures() = default;  // never deleted by this base
    std::map<std::int64_t, std::vector<ExternalFeature>> by_time_{};
};

/// What both cameras see of point x_c, with normal noise on u, v and u_right each.
[[nodiscard]] inline ExternalFeature noisy_stereo_feature(const Calibration& calibration, std::uint32_t id,
                                                          const Vec3& x_c, double noise_px, Rng& chance) {
    ExternalFeature f;
    f.id = id;
    f.stereo = true;
    const Vec2 left = project(calibration.left, x_c);
    f.u = static_cast<float>(left(0) + noise_px * chance.normal());
    f.v = static_cast<float>(left(1) + noise_px * chance.normal());
    f.u_right = static_cast<float>(right_column(calibration, left(0), x_c(2)) + noise_px * chance.normal());
    f.sigma_px = static_cast<float>(noise_px);
    return f;
}

}  // namespace semtrack::sil

#endif
