#include "sil/simulate/feature_simulator.hpp"

#include <algorithm>
#include <cmath>

#include "math/camera.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"
#include "model/box_geometry.hpp"
#include "sil/kitti/label_detections.hpp"

namespace semtrack::sil {

namespace {

constexpr double kCountPerPx = 0.38;  // of the 2D box's height
constexpr double kCountOffset = 4.0;
constexpr int kMostPoints = 48;
constexpr double kMostDepth_m = 0.4;  // under the labelled box's face
constexpr std::uint32_t kBackgroundEvery = 10;
constexpr double kBehindNear_m = 3.0;  // how far behind the object the background is
constexpr double kBehindFar_m = 20.0;
constexpr double kLost = 0.06;  // a frame: half of the tracks last 11 frames
constexpr double kHiddenMargin_m = 1.0;

std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
    std::uint32_t h = a * 0x9E3779B1U ^ (b + 0x85EBCA77U);
    h ^= h >> 15U;
    h *= 0x2C1B3C6DU;
    h ^= h >> 13U;
    return h;
}

bool is_simulated(const std::string& type) {
    return type == "Car" || type == "Van" || type == "Truck";
}

}  // namespace

FeatureSimulator::FeatureSimulator(const Sequence& sequence, const std::map<int, RigidTransform>& T_f_c0, int first,
                                   int last, double noise_px)
    : calibration_(sequence.cameras().calibration), noise_px_(noise_px) {
    const std::array<double, 3>& t = sequence.cameras().t_c0_c;
    const Vec3 shift(t[0], t[1], t[2]);
    std::map<int, std::vector<Box>> boxes;
    for (const Label& label : sequence.labels()) {
        if (!is_simulated(label.type)) {
            continue;
        }
        Box box;
        box.id = label.id;
        box.T_c_o = label_pose(label);
        box.T_c_o.t -= shift;
        box.size_m = Vec3(label.length, label.width, label.height);
        box.depth_m = box.T_c_o.t(2);
        if (projected_box(calibration_.left, box.T_c_o, box.size_m, box.box) == Status::kOk) {
            boxes[label.frame].push_back(box);
        }
    }
    for (int frame = first; frame <= last; ++frame) {
        const auto pose = T_f_c0.find(frame);
        Pose T_f_c = pose == T_f_c0.end() ? Pose{} : to_pose(pose->second);
        T_f_c.R = orthonormalised(T_f_c.R);
        T_f_c.t = T_f_c * shift;
        simulate(frame, boxes[frame], T_f_c, by_time_[sequence.time_us(frame)]);
    }
}

void FeatureSimulator::simulate(int frame, const std::vector<Box>& boxes, const Pose& T_f_c,
                                std::vector<ExternalFeature>& out) {
    for (const Box& box : boxes) {
        const double wanted = kCountPerPx * (box.box.bottom - box.box.top) - kCountOffset;
        const int count = std::clamp(static_cast<int>(wanted), 0, kMostPoints);
        for (int number = 0; number < count; ++number) {  // hidden ones are not made up for
            (void)add(frame, box, number, T_f_c, boxes, out);
        }
    }
}

/// On one of the faces that the camera sees, by their areas.
FeatureSimulator::Point FeatureSimulator::surface_point(const Box& box, std::uint32_t seed) {
    Rng rng(seed);
    const Vec3 camera_o = box.T_c_o.inverse().t;
    const Vec3 half = 0.5 * box.size_m;
    std::array<double, 3> area{};
    for (int axis = 0; axis < 3; ++axis) {
        const bool seen = std::fabs(camera_o(axis)) > half(axis) && !(axis == 2 && camera_o(2) < 0.0);
        area[static_cast<std::size_t>(axis)] = seen ? half((axis + 1) % 3) * half((axis + 2) % 3) : 0.0;
    }
    double at = rng.uniform() * (area[0] + area[1] + area[2]);
    int face = 0;
    while (face < 2 && at >= area[static_cast<std::size_t>(face)]) {
        at -= area[static_cast<std::size_t>(face)];
        ++face;
    }
    Point point;
    point.face = face;
    for (int axis = 0; axis < 3; ++axis) {
        point.place(axis) = (2.0 * rng.uniform() - 1.0) * half(axis);
    }
    const double under = kMostDepth_m * rng.uniform();
    point.place(face) = (camera_o(face) > 0.0 ? 1.0 : -1.0) * (half(face) - under);
    return point;
}

