#include "estimate/ground/road_shape.hpp"

#include <array>
#include <cmath>

namespace semtrack {

namespace {

constexpr std::array<double, 6> kKnees_m{6.0, 10.0, 14.0, 18.0, 22.0, 26.0};
constexpr int kBends = 32;           // tried at each, each through two points
constexpr double kLeastArm_m = 2.0;  // from one to the other
constexpr double kMostStep_m = 0.4;  // at the knee, which lies up to 4 m beside the one tried
constexpr double kLeastLength_m = 6.0;
constexpr int kLeastPoints = 10;
constexpr double kLeastShare = 0.5;    // of the points on that side of the knee
constexpr double kGate = 3.0;          // sigmas
constexpr double kRoadSigma_m = 0.06;  // as ground contact admits
constexpr double kRoadSigmaPerMetre = 0.004;

/// A point of the height profile on one side of a knee.
struct ProfilePoint {
    double ahead_m{0};
    double arm_m{0};  ///< distance from the knee, positive on this side
    double r_m{0};    ///< above the plane
    double variance{0};
};
using Profile = StaticVector<ProfilePoint, kMaxBackgroundFeatures>;

Profile profile_of(const RoadPoints& lane, const Vec3& plane, double knee_m, double side) {
    Profile out;
    for (const RoadPoint& p : lane) {
        const double arm = side * (p.ahead_m - knee_m);
        const double r = road_residual(p, plane);
        if (arm > 0.0 && std::isfinite(r) && std::isfinite(p.sigma_m) && p.sigma_m > 0.0) {
            (void)out.try_push_back({p.ahead_m, arm, r, p.sigma_m * p.sigma_m});  // as many places as the lane has
        }
    }
    return out;
}

struct Surface {
    int points{0};
    double chi2{0};
};

/// The points of a profile that follow the line step + bend arm.
Surface surface_of(const Profile& profile, double step_m, double bend) {
    Surface out;
    double nearest = 1e9;
    double farthest = 0.0;
    for (const ProfilePoint& p : profile) {
        const double off = p.r_m - step_m - bend * p.arm_m;
        if (off * off > kGate * kGate * (p.variance + kRoadRoughness_m * kRoadRoughness_m)) {
            continue;
        }
        const double admitted = kRoadSigma_m + kRoadSigmaPerMetre * p.ahead_m;
        out.chi2 += p.r_m * p.r_m / (p.variance + admitted * admitted);
        nearest = p.arm_m < nearest ? p.arm_m : nearest;
        farthest = p.arm_m > farthest ? p.arm_m : farthest;
        ++out.points;
    }
    const bool is_surface = out.points >= kLeastPoints && farthest - nearest >= kLeastLength_m &&
                            out.points >= kLeastShare * profile.size();
    if (!is_surface) {
        return Surface{};
    }
    out.chi2 /= out.points;
    return out;
}

Surface best_surface(const Profile& profile) {
    Surface best = surface_of(profile, 0.0, 0.0);
    for (int k = 0; k < kBends && !profile.empty(); ++k) {
        const int i = k * profile.size() / kBends;
        const ProfilePoint& a = profile[i];
        const ProfilePoint& b = profile[(i + profile.size() / 2) % profile.size()];
        if (std::fabs(b.arm_m - a.arm_m) < kLeastArm_m) {
            continue;
        }
        const double bend = (b.r_m - a.r_m) / (b.arm_m - a.arm_m);
        const double step_m = a.r_m - bend * a.arm_m;
        if (std::fabs(step_m) > kMostStep_m) {
            continue;
        }
        const Surface surface = surface_of(profile, step_m, bend);
        if (surface.points > best.points) {
            best = surface;
        }
    }
    return best;
}

}  // namespace

double road_chi2(const RoadPoints& lane, const Vec3& plane) {
    double chi2 = 0.0;
    for (const double side : {1.0, -1.0}) {
        for (const double knee_m : kKnees_m) {
            const Surface surface = best_surface(profile_of(lane, plane, knee_m, side));
            chi2 = surface.chi2 > chi2 ? surface.chi2 : chi2;
        }
    }
    return chi2;
}

bool RoadShape::update(double chi2) {
    const bool speaks_for_change = bent_ ? !(chi2 >= kRoadFall) : chi2 > kRoadRise;
    frames_ = speaks_for_change ? frames_ + 1 : 0;
    if (frames_ >= (bent_ ? kRoadFallFrames : kRoadRiseFrames)) {
        bent_ = !bent_;
        frames_ = 0;
    }
    return bent_;
}

}  // namespace semtrack
