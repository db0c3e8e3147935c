#include "front/ransac/rigid_check.hpp"

#include <cmath>

#include "front/ransac/trials.hpp"
#include "math/camera.hpp"
#include "math/cholesky6.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"

namespace semtrack {

namespace {
constexpr int kTrials = 32;  // three of three are inliers in one of 32 samples down to a share of 58 % (99.9 %)
constexpr int kSample = 3;
constexpr int kSampleIterations = 3;
constexpr int kRefineIterations = 2;
constexpr double kRidge = 1e-3;             // px^2: three points may leave a direction loose: it stays at the start
constexpr float kDisparityDoubt_px = 1.5F;  // three sigma of the disparity that placed the point
constexpr double kNearest_m = 2.0;          // of a point without depth

constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}
}  // namespace

// Lanes are independent and single precision is exact to 1e-3 px here: vectorised without changing a bit.
int RigidCheck::test(const StereoPairs& pairs, const Intrinsics& k, const Pose& T, double threshold_px,
                     PairFlags& agrees) const {
    std::array<float, 9> R{};
    std::array<float, 3> t{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            R[at(3 * r + c)] = static_cast<float>(T.R(r, c));
        }
        t[at(r)] = static_cast<float>(T.t(r));
    }
    const auto fx = static_cast<float>(k.fx);
    const auto fy = static_cast<float>(k.fy);
    const auto fb = static_cast<float>(k.fb);
    const auto limit = static_cast<float>(threshold_px * threshold_px);
    const auto nearest = static_cast<float>(kMinDepth_m);
    int count = 0;
    for (std::size_t i = 0; i < at(pairs.size); ++i) {
        const float x = R[0] * pairs.x[i] + R[1] * pairs.y[i] + R[2] * pairs.z[i] + t[0];
        const float y = R[3] * pairs.x[i] + R[4] * pairs.y[i] + R[5] * pairs.z[i] + t[1];
        const float z = R[6] * pairs.x[i] + R[7] * pairs.y[i] + R[8] * pairs.z[i] + t[2];
        const float inv = 1.0F / (z > nearest ? z : nearest);
        const float xn = x * inv;
        const float yn = y * inv;
        const float du = fx * xn - pairs.u[i];
        const float dv = fy * yn - pairs.v[i];
        const float dd = fb * inv - pairs.d[i];
        const float doubt = kDisparityDoubt_px / pairs.d_before[i];
        const float su = doubt * fx * (t[0] - xn * t[2]) * inv;  // what the doubt moves: d(u, v, d) / d(d_before)
        const float sv = doubt * fy * (t[1] - yn * t[2]) * inv;
        const float sd = doubt * fb * inv * (1.0F - t[2] * inv);
        const int in_u = du * du < limit + su * su ? 1 : 0;
        const int in_v = dv * dv < limit + sv * sv ? 1 : 0;
        const int in_d = dd * dd < limit + sd * sd ? 1 : 0;
        const int inside = in_u & in_v & in_d & (z > nearest ? 1 : 0);
        agrees[i] = static_cast<std::uint8_t>(inside);
        count += inside;
    }
    return count;
}

// No rotation, and the shift of the points; near points say most, their depths are best.
Pose RigidCheck::start(const StereoPairs& pairs, const Intrinsics& k, const int* items, int count) const {
    Pose T;
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    for (int n = 0; n < count; ++n) {
        const std::size_t i = at(items[n]);
        const auto d = static_cast<double>(pairs.d[i]);
        const double z = k.fb / d;
        const Vec3 now(static_cast<double>(pairs.u[i]) * z / k.fx, static_cast<double>(pairs.v[i]) * z / k.fy, z);
        const Vec3 before(static_cast<double>(pairs.x[i]), static_cast<double>(pairs.y[i]),
                          static_cast<double>(pairs.z[i]));
        const double weight = d * d;
        sum += weight * (now - before);
        weights += weight;
    }
    if (weights > 0.0) {
        T.t = sum / weights;
    }
    return T;
}

