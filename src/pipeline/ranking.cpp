#include "pipeline/ranking.hpp"

#include <array>
#include <cmath>

#include "math/trig.hpp"

namespace semtrack {

namespace {

constexpr double kCoastingScore = 0.4;  // per frame without detection
constexpr int kLongestCoast = 20;
constexpr double kFramesForTrust = 3.0;

struct Node {
    double s;  // sigmas
    double share;
};
// Normal distribution in steps of 0.2 sigma, both sides together.
constexpr std::array<Node, 16> kNodes{{{0.0, 0.0799},
                                       {0.2, 0.1567},
                                       {0.4, 0.1476},
                                       {0.6, 0.1335},
                                       {0.8, 0.1161},
                                       {1.0, 0.0970},
                                       {1.2, 0.0778},
                                       {1.4, 0.0600},
                                       {1.6, 0.0445},
                                       {1.8, 0.0316},
                                       {2.0, 0.0216},
                                       {2.2, 0.0142},
                                       {2.4, 0.0090},
                                       {2.6, 0.0054},
                                       {2.8, 0.0032},
                                       {3.0, 0.0018}}};

double absolute(double x) {
    return x < 0.0 ? -x : x;
}

}  // namespace

double expected_overlap(double length_m, double width_m, double cos_a, double sin_a, double sigma_m) {
    const double whole = length_m * width_m;
    double mean = 0.0;
    for (const Node& node : kNodes) {
        const double s = node.s * sigma_m;
        const double l = length_m - absolute(s * cos_a);
        const double w = width_m - absolute(s * sin_a);
        const double common = l > 0.0 && w > 0.0 ? l * w : 0.0;
        mean += node.share * common / (2.0 * whole - common);
    }
    return mean;
}

double ranking_score(const Track& track) {
    const ObjectFrame& frame = track.window.newest();
    const Vec3 ray = frame.state.p + frame.T_c_l.R.transpose() * frame.T_c_l.t;
    const double distance = std::sqrt(ray(0) * ray(0) + ray(1) * ray(1));
    const double ux = distance > 0.1 ? ray(0) / distance : 1.0;
    const double uy = distance > 0.1 ? ray(1) / distance : 0.0;
    const Mat6& C = track.window.covariance;
    const double variance = ux * ux * C(0, 0) + 2.0 * ux * uy * C(0, 1) + uy * uy * C(1, 1);
    const SinCos h = sin_cos(frame.state.theta);
    const Vec3& size = track.window.size_m;
    const double overlap = expected_overlap(size(0), size(1), h.cos * ux + h.sin * uy, h.sin * ux - h.cos * uy,
                                            std::sqrt(variance > 0.0 ? variance : 0.0));
    const double n = static_cast<double>(track.hits);
    double score =
        track.existence * track.detector_score * n / (n + kFramesForTrust) * overlap * (1.0 - track.truncation);
    for (int k = 0; k < track.frames_unseen && k < kLongestCoast; ++k) {
        score *= kCoastingScore;
    }
    return score < 0.0 ? 0.0 : score > 1.0 ? 1.0 : score;
}

}  // namespace semtrack
