#include "front/ransac/reject.hpp"

#include <cmath>

#include "front/ransac/trials.hpp"
#include "math/camera.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {

constexpr int kBackgroundTrials = 96;  // seven of seven are inliers once in 96 down to a share of 63 % (98 %)
constexpr int kObjectTrials = 48;
constexpr int kSample = 7;
constexpr int kRefits = 3;  // of each new best consensus
constexpr double kSmallestNorm2 = 1e-12;
constexpr int kMinTracked = 5;
constexpr int kMinForFundamental = 8;  // seven pairs are met by any matches
constexpr double kSampson_px = 1.0;
constexpr double kRigid_px = 2.0;
constexpr double kSlow_px = 1.0;      // flow below which a pair says nothing about the epipolar geometry
constexpr double kStanding_px = 3.0;  // flow that cannot be noise where the others stand
constexpr double kMinDisparity_px = 0.5;
constexpr double kLargest_px = 1e5;  // coordinates beyond are no pixels; squares and cubes stay finite

constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

bool is_pixel(float x) {
    return std::fabs(static_cast<double>(x)) < kLargest_px;  // false for NaN
}

bool is_sane(const FeatureMeasurement& m) {
    if (m.owner >= kMaxOwners || !is_pixel(m.u) || !is_pixel(m.v) || (m.stereo && !is_pixel(m.u_right))) {
        return false;
    }
    if (!m.tracked) {
        return true;
    }
    return is_pixel(m.previous_u) && is_pixel(m.previous_v) && (!m.previous_stereo || is_pixel(m.previous_u_right));
}

double flow_px(const FeatureMeasurement& m) {  // chessboard distance
    const double du = std::fabs(static_cast<double>(m.u) - static_cast<double>(m.previous_u));
    const double dv = std::fabs(static_cast<double>(m.v) - static_cast<double>(m.previous_v));
    return du > dv ? du : dv;
}

}  // namespace

void OutlierRejection::collect(const FrameFeatures& features, int begin, int end) {
    pairs_.size = 0;
    for (int i = begin; i < end; ++i) {
        if (features[i].tracked && inlier_[at(i)] && pairs_.size < static_cast<int>(kMaxPairs)) {
            index_[at(pairs_.size++)] = i;
        }
    }
}

// Hartley's normalisation with one scale for both images, from the mean absolute deviation.
void OutlierRejection::scale_pairs(const FrameFeatures& features) {
    const int n = pairs_.size;
    std::array<double, 4>& mean = mean_;
    mean.fill(0.0);
    for (int k = 0; k < n; ++k) {
        const FeatureMeasurement& m = features[index_[at(k)]];
        mean[0] += static_cast<double>(m.previous_u);
        mean[1] += static_cast<double>(m.previous_v);
        mean[2] += static_cast<double>(m.u);
        mean[3] += static_cast<double>(m.v);
    }
    for (double& x : mean) {
        x /= n;
    }
    double spread = 0.0;
    for (int k = 0; k < n; ++k) {
        const FeatureMeasurement& m = features[index_[at(k)]];
        spread += std::fabs(static_cast<double>(m.u) - mean[2]) + std::fabs(static_cast<double>(m.v) - mean[3]);
    }
    spread = spread / (2.0 * n) > 1.0 ? spread / (2.0 * n) : 1.0;
    pairs_.px_per_unit = static_cast<float>(spread);
    for (int k = 0; k < n; ++k) {
        const FeatureMeasurement& m = features[index_[at(k)]];
        pairs_.px[at(k)] = static_cast<float>((static_cast<double>(m.previous_u) - mean[0]) / spread);
        pairs_.py[at(k)] = static_cast<float>((static_cast<double>(m.previous_v) - mean[1]) / spread);
        pairs_.qx[at(k)] = static_cast<float>((static_cast<double>(m.u) - mean[2]) / spread);
        pairs_.qy[at(k)] = static_cast<float>((static_cast<double>(m.v) - mean[3]) / spread);
    }
}

