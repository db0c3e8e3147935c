#include "estimate/ground/road_fit.hpp"

#include <cmath>

#include "math/rng.hpp"
#include "math/robust.hpp"

namespace semtrack {

namespace {

constexpr int kTrials = 64;  // with 40 % outliers one of three-point samples in five is clean
constexpr int kPasses = 5;
constexpr double kGate = 3.0;                // sigmas
constexpr double kDisparitySigma_px = 0.15;  // of a calibration, the same over the road

Vec3 row_of(const RoadPoint& p) {
    return {-1.0, p.ahead_m, p.left_m};
}

double variance_of(const RoadPoint& p) {
    return p.sigma_m * p.sigma_m + kRoadRoughness_m * kRoadRoughness_m;
}

bool usable(const RoadPoint& p) {
    return std::isfinite(p.ahead_m + p.left_m + p.up_m + p.per_px) && std::isfinite(p.sigma_m) && p.sigma_m > 0.0;
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

struct Sums {
    Mat3 A{Mat3::Zero()};
    Vec3 b{Vec3::Zero()};
    Vec3 by_disparity{Vec3::Zero()};
    double disparity{1.0 / (kDisparitySigma_px * kDisparitySigma_px)};
    double disparity_vector{0};
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
            by_disparity += (w * p.per_px) * a;
            disparity += w * p.per_px * p.per_px;
            disparity_vector += w * p.per_px * p.up_m;
        }
        // b is marginalised: one row of the normal equations less.
        A -= (1.0 / disparity) * (by_disparity * by_disparity.transpose());
        b -= (disparity_vector / disparity) * by_disparity;
    }
};

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
        if (cost < least) {
            least = cost;
            plane = candidate;
        }
    }
    for (int pass = 0; pass < kPasses; ++pass) {
        const Sums sums(points, plane);
        const Mat3 A = prior.information + sums.A;
        plane = A.inverse() * (prior.information * prior.mean + sums.b);
    }
    const Sums sums(points, plane);
    out.valid = sums.inliers >= kMinRoadPoints && std::isfinite(plane.sum());
    out.information = sums.A;
    out.vector = sums.b;
    out.plane = plane;
    out.inliers = sums.inliers;
    return out;
}

}  // namespace semtrack
