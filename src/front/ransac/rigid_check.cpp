#include "front/ransac/rigid_check.hpp"

#include <cmath>

#include "math/camera.hpp"
#include "math/cholesky6.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {
constexpr int kTrials = 24;
constexpr int kMinPairs = 4;
constexpr int kIterations = 4;
constexpr double kRidge = 1e-6;  // three points may leave a direction loose: it stays at the start
}  // namespace

int RigidCheck::test(const StereoPairs& pairs, const Pose& T, double focal_px, double fb, double threshold_px,
                     PairFlags& agrees) const {
    int count = 0;
    for (int i = 0; i < pairs.size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 x =
            T * Vec3(static_cast<double>(pairs.x[k]), static_cast<double>(pairs.y[k]), static_cast<double>(pairs.z[k]));
        agrees[k] = 0;
        if (!(x(2) > kMinDepth_m)) {
            continue;
        }
        const double du = focal_px * x(0) / x(2) - static_cast<double>(pairs.u[k]);
        const double dv = focal_px * x(1) / x(2) - static_cast<double>(pairs.v[k]);
        const double dd = fb / x(2) - static_cast<double>(pairs.d[k]);
        agrees[k] = du * du + dv * dv + dd * dd < threshold_px * threshold_px ? 1 : 0;
        count += agrees[k];
    }
    return count;
}

// Gauss-Newton on the reprojection (u, v, disparity) from no motion: image motions between frames are small.
bool RigidCheck::refine(const StereoPairs& pairs, const PairFlags* use, const int* sample, int count, double focal_px,
                        double fb, Pose& T) const {
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        Mat6 H = kRidge * Mat6::Identity();
        Vec6 g = Vec6::Zero();
        for (int i = 0; i < count; ++i) {
            const auto k = static_cast<std::size_t>(sample != nullptr ? sample[i] : i);
            if (use != nullptr && (*use)[k] == 0) {
                continue;
            }
            const Vec3 x = T * Vec3(static_cast<double>(pairs.x[k]), static_cast<double>(pairs.y[k]),
                                    static_cast<double>(pairs.z[k]));
            if (!(x(2) > kMinDepth_m)) {
                return false;
            }
            const double inv = 1.0 / x(2);
            const Vec3 r(focal_px * x(0) * inv - static_cast<double>(pairs.u[k]),
                         focal_px * x(1) * inv - static_cast<double>(pairs.v[k]),
                         fb * inv - static_cast<double>(pairs.d[k]));
            Mat3 J_x;
            J_x << focal_px * inv, 0.0, -focal_px * x(0) * inv * inv, 0.0, focal_px * inv, -focal_px * x(1) * inv * inv,
                0.0, 0.0, -fb * inv * inv;
            Mat3x6 J;
            J.leftCols<3>() = J_x;
            J.rightCols<3>() = -(J_x * skew(x));
            H += J.transpose() * J;
            g += J.transpose() * r;
        }
        Vec6 step;
        if (!solve6(H, g, step) || !(step.dot(step) < 1e4)) {
            return false;
        }
        const Vec3 turn(step(3), step(4), step(5));
        if (!(turn.dot(turn) < 1.0)) {
            return false;
        }
        T = perturbed_left(T, -step);
    }
    return is_finite(T);
}

int RigidCheck::run(const StereoPairs& pairs, double focal_px, double fb, double threshold_px, std::uint32_t seed,
                    PairFlags& agrees) {
    if (pairs.size < kMinPairs) {
        return 0;
    }
    Rng rng(seed);
    int best = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        int sample[3] = {rng.below(pairs.size), rng.below(pairs.size), rng.below(pairs.size)};
        if (sample[0] == sample[1] || sample[1] == sample[2] || sample[0] == sample[2]) {
            continue;
        }
        Pose T;
        if (!refine(pairs, nullptr, sample, 3, focal_px, fb, T)) {
            continue;
        }
        const int count = test(pairs, T, focal_px, fb, threshold_px, trial_);
        if (count > best) {
            best = count;
            agrees = trial_;
        }
    }
    if (best < kMinPairs) {
        return 0;
    }
    Pose T;
    if (!refine(pairs, &agrees, nullptr, pairs.size, focal_px, fb, T)) {
        return best;
    }
    const int count = test(pairs, T, focal_px, fb, threshold_px, trial_);
    if (count >= best) {
        best = count;
        agrees = trial_;
    }
    return best;
}

}  // namespace semtrack
