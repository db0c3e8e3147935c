#include "budget/load_scene.hpp"

#include <array>
#include <cmath>

#include "math/camera.hpp"
#include "math/rng.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "support/aligned_pair.hpp"
#include "support/plane_scene.hpp"

namespace semtrack::budget {

namespace {

constexpr int kWidth = 1242;
constexpr int kHeight = 375;
constexpr std::int64_t kFrame_us = 100000;
constexpr int kColumns = 11;  // places for boxes in the image
constexpr double kPitch_px = 111.0;
constexpr double kFirstU_px = 66.0;  // middle of the first place
constexpr double kFirstV_px = 76.0;
const Vec3 kSize_m(3.9, 1.63, 1.53);
constexpr double kNearest_m = 11.6;  // to a box's rear
constexpr double kSwing_m = 0.45;    // of boxes, and ...
constexpr double kEgoSwing_m = 0.3;  // ... of the camera
constexpr double kEgoPeriod_s = 3.1;
constexpr double kWall_m = 45.0;
constexpr int kPillars = 14;

struct Box {
    Pose T_w_o{};  // W: the camera at rest
    Vec3 size_m{Vec3::Zero()};
    double texels_per_m{0};
    std::uint32_t seed{0};
};

Mat3 heading(double theta) {
    Mat3 R;
    R << std::sin(theta), -std::cos(theta), 0.0, 0.0, 0.0, -1.0, std::cos(theta), std::sin(theta), 0.0;
    return R;
}

/// Number k at time t: seen from behind, driving away and back along its ray.
Box object(const Calibration& c, int k, double t_s) {
    const Vec3 ray = bearing(c.left, kFirstU_px + kPitch_px * (k % kColumns), kFirstV_px + kPitch_px * (k / kColumns));
    const double theta = std::atan2(ray(0), 1.0);
    const double phase = 2.0 * kPi * (t_s / (2.0 + 0.05 * k) + 0.13 * k);
    const double rear_m = kNearest_m + kSwing_m * (1.0 - std::cos(phase));
    Box box;
    box.size_m = kSize_m;
    box.T_w_o.R = heading(theta);
    box.T_w_o.t = Vec3(ray * (kNearest_m / std::sqrt(1.0 + ray(0) * ray(0)))) +
                  box.T_w_o.R.col(0) * (rear_m - kNearest_m + 0.5 * kSize_m(0));
    box.texels_per_m = c.left.fx / kNearest_m;
    box.seed = 100U + static_cast<std::uint32_t>(k);
    return box;
}

Vec3 eye(double t_s) {
    return {0.0, 0.0, kEgoSwing_m * std::sin(2.0 * kPi * t_s / kEgoPeriod_s)};
}

std::vector<Box> background(const Calibration& c) {
    std::vector<Box> out(1);
    out[0].T_w_o = {heading(0.0), Vec3(0.0, 0.0, kWall_m)};
    out[0].size_m = Vec3(1.0, 400.0, 200.0);
    out[0].texels_per_m = c.left.fx / kWall_m;
    out[0].seed = 5;
    for (int k = 0; k < kPillars; ++k) {
        const double z = 18.0 + 3.0 * ((5 * k) % 7);
        Box pillar;
        pillar.T_w_o = {heading(0.0), Vec3((k - 0.5 * (kPillars - 1)) * 0.115 * z, 0.0, z)};
        pillar.size_m = Vec3(0.5, 0.06 * z, 100.0);
        pillar.texels_per_m = c.left.fx / z;
        pillar.seed = 30U + static_cast<std::uint32_t>(k);
        out.push_back(pillar);
    }
    return out;
}

/// One image: nearest box along each ray.
class Picture {
public:
    Picture() : depth_(static_cast<std::size_t>(kWidth) * kHeight, 1e9), pixels_(depth_.size(), 0) {}

    void add(const PinholeCamera& camera, const Box& box, const Vec3& eye_w) {
        const Pose T_c_o{box.T_w_o.R, box.T_w_o.t - eye_w};
        Box2d around;
        if (projected_box(camera, T_c_o, box.size_m, around) != Status::kOk ||
            !clip_box(around, kWidth, kHeight, around)) {
            return;
        }
        const Vec3 eye_o = T_c_o.R.transpose() * Vec3(-T_c_o.t);
        const Vec3 half = 0.5 * box.size_m;
        for (int v = static_cast<int>(around.top); v <= static_cast<int>(around.bottom); ++v) {
            for (int u = static_cast<int>(around.left); u <= static_cast<int>(around.right); ++u) {
                const Vec3 ray_o = T_c_o.R.transpose() * bearing(camera, u, v);
                double enter = 0.0;
                double leave = 1e9;
                int face = 0;
                for (int a = 0; a < 3; ++a) {
                    const double d = std::fabs(ray_o(a)) > 1e-12 ? ray_o(a) : 1e-12;
                    const double one = (-half(a) - eye_o(a)) / d;
                    const double two = (half(a) - eye_o(a)) / d;
                    face = std::fmin(one, two) > enter ? a : face;
                    enter = std::fmax(enter, std::fmin(one, two));
                    leave = std::fmin(leave, std::fmax(one, two));
                }
                const std::size_t at = static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u);
                if (enter < leave && enter < depth_[at]) {
                    depth_[at] = enter;
                    const Vec3 place = (eye_o + enter * ray_o) * box.texels_per_m;
                    const double grey =
                        wall_texture(place((face + 1) % 3), place((face + 2) % 3), box.seed * 7U + unsigned(face));
                    pixels_[at] = static_cast<std::uint8_t>(20.0 + 0.8 * grey);
                }
            }
        }
    }
    [[nodiscard]] ImageView view() const { return {pixels_.data(), kWidth, kHeight, kWidth}; }

private:
    std::vector<double> depth_;
    std::vector<std::uint8_t> pixels_;
};

}  // namespace

