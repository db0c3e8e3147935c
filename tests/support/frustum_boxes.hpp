// Boxes all over a camera's frustum, seeded: every place on and above the road, every heading, sizes of road users.
#ifndef SEMTRACK_TESTS_SUPPORT_FRUSTUM_BOXES_HPP
#define SEMTRACK_TESTS_SUPPORT_FRUSTUM_BOXES_HPP

#include "math/camera.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "support/noise.hpp"

namespace semtrack {

inline constexpr PinholeCamera kFrustumCamera{721.5, 721.5, 609.6, 172.9};
inline constexpr int kFrustumWidth = 1242;
inline constexpr int kFrustumHeight = 375;

/// Local-level frame (x ahead, y left, z up) to a level camera.
inline Mat3 level_camera() {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return R_c_l;
}

struct FrustumBox {
    Vec3 p_c{Vec3::Zero()};
    double theta{0};
    Vec3 size_m{Vec3::Ones()};
    Mat3 R_c_l{Mat3::Identity()};
    Box2d box{};  ///< projected, not clipped
    Viewpoint view{};

    [[nodiscard]] Pose T_c_o() const { return {R_c_l * rot_z(theta), p_c}; }
};

/// false: not wholly in front of the camera.
inline bool complete(FrustumBox& b) {
    b.view = visible_faces(b.T_c_o(), b.size_m);
    return b.view.horizontal >= 0 && projected_box(kFrustumCamera, b.T_c_o(), b.size_m, b.box) == Status::kOk &&
           (b.T_c_o() * Vec3::Zero())(2) > b.size_m(0);
}

inline bool inside_image(const Box2d& b) {
    return b.left > 3.0 && b.top > 3.0 && b.right < kFrustumWidth - 4.0 && b.bottom < kFrustumHeight - 4.0;
}

/// Any place and heading; every third one turns one side nearly straight to the camera, or the classes that show a
/// single face would be rare. `tilt`: the camera pitches and rolls by up to 2 degrees.
inline bool random_box(Rng& rng, bool tilt, FrustumBox& out) {
    const double z = between(rng, 5.0, 70.0);
    out.size_m = Vec3(between(rng, 1.6, 6.0), between(rng, 0.6, 2.4), between(rng, 1.3, 3.2));
    const double road = between(rng, 1.45, 1.85);
    const double lift = rng.below(4) == 0 ? between(rng, -1.0, 1.0) : 0.0;  // hills
    out.p_c = Vec3(between(rng, -0.85, 0.85) * z, road + lift - 0.5 * out.size_m(2), z);
    out.theta = between(rng, -kPi, kPi);
    if (rng.below(3) == 0) {
        const double ray = atan2_rad(-out.p_c(0), out.p_c(2));
        out.theta = wrap_angle(ray + 0.5 * kPi * rng.below(4) + between(rng, -0.6, 0.6) / z);
    }
    out.R_c_l = level_camera();
    if (tilt) {
        out.R_c_l = so3_exp(Vec3(between(rng, -0.035, 0.035), 0.0, between(rng, -0.035, 0.035))) * out.R_c_l;
    }
    return complete(out);
}

}  // namespace semtrack

#endif
