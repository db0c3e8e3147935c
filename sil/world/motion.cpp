#include "sil/world/motion.hpp"

#include <cmath>

#include "math/trig.hpp"

namespace semtrack::sil::world {

namespace {

constexpr int kStepsPerFrame = 100;
constexpr double kStep_s = 0.001;

// Which phase holds at a step; past the end: straight on at constant speed.
Phase phase_at(const std::vector<Phase>& phases, int step) {
    int end = 0;
    for (const Phase& p : phases) {
        end += static_cast<int>(std::lround(p.duration_s / kStep_s));
        if (step < end) {
            return p;
        }
    }
    return Phase{};
}

double bump(double t, double phase) {
    return 0.6 * sin_cos(kTwoPi * 1.31 * t + phase).sin + 0.4 * sin_cos(kTwoPi * 0.47 * t + 2.0 * phase).sin;
}

}  // namespace

std::vector<PathState> integrate(const Motion& motion, double reference_m, int frames) {
    std::vector<PathState> out;
    const SinCos start = sin_cos(motion.heading);
    double x = motion.x - reference_m * start.sin;  // rear axle
    double z = motion.z - reference_m * start.cos;
    double heading = motion.heading;
    double speed = motion.speed;
    double travelled = 0.0;
    for (int step = 0; static_cast<int>(out.size()) < frames; ++step) {
        const Phase p = phase_at(motion.phases, step);
        if (step % kStepsPerFrame == 0) {
            const SinCos sc = sin_cos(heading);
            out.push_back(
                {x + reference_m * sc.sin, z + reference_m * sc.cos, heading, speed, speed * p.curvature, travelled});
        }
        const double ds = (speed + 0.5 * p.acceleration * kStep_s) * kStep_s;
        const SinCos middle = sin_cos(heading + 0.5 * ds * p.curvature);
        x += ds * middle.sin;
        z += ds * middle.cos;
        heading += ds * p.curvature;
        speed += p.acceleration * kStep_s;
        travelled += ds;
    }
    return out;
}

double rear_axle_to_middle(const RoadUser& user) {
    return user.object_class == ObjectClass::kPedestrian ? 0.0 : 0.30 * user.length;
}

double road_height(const Street& street, double z) {
    const std::vector<HeightKnot>& k = street.profile;
    if (k.empty()) {
        return 0.0;
    }
    if (z <= k.front().z) {
        return k.front().height;
    }
    for (std::size_t i = 1; i < k.size(); ++i) {
        if (z <= k[i].z) {
            const double share = (z - k[i - 1].z) / (k[i].z - k[i - 1].z);
            return k[i - 1].height + share * (k[i].height - k[i - 1].height);
        }
    }
    return k.back().height;
}

double road_slope(const Street& street, double z) {
    // Over the length of a car: wheels stand on both sides of a knot.
    constexpr double kHalf_m = 1.3;
    return (road_height(street, z + kHalf_m) - road_height(street, z - kHalf_m)) / (2.0 * kHalf_m);
}

Pose camera_pose(const Scenario& scenario, const PathState& ego, int frame) {
    const double t = 0.1 * static_cast<double>(frame);
    const SinCos h = sin_cos(ego.heading);
    const double slope = atan2_rad(road_slope(scenario.street, ego.z) * h.cos, 1.0);
    const SinCos p = sin_cos(slope + scenario.ego.pitch_amplitude * bump(t, 0.7));
    const SinCos r = sin_cos(scenario.ego.roll_amplitude * bump(t, 1.9));
    Mat3 yaw;
    yaw << h.cos, 0, h.sin, 0, 1, 0, -h.sin, 0, h.cos;
    Mat3 pitch;
    pitch << 1, 0, 0, 0, p.cos, -p.sin, 0, p.sin, p.cos;
    Mat3 roll;
    roll << r.cos, -r.sin, 0, r.sin, r.cos, 0, 0, 0, 1;
    Pose T_n_c;
    T_n_c.R = yaw * pitch * roll;
    const double up = kCameraHeight_m + scenario.ego.height_amplitude * bump(t, 0.2);
    T_n_c.t = Vec3(ego.x, -road_height(scenario.street, ego.z) - up, ego.z);
    return T_n_c;
}

Pose user_pose(const Street& street, const PathState& state) {
    const SinCos h = sin_cos(state.heading);
    const double pitch = atan2_rad(road_slope(street, state.z) * h.cos, 1.0);
    return model_pose(state.x, -road_height(street, state.z), state.z, state.heading, pitch);
}

}  // namespace semtrack::sil::world
