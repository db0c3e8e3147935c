// How many random samples a consensus needs.
#ifndef SEMTRACK_FRONT_RANSAC_TRIALS_HPP
#define SEMTRACK_FRONT_RANSAC_TRIALS_HPP

namespace semtrack {

/// Trials after which a sample of sample_size points, all of them inliers, has been drawn with a probability of 99.9 %
/// when `inliers` of `total` points are; at most `most`. The count bounds the work; good data end early.
[[nodiscard]] inline int trials_needed(int inliers, int total, int sample_size, int most) {
    constexpr double kMayMiss = 0.001;
    const double share = static_cast<double>(inliers) / static_cast<double>(total);
    double good = 1.0;
    for (int k = 0; k < sample_size; ++k) {
        good *= share;
    }
    double missed = 1.0;
    for (int k = 1; k < most; ++k) {
        missed *= 1.0 - good;
        if (missed < kMayMiss) {
            return k;
        }
    }
    return most;
}

}  // namespace semtrack

#endif