board::SceneWriter make_load_scene(int objects, int frames) {
    const Calibration c = aligned_pair();
    board::SceneWriter scene(c, frames);
    for (int frame = 0; frame < frames; ++frame) {
        const std::int64_t time_us = frame * kFrame_us;
        const double t_s = 1e-6 * static_cast<double>(time_us);
        std::vector<Box> boxes = background(c);
        const Vec3 eye_w = eye(t_s);
        std::vector<Detection> detections;
        for (int k = 0; k < objects; ++k) {
            boxes.push_back(object(c, k, t_s));
            const Box& box = boxes.back();
            const Pose T_c_o{box.T_w_o.R, box.T_w_o.t - eye_w};
            Detection d;
            if (projected_box(c.detection, T_c_o, box.size_m, d.box) != Status::kOk ||
                !clip_box(d.box, kWidth, kHeight, d.box)) {
                continue;
            }
            d.viewpoint = visible_faces(T_c_o, box.size_m);
            d.score = 0.9;
            detections.push_back(d);
        }
        Picture left;
        Picture right;
        for (const Box& box : boxes) {
            left.add(c.left, box, eye_w);
            right.add(c.right, box, eye_w + Vec3(c.baseline_m, 0.0, 0.0));
        }
        scene.frame(time_us, &detections, left.view(), right.view());
    }
    return scene;
}

std::vector<LoadBox> load_boxes(int objects, int frame) {
    const Calibration c = aligned_pair();
    const double t_s = 1e-6 * static_cast<double>(frame * kFrame_us);
    constexpr double kStep_s = 1e-3;
    std::vector<LoadBox> out;
    for (int k = 0; k < objects; ++k) {
        const Box box = object(c, k, t_s);
        const Vec3 p_c = box.T_w_o.t - eye(t_s);
        const Vec3 step = object(c, k, t_s + kStep_s).T_w_o.t - box.T_w_o.t;
        out.push_back({p_c(2), -p_c(0), step.dot(box.T_w_o.R.col(0)) / kStep_s});
    }
    return out;
}

namespace {

constexpr double kNoise_px = 0.3;
constexpr int kAcross = 16;  // points on a box's rear, in eight rows

/// Point i of box k, O: on its rear, away from the rim.
Vec3 point_on_rear(int i, Rng& rng) {
    const double across = (i % kAcross + 0.2 + 0.6 * rng.uniform()) / kAcross - 0.5;
    const double up = (i / kAcross + 0.2 + 0.6 * rng.uniform()) * kAcross / kMaxObjectFeatures - 0.5;
    return {-0.5 * kSize_m(0) + 0.2 * rng.uniform(), 0.8 * across * kSize_m(1), 0.8 * up * kSize_m(2)};
}

/// Above and below all boxes.
Vec3 background_point(const Calibration& c, Rng& rng) {
    const double v = rng.uniform() < 0.5 ? 5.0 + 7.0 * rng.uniform() : kHeight - 12.0 + 7.0 * rng.uniform();
    return bearing(c.left, 20.0 + (kWidth - 40.0) * rng.uniform(), v) * (18.0 + 27.0 * rng.uniform());
}

}  // namespace

LoadFeatures::LoadFeatures(int objects, int frames) {
    const Calibration c = aligned_pair();
    for (int frame = 0; frame < frames; ++frame) {
        const double t_s = 1e-6 * static_cast<double>(frame * kFrame_us);
        std::vector<ExternalFeature>& out = by_time_[frame * kFrame_us];
        Rng noise(static_cast<std::uint32_t>(frame) + 1U);
        Rng places(77);
        const auto feature = [&](int id, const Vec3& x_w) {
            return sil::noisy_stereo_feature(c, static_cast<std::uint32_t>(id), x_w - eye(t_s), kNoise_px, noise);
        };
        for (int i = 0; i < kMaxBackgroundFeatures; ++i) {
            out.push_back(feature(i, background_point(c, places)));
        }
        for (int k = 0; k < objects; ++k) {
            const Box box = object(c, k, t_s);
            for (int i = 0; i < kMaxObjectFeatures; ++i) {
                const Vec3 x_w = box.T_w_o * point_on_rear(i, places);
                out.push_back(feature(1000 * (k + 1) + i, x_w));
            }
        }
    }
}

}  // namespace semtrack::budget