void OutlierRejection::collect_stereo(const FrameFeatures& features, const Calibration& calibration) {
    const double fb = calibration.left.fx * calibration.baseline_m;
    stereo_.size = 0;
    for (int k = 0; k < pairs_.size; ++k) {
        const FeatureMeasurement& m = features[index_[at(k)]];
        depth_[at(k)] = 0;
        if (!m.stereo || !m.previous_stereo) {
            continue;
        }
        const auto u0 = static_cast<double>(m.previous_u);
        const auto u1 = static_cast<double>(m.u);
        const double d0 = disparity(calibration, u0, static_cast<double>(m.previous_u_right));
        const double d1 = disparity(calibration, u1, static_cast<double>(m.u_right));
        if (!(d0 > kMinDisparity_px) || !(d1 > kMinDisparity_px)) {
            continue;
        }
        const std::size_t s = at(stereo_.size++);
        depth_[at(k)] = 1;
        stereo_pair_[s] = k;
        const double z = fb / d0;
        stereo_.x[s] = static_cast<float>((u0 - calibration.left.cx) * z / calibration.left.fx);
        stereo_.y[s] =
            static_cast<float>((static_cast<double>(m.previous_v) - calibration.left.cy) * z / calibration.left.fy);
        stereo_.z[s] = static_cast<float>(z);
        stereo_.d_before[s] = static_cast<float>(d0);
        stereo_.u[s] = static_cast<float>(u1 - calibration.left.cx);
        stereo_.v[s] = static_cast<float>(static_cast<double>(m.v) - calibration.left.cy);
        stereo_.d[s] = static_cast<float>(d1);
    }
}

// Keeps f and its consensus if that is larger than the best so far.
bool OutlierRejection::improves(const Fundamental& f) {
    const int count = test_fundamental(pairs_, f, kSampson_px, agrees_);
    if (count <= best_count_) {
        return false;
    }
    best_count_ = count;
    best_f_ = f;
    best_ = agrees_;
    return true;
}

// Fits the best matrix to its consensus as long as that grows: seven noisy pairs alone miss many inliers.
void OutlierRejection::polish() {
    bool better = true;
    for (int round = 0; round < kRefits && better; ++round) {
        Fundamental f = best_f_;
        better = refit_fundamental(pairs_, best_, f) && improves(f);
    }
}

// F = K^-T [t]x R K^-1, in the units of pairs_.
bool OutlierRejection::fundamental_of_motion(const Calibration& calibration, Fundamental& f) const {
    const Pose& T = rigid_check_.motion();
    const PinholeCamera& c = calibration.left;
    const auto scale = static_cast<double>(pairs_.px_per_unit);
    Mat3 from_p;  // units of pairs_ -> bearing
    Mat3 from_q;
    from_p << scale / c.fx, 0.0, (mean_[0] - c.cx) / c.fx, 0.0, scale / c.fy, (mean_[1] - c.cy) / c.fy, 0.0, 0.0, 1.0;
    from_q << scale / c.fx, 0.0, (mean_[2] - c.cx) / c.fx, 0.0, scale / c.fy, (mean_[3] - c.cy) / c.fy, 0.0, 0.0, 1.0;
    const Mat3 tR = skew(T.t) * T.R;
    const Mat3 left = from_q.transpose() * tR;
    const Mat3 F = left * from_p;
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        f[at(i)] = F(i / 3, i % 3);
        sum += f[at(i)] * f[at(i)];
    }
    if (!(sum > kSmallestNorm2) || !std::isfinite(sum)) {
        return false;  // a turn on the spot has no epipolar geometry
    }
    const double inverse = 1.0 / std::sqrt(sum);
    for (double& x : f) {
        x *= inverse;
    }
    return true;
}

