// Stereo features of rigid scenes with known outliers.
#ifndef SEMTRACK_TESTS_FRONT_RANSAC_SCENE_HPP
#define SEMTRACK_TESTS_FRONT_RANSAC_SCENE_HPP

#include <cmath>
#include <memory>
#include <set>

#include "front/ransac/reject.hpp"
#include "math/camera.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"

namespace semtrack::testing {

inline Calibration street_camera() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = {720.0, 720.0, 610.0, 172.0};
    c.right = c.left;
    c.right.cx = 612.0;  // differs: disparity has to honour it
    c.baseline_m = 0.54;
    return c;
}

struct Scene {
    FrameFeatures features{};
    std::set<int> outliers;  ///< indices of features whose position now is wrong by 8 px or more
    Calibration calibration = street_camera();
};

struct SceneShape {
    int points{100};
    std::uint8_t owner{0};
    Pose T_now_before{};
    double outlier_share{0.3};
    double noise_px{0.25};
    double near_m{5.0};
    double far_m{60.0};
    double left{20.0};  ///< window of the image in which the points lie
    double right{1220.0};
    double top{60.0};
    double bottom{360.0};
    bool stereo{true};
    bool planar{false};  ///< on a wall at far_m, turned by 45 deg about the vertical
};

inline double noise(Rng& rng, double size) {
    return size * (2.0 * rng.uniform() - 1.0);
}

/// Adds an owner's features; owners must be added in ascending order.
inline void add(Scene& scene, const SceneShape& shape, std::uint32_t seed) {
    Rng rng(seed);
    const Calibration& c = scene.calibration;
    int slot = 0;
    while (slot < shape.points) {
        const double u = shape.left + rng.uniform() * (shape.right - shape.left);
        const double v = shape.top + rng.uniform() * (shape.bottom - shape.top);
        double z = 1.0 / (1.0 / shape.far_m + rng.uniform() * (1.0 / shape.near_m - 1.0 / shape.far_m));
        const Vec3 ray = bearing(c.left, u, v);
        if (shape.planar) {
            z = shape.far_m / (1.0 + ray(0));
        }
        const Vec3 now = shape.T_now_before * Vec3(ray * z);
        if (now(2) < 1.0) {
            continue;
        }
        const Vec2 q = project(c.left, now);
        FeatureMeasurement m;
        m.id = static_cast<std::uint32_t>(scene.features.size() + 1);
        m.owner = shape.owner;
        m.slot = static_cast<std::int16_t>(slot++);
        m.tracked = true;
        m.stereo = shape.stereo;
        m.previous_stereo = shape.stereo;
        m.previous_u = static_cast<float>(u + noise(rng, shape.noise_px));
        m.previous_v = static_cast<float>(v + noise(rng, shape.noise_px));
        m.previous_u_right = static_cast<float>(right_column(c, u, z) + noise(rng, shape.noise_px));
        m.u = static_cast<float>(q(0) + noise(rng, shape.noise_px));
        m.v = static_cast<float>(q(1) + noise(rng, shape.noise_px));
        m.u_right = static_cast<float>(right_column(c, q(0), now(2)) + noise(rng, shape.noise_px));
        if (rng.uniform() < shape.outlier_share) {
            const double side = rng.uniform() < 0.5 ? -1.0 : 1.0;
            m.u += static_cast<float>(side * (8.0 + 30.0 * rng.uniform()));
            m.v += static_cast<float>((rng.uniform() < 0.5 ? -1.0 : 1.0) * (8.0 + 20.0 * rng.uniform()));
            m.u_right = m.u - (static_cast<float>(q(0)) - m.u_right);  // disparity stays plausible
            scene.outliers.insert(scene.features.size());
        }
        if (!scene.features.try_push_back(m)) {
            return;
        }
    }
}

struct Verdict {
    int inliers{0};
    int inliers_kept{0};
    int outliers{0};
    int outliers_kept{0};
    [[nodiscard]] double recall() const { return static_cast<double>(inliers_kept) / inliers; }
    [[nodiscard]] double leak() const { return outliers > 0 ? static_cast<double>(outliers_kept) / outliers : 0.0; }
};

inline Verdict judge(const Scene& scene, const OutlierRejection& rejection, int owner) {
    Verdict v;
    for (int i = 0; i < scene.features.size(); ++i) {
        if (scene.features[i].owner != owner) {
            continue;
        }
        const bool bad = scene.outliers.count(i) > 0;
        (bad ? v.outliers : v.inliers) += 1;
        if (rejection.inlier(i)) {
            (bad ? v.outliers_kept : v.inliers_kept) += 1;
        }
    }
    return v;
}

}  // namespace semtrack::testing

#endif