/// Seen through the object's box, behind it; fixed in the world.
FeatureSimulator::Point FeatureSimulator::background_point(const Box& box, const Pose& T_f_c,
                                                           std::uint32_t seed) const {
    Rng rng(seed);
    const double u = box.box.left + rng.uniform() * (box.box.right - box.box.left);
    const double v = box.box.top + rng.uniform() * (box.box.bottom - box.box.top);
    const double depth = box.depth_m + kBehindNear_m + (kBehindFar_m - kBehindNear_m) * rng.uniform();
    Point point;
    point.place = T_f_c * Vec3(bearing(calibration_.left, u, v) * depth);
    return point;
}

/// Inside its box's part of the image, on a face that the camera sees.
bool FeatureSimulator::is_seen(const Box& box, const Point& point, const Vec3& x_c) const {
    if (!(x_c(2) > kMinDepth_m)) {
        return false;
    }
    if (point.face >= 0) {
        const double camera = box.T_c_o.inverse().t(point.face);
        if (!(point.place(point.face) > 0.0 ? camera > 0.5 * box.size_m(point.face)
                                            : camera < -0.5 * box.size_m(point.face))) {
            return false;
        }
    }
    const Vec2 p = project(calibration_.left, x_c);
    const Box2d& b = box.box;
    return p(0) >= std::max(b.left, 0.0) && p(0) <= std::min(b.right, calibration_.width - 1.0) &&
           p(1) >= std::max(b.top, 0.0) && p(1) <= std::min(b.bottom, calibration_.height - 1.0);
}

/// One more point of the object, when it is seen.
bool FeatureSimulator::add(int frame, const Box& box, int number, const Pose& T_f_c, const std::vector<Box>& boxes,
                           std::vector<ExternalFeature>& out) {
    const std::uint32_t own = mixed(static_cast<std::uint32_t>(box.id), static_cast<std::uint32_t>(number));
    const bool background = static_cast<std::uint32_t>(number) % kBackgroundEvery == kBackgroundEvery - 1U;
    const auto [entry, born] = points_.try_emplace({box.id, number});
    Point& point = entry->second;
    Rng chance(mixed(own, static_cast<std::uint32_t>(frame)));
    const auto renew = [&] {
        const std::uint32_t generation = point.generation + 1U;
        const std::uint32_t seed = mixed(own, generation);
        point = background ? background_point(box, T_f_c, seed) : surface_point(box, seed);
        point.generation = generation;
    };
    const auto place = [&] { return background ? Vec3(T_f_c.inverse() * point.place) : Vec3(box.T_c_o * point.place); };
    if (chance.uniform() < kLost || born) {
        renew();
    }
    if (!is_seen(box, point, place())) {
        renew();
        if (!is_seen(box, point, place())) {
            return false;
        }
    }
    const Vec3 x_c = place();
    const Vec2 left = project(calibration_.left, x_c);
    for (const Box& other : boxes) {
        if (other.id != box.id && other.depth_m + kHiddenMargin_m < box.depth_m && left(0) > other.box.left &&
            left(0) < other.box.right && left(1) > other.box.top && left(1) < other.box.bottom) {
            return false;
        }
    }
    const std::uint32_t id = mixed(own, point.generation * 2U + 1U);
    out.push_back(noisy_stereo_feature(calibration_, id, x_c, noise_px_, chance));
    return true;
}

}  // namespace semtrack::sil
