#include "front/ransac/reject.hpp"

#include <cmath>

#include "math/camera.hpp"
#include "math/rng.hpp"

namespace semtrack {

namespace {

constexpr int kBackgroundTrials = 48;
constexpr int kObjectTrials = 24;
constexpr double kSampson_px = 1.5;
constexpr double kRigid_px = 3.0;
constexpr int kMinForFundamental = 14;  // twice the sample: fewer prove nothing
constexpr double kMinFlow_px = 1.0;     // median; below, the epipolar geometry is degenerate
constexpr double kMajority = 0.5;       // a model of fewer is not the owner's motion

}  // namespace

void OutlierRejection::collect(const FrameFeatures& features, int begin, int end, const Calibration& calibration) {
    const double cx = calibration.left.cx;
    const double cy = calibration.left.cy;
    const double fb = calibration.left.fx * calibration.baseline_m;
    pairs_.size = 0;
    stereo_.size = 0;
    pairs_.px_per_unit = static_cast<float>(calibration.left.fx);
    const double unit = 1.0 / static_cast<double>(pairs_.px_per_unit);
    for (int i = begin; i < end; ++i) {
        const FeatureMeasurement& m = features[i];
        if (!m.tracked || pairs_.size == static_cast<int>(kMaxPairs)) {
            continue;
        }
        const auto k = static_cast<std::size_t>(pairs_.size++);
        index_[k] = i;
        const double pu = static_cast<double>(m.previous_u) - cx;
        const double pv = static_cast<double>(m.previous_v) - cy;
        const double qu = static_cast<double>(m.u) - cx;
        const double qv = static_cast<double>(m.v) - cy;
        pairs_.px[k] = static_cast<float>(pu * unit);
        pairs_.py[k] = static_cast<float>(pv * unit);
        pairs_.qx[k] = static_cast<float>(qu * unit);
        pairs_.qy[k] = static_cast<float>(qv * unit);
        if (!m.stereo || !m.previous_stereo) {
            continue;
        }
        const double d0 =
            disparity(calibration, static_cast<double>(m.previous_u), static_cast<double>(m.previous_u_right));
        const double d1 = disparity(calibration, static_cast<double>(m.u), static_cast<double>(m.u_right));
        if (!(d0 > 0.5) || !(d1 > 0.5)) {
            continue;
        }
        const auto s = static_cast<std::size_t>(stereo_.size++);
        stereo_pair_[s] = static_cast<int>(k);
        const double z = fb / d0;
        stereo_.x[s] = static_cast<float>(pu * z / calibration.left.fx);
        stereo_.y[s] = static_cast<float>(pv * z / calibration.left.fy);
        stereo_.z[s] = static_cast<float>(z);
        stereo_.d_before[s] = static_cast<float>(d0);
        stereo_.u[s] = static_cast<float>(qu);
        stereo_.v[s] = static_cast<float>(qv);
        stereo_.d[s] = static_cast<float>(d1);
    }
}

bool OutlierRejection::run_fundamental(int owner, std::uint32_t frame) {
    const int n = pairs_.size;
    double flow = 0.0;
    for (int i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        flow += std::fabs(static_cast<double>(pairs_.qx[k] - pairs_.px[k])) +
                std::fabs(static_cast<double>(pairs_.qy[k] - pairs_.py[k]));
    }
    if (n < kMinForFundamental || flow * static_cast<double>(pairs_.px_per_unit) < kMinFlow_px * n) {
        return false;
    }
    Rng rng(frame * 64U + static_cast<std::uint32_t>(owner));
    const int trials = owner == kBackground ? kBackgroundTrials : kObjectTrials;
    int best = 0;
    Fundamental best_f{};
    for (int trial = 0; trial < trials; ++trial) {
        std::array<int, 7> sample{};
        for (int& s : sample) {
            s = rng.below(n);
        }  // a doubled pair makes the sample degenerate: no solution
        solve_seven_points(pairs_, sample, solutions_);
        for (int s = 0; s < solutions_.count; ++s) {
            const Fundamental& f = solutions_.f[static_cast<std::size_t>(s)];
            const int count = test_fundamental(pairs_, f, kSampson_px, agrees_);
            if (count > best) {
                best = count;
                best_f = f;
                best_ = agrees_;
            }
        }
    }
    if (best < kMajority * n) {
        return false;
    }
    if (refit_fundamental(pairs_, best_, best_f) && test_fundamental(pairs_, best_f, kSampson_px, agrees_) >= best) {
        best_ = agrees_;
    }
    return true;
}

void OutlierRejection::judge(const FrameFeatures& features, const Calibration& calibration, int owner,
                             std::uint32_t frame) {
    int begin = 0;
    while (begin < features.size() && features[begin].owner < owner) {
        ++begin;
    }
    int end = begin;
    while (end < features.size() && features[end].owner == owner) {
        ++end;
    }
    if (begin == end) {
        return;
    }
    collect(features, begin, end, calibration);
    const bool epipolar = run_fundamental(owner, frame);
    for (int i = 0; epipolar && i < pairs_.size; ++i) {
        if (best_[static_cast<std::size_t>(i)] == 0) {
            inlier_[static_cast<std::size_t>(index_[static_cast<std::size_t>(i)])] = false;
        }
    }
    if (!epipolar) {
        const double fb = calibration.left.fx * calibration.baseline_m;
        const int rigid = rigid_check_.run(stereo_, calibration.left.fx, fb, kRigid_px,
                                           frame * 64U + static_cast<std::uint32_t>(owner), rigid_);
        for (int s = 0; rigid >= kMajority * stereo_.size && s < stereo_.size && rigid > 0; ++s) {
            const int pair = stereo_pair_[static_cast<std::size_t>(s)];
            if (rigid_[static_cast<std::size_t>(s)] == 0) {
                inlier_[static_cast<std::size_t>(index_[static_cast<std::size_t>(pair)])] = false;
            }
        }
    }
    for (int i = begin; i < end; ++i) {
        rejected_[static_cast<std::size_t>(owner)] += inlier_[static_cast<std::size_t>(i)] ? 0 : 1;
    }
}

void OutlierRejection::run(const FrameFeatures& features, const Calibration& calibration, std::uint32_t frame) {
    inlier_.fill(true);
    rejected_.fill(0);
    for (int owner = 0; owner < kMaxOwners; ++owner) {
        judge(features, calibration, owner, frame);
    }
}

}  // namespace semtrack
