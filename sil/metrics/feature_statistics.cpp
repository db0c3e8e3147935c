#include "sil/metrics/feature_statistics.hpp"

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil {

void FeatureCounter::add(const Output& output) {
    ++frames_;
    for (const SparsePoint& point : output.points) {
        if (point.owner == 0) {
            ++features_;
            stereo_ += point.has_position ? 1 : 0;
            ++lengths_[point.id];
        }
    }
}

FeatureStatistics FeatureCounter::statistics() const {
    FeatureStatistics out;
    if (features_ == 0) {
        return out;
    }
    std::vector<double> lengths;
    for (const auto& [id, length] : lengths_) {
        lengths.push_back(length);
    }
    out.per_frame_mean = static_cast<double>(features_) / static_cast<double>(frames_);
    out.stereo_share = static_cast<double>(stereo_) / static_cast<double>(features_);
    out.track_length_mean = mean(lengths);
    out.track_length_median = median(lengths);
    return out;
}

}  // namespace semtrack::sil
