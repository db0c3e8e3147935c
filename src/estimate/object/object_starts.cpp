#include "estimate/object/object_starts.hpp"

#include <array>
#include <cmath>

#include "math/so3.hpp"
#include "math/sort.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"
#include "model/stand_point.hpp"

namespace semtrack {

namespace {

constexpr double kWrongViewCost = 2.0;   // of a frame whose faces are others than the detector says
constexpr double kNextViewCost = 0.5;    // ... by one class
constexpr double kReverseCost = 3.0;     // of driving backwards, when no viewpoint was given: one in twenty
constexpr double kReverseSpeed = 0.5;    // m/s
constexpr double kOutsideSigma_m = 0.2;  // mirrors and bumpers, and the label's own tightness
constexpr double kOutsideMost2 = 4.0;    // a point that is not on the object counts as two sigmas
constexpr int kIndependentPoints = 3;
constexpr int kLeastLandmarks = 4;
constexpr double kBesideBox_m = 1.0;  // further than any mirror or error of a size
constexpr double kMaxTurn_rad = 1.2;        // to a twin
constexpr double kBesideMiddle_rad = 0.35;  // of a class of two faces, which spans 1.4 rad
constexpr double kPathSpeed = 1.5;          // m/s: slower ones have no direction
constexpr double kShortestPath_s = 0.25;

/// The straight path of the middles of the bottom faces, by least squares in time; nearer boxes count more.
struct Path {
    double weight{0};
    double t{0};
    double tt{0};
    Vec3 p{Vec3::Zero()};
    Vec3 tp{Vec3::Zero()};
    double first_s{0};
    double last_s{0};

    void add(double t_s, const Vec3& p_l, double w) {
        first_s = weight > 0.0 ? first_s : t_s;
        last_s = t_s;
        weight += w;
        t += w * t_s;
        tt += w * t_s * t_s;
        p += w * p_l;
        tp += (w * t_s) * p_l;
    }
    [[nodiscard]] Vec3 velocity() const {
        const double det = weight * tt - t * t;
        return last_s - first_s < kShortestPath_s || !(det > 0.0) ? Vec3(Vec3::Zero())
                                                                  : Vec3((weight * tp - t * p) / det);
    }
    [[nodiscard]] Vec3 at(double t_s, const Vec3& velocity) const {
        return (p + velocity * (weight * t_s - t)) / weight;
    }
};

DetectionView view_of(const ObjectFrame& frame, const Calibration& c) {
    return {c.detection, {frame.T_c_l.R, frame.T_c_l.t + Vec3(c.t_d_c[0], c.t_d_c[1], c.t_d_c[2])}, c.width};
}

double seconds_to_newest(const ObjectWindow& window, int k) {
    return 1e-6 * static_cast<double>(window.frames[k].time_us - window.newest().time_us);
}

Path path_of_boxes(const ObjectWindow& window, const Calibration& calibration, double theta, const ObjectVariables& x) {
    const ClassPrior& prior = class_prior(window.object_class);
    Path path;
    for (int k = 0; k < window.frames.size(); ++k) {
        const ObjectFrame& frame = window.frames[k];
        if (!frame.box.valid) {
            continue;
        }
        const DetectionView view = view_of(frame, calibration);
        Pose T_l_o{rot_z(theta), x.state[static_cast<std::size_t>(k)].p};
        StandPoint point;
        bool stands = true;
        for (int pass = 0; pass < 2 && stands; ++pass) {  // the second one with the corners of the first one's pose
            stands = stand_point(view.camera, frame.box.box, frame.box.sigma_px, view.T_d_l * T_l_o, prior.size_m,
                                 prior.size_sigma_m(2), point) == Status::kOk;
            T_l_o.t = view.T_d_l.inverse() * point.p_d + Vec3(0.0, 0.0, 0.5 * prior.size_m(2));
        }
        if (stands) {
            path.add(seconds_to_newest(window, k), T_l_o.t, 1.0 / point.p_d.dot(point.p_d));
        }
    }
    return path;
}

/// Half of what the box takes along a horizontal direction at `off` to its heading.
double half_extent(const Vec3& size_m, double off) {
    const SinCos d = sin_cos(off);
    return 0.5 * (size_m(0) * std::fabs(d.cos) + size_m(1) * std::fabs(d.sin));
}

/// Middle of the seen landmarks' distances along a direction from an origin; false: too few.
bool middle_landmark(const ObjectWindow& window, const ObjectVariables& x, const Vec3& origin_l, const Vec3& along,
                     double& middle_m) {
    const ObjectState& now = x.state[static_cast<std::size_t>(window.frames.size() - 1)];
    const Mat3 R_l_o = rot_z(now.theta);
    std::array<double, static_cast<std::size_t>(kMaxObjectFeatures)> distance_m{};
    int n = 0;
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        if (window.landmarks[slot].valid && window.newest().features[slot].valid) {
            distance_m[static_cast<std::size_t>(n)] = along.dot(now.p + R_l_o * x.f_o[slot] - origin_l);
            ++n;
        }
    }
    if (n < kLeastLandmarks) {
        return false;
    }
    heap_sort(distance_m.data(), n);
    middle_m = distance_m[static_cast<std::size_t>(n / 2)];
    return true;
}

/// Observation angle of the middle of a class: rotation about z from the line of sight to the heading.
double middle_of_class(int horizontal) {
    // Class 6 is the rear: heading along the line of sight. Classes count up by 45 degrees of KITTI's alpha, which
    // turns the other way.
    return wrap_angle(static_cast<double>(6 - horizontal) * 0.25 * kPi);
}

}  // namespace