// best_ then flags the pairs of the consensus. false: no majority agrees on a geometry. A motion that most stereo pairs
// share gives the matrix at once (three of them are a sample, not seven); samples of seven pairs decide otherwise.
bool OutlierRejection::run_fundamental(const Calibration& calibration, int rigid, int trials, std::uint32_t seed) {
    const int n = pairs_.size;
    best_count_ = 0;
    Fundamental f{};
    if (rigid > 0 && fundamental_of_motion(calibration, f) && improves(f)) {
        polish();
        if (best_count_ > kSample && 2 * best_count_ >= n && 10 * best_count_ >= 9 * rigid) {
            return true;
        }
    }
    Rng rng(seed);
    int needed = trials;
    for (int trial = 0; trial < needed; ++trial) {
        std::array<int, kSample> sample{};
        for (int& s : sample) {
            s = rng.below(n);  // a pair drawn twice makes the sample singular: no solution
        }
        solve_seven_points(pairs_, sample, solutions_);
        for (int s = 0; s < solutions_.count; ++s) {
            if (improves(solutions_.f[at(s)])) {
                polish();
                needed = trials_needed(best_count_, n, kSample, trials);
            }
        }
    }
    return best_count_ > kSample && 2 * best_count_ >= n;
}

int OutlierRejection::slow_pairs(const FrameFeatures& features) const {
    int slow = 0;
    for (int k = 0; k < pairs_.size; ++k) {
        slow += flow_px(features[index_[at(k)]]) < kSlow_px ? 1 : 0;
    }
    return slow;
}

void OutlierRejection::apply_rigid(const FrameFeatures& features, const Calibration& calibration, bool epipolar) {
    for (int s = 0; s < stereo_.size; ++s) {
        if (rigid_[at(s)] == 0) {
            inlier_[at(index_[at(stereo_pair_[at(s)])])] = false;
        }
    }
    for (int k = 0; k < pairs_.size; ++k) {
        if (depth_[at(k)] != 0 || epipolar) {
            continue;
        }
        const FeatureMeasurement& m = features[index_[at(k)]];
        const bool fits = rigid_check_.fits_some_depth(
            calibration, static_cast<double>(m.previous_u) - calibration.left.cx,
            static_cast<double>(m.previous_v) - calibration.left.cy, static_cast<double>(m.u) - calibration.left.cx,
            static_cast<double>(m.v) - calibration.left.cy, kRigid_px);
        if (!fits) {
            inlier_[at(index_[at(k)])] = false;
        }
    }
}

void OutlierRejection::judge(const FrameFeatures& features, int begin, int end, const Calibration& calibration,
                             std::uint32_t frame) {
    collect(features, begin, end);
    const int n = pairs_.size;
    if (n < kMinTracked) {
        return;
    }
    const int owner = features[begin].owner;
    const std::uint32_t seed = frame * 64U + static_cast<std::uint32_t>(owner);
    collect_stereo(features, calibration);
    int rigid = rigid_check_.run(stereo_, calibration, kRigid_px, seed, rigid_);
    rigid = 2 * rigid >= stereo_.size ? rigid : 0;
    const bool stands = 2 * slow_pairs(features) > n;
    bool epipolar = false;
    if (!stands && n >= kMinForFundamental) {
        scale_pairs(features);
        epipolar = run_fundamental(calibration, rigid, owner == kBackground ? kBackgroundTrials : kObjectTrials, seed);
    }
    for (int k = 0; epipolar && k < n; ++k) {
        inlier_[at(index_[at(k)])] = best_[at(k)] != 0;
    }
    if (rigid > 0) {
        apply_rigid(features, calibration, epipolar);
    } else if (stands) {
        for (int k = 0; k < n; ++k) {
            inlier_[at(index_[at(k)])] = flow_px(features[index_[at(k)]]) < kStanding_px;
        }
    }
}

void OutlierRejection::run(const FrameFeatures& features, const Calibration& calibration, std::uint32_t frame) {
    rejected_.fill(0);
    for (int i = 0; i < features.size(); ++i) {
        inlier_[at(i)] = is_sane(features[i]);
    }
    const bool usable = calibration.left.fx > 0.0 && calibration.left.fy > 0.0 && calibration.baseline_m > 0.0;
    int begin = 0;
    for (int i = 1; i <= features.size() && usable; ++i) {
        if (i < features.size() && features[i].owner == features[begin].owner) {
            continue;
        }
        if (features[begin].owner < kMaxOwners) {
            judge(features, begin, i, calibration, frame);
        }
        begin = i;
    }
    for (int i = 0; i < features.size(); ++i) {
        if (!inlier_[at(i)] && features[i].owner < kMaxOwners) {
            ++rejected_[at(features[i].owner)];
        }
    }
}

}  // namespace semtrack
