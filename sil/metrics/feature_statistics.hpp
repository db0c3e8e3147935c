// How much the front end finds to hold on to: the background's features of a drive.
#ifndef SEMTRACK_SIL_METRICS_FEATURE_STATISTICS_HPP
#define SEMTRACK_SIL_METRICS_FEATURE_STATISTICS_HPP

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "semtrack/types.hpp"

namespace semtrack::sil {

struct FeatureStatistics {
    std::optional<double> per_frame_mean{};      ///< after the rejection of outliers
    std::optional<double> stereo_share{};        ///< of them, with a place in space
    std::optional<double> track_length_mean{};   ///< frames from first to last sight, of all features
    std::optional<double> track_length_median{};
};

class FeatureCounter {
public:
    void add(const Output& output);
    [[nodiscard]] FeatureStatistics statistics() const;

private:
    std::int64_t frames_{0};
    std::int64_t features_{0};
    std::int64_t stereo_{0};
    std::map<std::uint32_t, int> lengths_;
};

}  // namespace semtrack::sil

#endif
