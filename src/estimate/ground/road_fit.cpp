#include "estimate/ground/road_fit.hpp"

#include <cmath>

#include "math/rng.hpp"
#include "math/robust.hpp"

namespace semtrack {

namespace {

constexpr int kTrials = 64;  // with 40 % outliers one of three-point samples in five is clean
constexpr int kPasses = 5;   // of the fit, and 2 for each plane that is better than those before
constexpr int kTrialPasses = 2;
constexpr double kGate = 3.0;  // sigmas
// What all points of a frame, and of the next ones, have in common:
constexpr double kHeightSigma_m = 0.1;        // where boxes are drawn to end: labelled cars stand 0.04 m in the road
constexpr double kSlopeForwardSigma = 0.005;  // 0.4 px of disparity are 0.0017 on KITTI; roads bend
constexpr double kSlopeLeftSigma = 0.01;      // crown

Vec3 row_of(const RoadPoint& p) {
    return {-1.0, p.ahead_m, p.left_m};
}

double variance_of(const RoadPoint& p) {
    return p.sigma_m * p.sigma_m + kRoadRoughness_m * kRoadRoughness_m;
}

bool usable(const RoadPoint& p) {
    return std::isfinite(p.ahead_m + p.left_m + p.up_m) && std::isfinite(p.sigma_m) && p.sigma_m > 0.0;
}

double prior_cost(const RoadPrior& prior, const Vec3& plane) {
    const Vec3 d = plane - prior.mean;
    return d.dot(prior.information * d);
}

double truncated_cost(const RoadPoints& points, const RoadPrior& prior, const Vec3& plane, double least) {
    double cost = prior_cost(prior, plane);
    for (const RoadPoint& p : points) {
        if (!(cost < least)) {
            break;
        }
        const double r = road_residual(p, plane);
        const double r2 = r * r / variance_of(p);
        cost += r2 < kGate * kGate ? r2 : kGate * kGate;
    }
    return cost;
}

/// The prior and three points: always solvable, also when they lie on one line.
Vec3 plane_through(const RoadPoints& points, const RoadPrior& prior, Rng& rng) {
    Mat3 A = prior.information;
    Vec3 b = prior.information * prior.mean;
    for (int k = 0; k < 3; ++k) {
        const RoadPoint& p = points[rng.below(points.size())];
        const Vec3 a = row_of(p);
        const double w = 1.0 / variance_of(p);
        A += w * (a * a.transpose());
        b += (w * p.up_m) * a;
    }
    return A.inverse() * b;
}

/// Weighted normal equations of the points about a plane.
struct Sums {
    Mat3 A{Mat3::Zero()};
    Vec3 b{Vec3::Zero()};
    int inliers{0};

    Sums(const RoadPoints& points, const Vec3& plane) {
        for (const RoadPoint& p : points) {
            const double variance = variance_of(p);
            const double r = road_residual(p, plane);
            const double w = tukey(r * r / variance, kGate).weight / variance;
            const Vec3 a = row_of(p);
            inliers += w > 0.0 ? 1 : 0;
            A += w * (a * a.transpose());
            b += (w * p.up_m) * a;
        }
    }
};

/// Evidence whose plane has, beside the points' noise, an error of covariance S: (A^-1 + S)^-1 = S^-1 (A + S^-1)^-1 A.
void add_common_error(Mat3& A, Vec3& b) {
    const Vec3 sigma(kHeightSigma_m, kSlopeForwardSigma, kSlopeLeftSigma);
    const Vec3 weight = sigma.cwiseProduct(sigma).cwiseInverse();
    const Mat3 S_inverse = weight.asDiagonal();
    const Mat3 share = S_inverse * (A + S_inverse).inverse();
    const Mat3 reduced = share * A;
    A = 0.5 * (reduced + reduced.transpose());
    b = share * b;
}

Vec3 refined(const RoadPoints& points, const RoadPrior& prior, const Vec3& start, int passes) {
    Vec3 plane = start;
    for (int pass = 0; pass < passes; ++pass) {
        const Sums sums(points, plane);
        plane = (prior.information + sums.A).inverse() * (prior.information * prior.mean + sums.b);
    }
    return plane;
}

}  // namespace

RoadFit fit_road(const RoadPoints& all, const RoadPrior& prior, std::uint32_t seed) {
    RoadFit out;
    RoadPoints points;
    for (const RoadPoint& p : all) {
        if (usable(p)) {
            (void)points.try_push_back(p);  // as many places as all has
        }
    }
    if (points.size() < kMinRoadPoints) {
        return out;
    }
    Rng rng(seed);
    Vec3 plane = prior.mean;
    double least = truncated_cost(points, prior, plane, 1e300);
    for (int trial = 0; trial < kTrials; ++trial) {
        const Vec3 candidate = plane_through(points, prior, rng);
        const double cost = truncated_cost(points, prior, candidate, least);
        if (!(cost < least)) {
            continue;
        }
        // Three points carry their noise: what they stand for shows after a fit.
        const Vec3 fitted = refined(points, prior, candidate, kTrialPasses);
        const double fitted_cost = truncated_cost(points, prior, fitted, cost);
        plane = fitted_cost < cost ? fitted : candidate;
        least = fitted_cost < cost ? fitted_cost : cost;
    }
    plane = refined(points, prior, plane, kPasses);
    const Sums sums(points, plane);
    out.valid = sums.inliers >= kMinRoadPoints && std::isfinite(plane.sum());
    out.information = sums.A;
    out.vector = sums.b;
    add_common_error(out.information, out.vector);
    out.plane = plane;
    out.inliers = sums.inliers;
    return out;
}

}  // namespace semtrack