double heading_cost(const ObjectWindow& window, const ObjectVariables& x) {
    double cost = 0.0;
    bool viewed = false;
    for (int k = 0; k < window.frames.size(); ++k) {
        const ObjectFrame& frame = window.frames[k];
        if (!frame.box.valid || frame.box.viewpoint.horizontal < 0) {
            continue;
        }
        viewed = true;
        const ObjectState& state = x.state[static_cast<std::size_t>(k)];
        const int seen = visible_faces(frame.T_c_l * state.T_l_o(), x.size_m).horizontal;
        const int apart = seen > frame.box.viewpoint.horizontal ? seen - frame.box.viewpoint.horizontal
                                                                : frame.box.viewpoint.horizontal - seen;
        const int steps = apart > 4 ? 8 - apart : apart;
        cost += steps == 0 ? 0.0 : steps == 1 ? kNextViewCost : kWrongViewCost;
    }
    const ObjectState& newest = x.state[static_cast<std::size_t>(window.frames.size() - 1)];
    return cost + (!viewed && window.stood < kStoodLong && newest.v < -kReverseSpeed ? kReverseCost : 0.0);
}

double turning_cost(const ObjectWindow& window, const ObjectVariables& x) {
    const auto newest = static_cast<std::size_t>(window.frames.size() - 1);
    const double turn = wrap_angle(x.state[newest].theta - window.newest().state.theta);
    const double cost = 0.5 * window.heading_information * turn * turn;
    return cost < kTurningMost ? cost : kTurningMost;
}

double outside_cost(const ObjectWindow& window, const ObjectVariables& x) {
    double sum = 0.0;
    int n = 0;
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        if (!window.landmarks[slot].valid || !window.newest().features[slot].valid) {
            continue;
        }
        ++n;
        double d2 = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double out = std::fabs(x.f_o[slot](i)) - 0.5 * x.size_m(i);
            d2 += out > 0.0 ? out * out : 0.0;
        }
        d2 /= kOutsideSigma_m * kOutsideSigma_m;
        sum += d2 < kOutsideMost2 ? d2 : kOutsideMost2;
    }
    // One body's shape: its points err together.
    return n > kIndependentPoints ? 0.5 * sum * kIndependentPoints / n : 0.5 * sum;
}

bool twin_start(const ObjectWindow& window, bool mirrored, ObjectVariables& x) {
    const int last = window.frames.size() - 1;
    const ObjectState& state = x.state[static_cast<std::size_t>(last)];
    const Vec3 ray = state.p - window.newest().T_c_l.inverse().t;
    const double off = wrap_angle(state.theta - atan2_rad(ray(1), ray(0)));
    double turn = -2.0 * off;
    if (!mirrored) {
        // Within its quarter: widest where tan = length / width.
        const double quarter = off >= 0.5 * kPi    ? off - 0.5 * kPi
                               : off >= 0.0        ? off
                               : off >= -0.5 * kPi ? off + 0.5 * kPi
                                                   : off + kPi;
        const bool across = (off >= 0.5 * kPi) || (off < 0.0 && off >= -0.5 * kPi);
        const double widest = across ? atan2_rad(x.size_m(1), x.size_m(0)) : atan2_rad(x.size_m(0), x.size_m(1));
        turn = 2.0 * (widest - quarter);
    }
    if (std::fabs(turn) > kMaxTurn_rad) {
        return false;
    }
    const Mat3 R_back = rot_z(-turn);
    for (int k = 0; k <= last; ++k) {
        ObjectState& s = x.state[static_cast<std::size_t>(k)];
        s.theta = wrap_angle(s.theta + turn);
    }
    for (Vec3& f : x.f_o) {
        f = R_back * f;
    }
    return true;
}