// Gauss-Newton on the reprojection (u, v, disparity).
bool RigidCheck::refine(const StereoPairs& pairs, const Intrinsics& k, const int* items, int count, Pose& T) const {
    Pose moved = T;
    for (int iteration = 0; iteration < (count > kSample ? kRefineIterations : kSampleIterations); ++iteration) {
        Mat6 H = kRidge * Mat6::Identity();
        Vec6 g = Vec6::Zero();
        for (int n = 0; n < count; ++n) {
            const std::size_t i = at(items[n]);
            const Vec3 x = moved * Vec3(static_cast<double>(pairs.x[i]), static_cast<double>(pairs.y[i]),
                                        static_cast<double>(pairs.z[i]));
            if (!(x(2) > kMinDepth_m)) {
                return false;
            }
            const double inv = 1.0 / x(2);
            const double xn = x(0) * inv;
            const double yn = x(1) * inv;
            const Vec3 r(k.fx * xn - static_cast<double>(pairs.u[i]), k.fy * yn - static_cast<double>(pairs.v[i]),
                         k.fb * inv - static_cast<double>(pairs.d[i]));
            Mat3x6 J;
            J << k.fx * inv, 0.0, -k.fx * xn * inv, -k.fx * xn * yn, k.fx * (1.0 + xn * xn), -k.fx * yn,  //
                0.0, k.fy * inv, -k.fy * yn * inv, -k.fy * (1.0 + yn * yn), k.fy * xn * yn, k.fy * xn,    //
                0.0, 0.0, -k.fb * inv * inv, -k.fb * yn * inv, k.fb * xn * inv, 0.0;
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
        moved = perturbed_left(moved, -step);
    }
    if (!is_finite(moved)) {
        return false;
    }
    T = moved;
    return true;
}

int RigidCheck::run(const StereoPairs& pairs, const Calibration& calibration, double threshold_px, std::uint32_t seed,
                    PairFlags& agrees) {
    if (pairs.size < kMinPairs) {
        return 0;
    }
    const Intrinsics k{calibration.left.fx, calibration.left.fy, calibration.left.fx * calibration.baseline_m};
    Rng rng(seed);
    int best = 0;
    int needed = kTrials;
    for (int trial = 0; trial < needed; ++trial) {
        const int sample[kSample] = {rng.below(pairs.size), rng.below(pairs.size), rng.below(pairs.size)};
        if (sample[0] == sample[1] || sample[1] == sample[2] || sample[0] == sample[2]) {
            continue;
        }
        Pose T = start(pairs, k, sample, kSample);
        if (!refine(pairs, k, sample, kSample, T)) {
            continue;
        }
        const int count = test(pairs, k, T, threshold_px, trial_);
        if (count > best) {
            best = count;
            agrees = trial_;
            motion_ = T;
            needed = trials_needed(best, pairs.size, kSample, kTrials);
        }
    }
    if (best < kMinPairs) {
        return 0;
    }
    for (int round = 0; round < 2; ++round) {
        int used = 0;
        for (int i = 0; i < pairs.size; ++i) {
            items_[at(used)] = i;
            used += agrees[at(i)];
        }
        Pose T = motion_;
        if (!refine(pairs, k, items_.data(), used, T)) {
            break;
        }
        const int count = test(pairs, k, T, threshold_px, trial_);
        if (count < best) {
            break;
        }
        best = count;
        agrees = trial_;
        motion_ = T;
    }
    return best;
}

bool RigidCheck::fits_some_depth(const Calibration& calibration, double u_before, double v_before, double u, double v,
                                 double threshold_px) const {
    const Vec3 ray(u_before / calibration.left.fx, v_before / calibration.left.fy, 1.0);
    const Vec3 far = motion_.R * ray;
    const Vec3 near = kNearest_m * far + motion_.t;
    if (!(far(2) > 0.1) || !(near(2) > kMinDepth_m)) {
        return true;  // this near it could be anywhere
    }
    const Vec2 a(calibration.left.fx * far(0) / far(2), calibration.left.fy * far(1) / far(2));
    const Vec2 b(calibration.left.fx * near(0) / near(2), calibration.left.fy * near(1) / near(2));
    const Vec2 line = b - a;
    const Vec2 seen = Vec2(u, v) - a;
    const double length2 = line.dot(line);
    double along = length2 > 0.0 ? seen.dot(line) / length2 : 0.0;
    along = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    const Vec2 off = seen - along * line;
    return off.dot(off) < threshold_px * threshold_px;
}

}  // namespace semtrack