bool landmark_start(const ObjectWindow& window, ObjectVariables& x) {
    const int last = window.frames.size() - 1;
    const ObjectState before = x.state[static_cast<std::size_t>(last)];
    const Vec3 camera_l = window.newest().T_c_l.inverse().t;
    const double sight = atan2_rad(before.p(1) - camera_l(1), before.p(0) - camera_l(0));
    const SinCos u = sin_cos(sight);
    const Vec3 along(u.cos, u.sin, 0.0);
    const double centre_m = along.dot(before.p - camera_l);
    double middle_m = 0.0;
    if (!middle_landmark(window, x, camera_l, along, middle_m) || !(middle_m > 0.0) || !(centre_m > 0.0)) {
        return false;
    }
    const double beside = std::fabs(middle_m - centre_m) - half_extent(x.size_m, before.theta - sight);
    if (beside < kBesideBox_m) {
        return false;
    }
    // What is seen of a body is its near half.
    const double nearer = (middle_m + 0.5 * half_extent(window.prior_size_m, before.theta - sight)) / centre_m;
    for (int k = 0; k <= last; ++k) {
        ObjectState& s = x.state[static_cast<std::size_t>(k)];
        const Vec3 camera = window.frames[k].T_c_l.inverse().t;
        s.p = camera + nearer * (s.p - camera);
    }
    const ObjectState& now = x.state[static_cast<std::size_t>(last)];
    const double time_s = -seconds_to_newest(window, 0);
    if (time_s > 0.0) {
        const SinCos h = sin_cos(now.theta);
        const double v = (h.cos * (now.p(0) - x.state[0].p(0)) + h.sin * (now.p(1) - x.state[0].p(1))) / time_s;
        for (int k = 0; k <= last; ++k) {
            x.state[static_cast<std::size_t>(k)].v = v;
        }
    }
    x.size_m = window.prior_size_m;
    const Vec3 shift = rot_z(-now.theta) * (before.p - now.p);
    for (Vec3& f : x.f_o) {
        f += shift;
    }
    return true;
}

bool fresh_start(const ObjectWindow& window, const Calibration& calibration, int option, ObjectVariables& x) {
    const int last = window.frames.size() - 1;
    int seen = last;  // newest frame with a box
    while (seen > 0 && !window.frames[seen].box.valid) {
        --seen;
    }
    const ObjectFrame& frame = window.frames[seen];
    const ObjectState before = x.state[static_cast<std::size_t>(last)];
    const Vec3 ray = x.state[static_cast<std::size_t>(seen)].p - frame.T_c_l.inverse().t;
    const double sight = atan2_rad(ray(1), ray(0));
    const int view = frame.box.viewpoint.horizontal;
    double theta = before.theta;
    if (view < 0) {
        theta = wrap_angle(sight + (static_cast<double>(option) + 0.5) * 0.25 * kPi);
    } else if (option < 2) {
        const double beside = view % 2 == 0 ? 0.0 : option == 0 ? kBesideMiddle_rad : -kBesideMiddle_rad;
        theta = wrap_angle(sight + middle_of_class(view) + beside);
    }
    Path path = path_of_boxes(window, calibration, theta, x);
    if (!(path.weight > 0.0)) {
        return false;
    }
    Vec3 velocity = path.velocity();
    if (view >= 0 && option == 2) {
        const double speed = std::sqrt(velocity(0) * velocity(0) + velocity(1) * velocity(1));
        if (!(speed > kPathSpeed)) {
            return false;
        }
        theta = atan2_rad(velocity(1), velocity(0));
        const double apart = wrap_angle(theta - sight - middle_of_class(view));
        if (apart > 0.5 * kPi || apart < -0.5 * kPi) {
            theta = wrap_angle(theta + kPi);  // it reverses
        }
        path = path_of_boxes(window, calibration, theta, x);
        velocity = path.velocity();
    }
    const SinCos h = sin_cos(theta);
    const double v = h.cos * velocity(0) + h.sin * velocity(1);
    for (int k = 0; k <= last; ++k) {
        ObjectState& s = x.state[static_cast<std::size_t>(k)];
        s.p = path.at(seconds_to_newest(window, k), velocity);
        s.theta = theta;
        s.v = v;
        s.delta = 0.0;
    }
    x.size_m = window.prior_size_m;
    // Landmarks stay where they are in the world at the newest frame.
    const ObjectState& now = x.state[static_cast<std::size_t>(last)];
    const Mat3 R_now_before = rot_z(before.theta - theta);
    const Vec3 shift = rot_z(-theta) * (before.p - now.p);
    for (Vec3& f : x.f_o) {
        f = R_now_before * f + shift;
    }
    return true;
}

}  // namespace semtrack
