// The four planes of a 2D box, paper Eq. (1) [eq:prior], and the two closed forms that follow from them: the heading
// from all four, and the position from three or four when the heading is known.
//
// An edge at the normalised coordinate u or v puts its vertex C_e d into the plane with normal a_e = (1, 0, -u) or
// (0, 1, -v):   a_e . p + cos_e cos(theta) + sin_e sin(theta) + one_e = 0.
#ifndef SEMTRACK_FRONT_BOX_EDGE_PLANES_HPP
#define SEMTRACK_FRONT_BOX_EDGE_PLANES_HPP

#include "math/camera.hpp"
#include "math/eigen.hpp"
#include "model/box_geometry.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct EdgePlane {
    Vec3 a{Vec3::Zero()};  ///< normal in the camera frame
    double cos{0};         ///< a . R_c_l R_z C d = cos * cos(theta) + sin * sin(theta) + one
    double sin{0};
    double one{0};
    bool valid{false};
};

struct EdgePlanes {
    EdgePlane edge[kBoxEdges];
    unsigned mask{0};  ///< bit e: edge e is valid
    int count{0};
};

/// Bit e: edge e lies inside the image, so the object makes it and not the image's border.
[[nodiscard]] unsigned valid_edges(const Box2d& box, int width, int height);

[[nodiscard]] EdgePlanes edge_planes(const PinholeCamera& camera, const Mat3& R_c_l, const Box2d& box, unsigned valid,
                                     const EdgeVertices& vertices, const Vec3& size_m);

/// All four edges: n = (v_b - v_t, -(v_b - v_t), -(u_r - u_l), u_r - u_l) up to sign removes p (n_e a_e sums to zero),
/// and a cos(theta) + b sin(theta) + c = 0 is left. Two roots in (-pi, pi]; equal where |c| exceeds the amplitude (box
/// wider than any heading makes: the nearest angle). false: by more than kWidthSlack, or fewer edges.
[[nodiscard]] bool heading_roots(const EdgePlanes& planes, double roots[2]);

/// Least squares of the valid edges, exact for three. false: fewer, or degenerate.
[[nodiscard]] bool position_at(const EdgePlanes& planes, double theta, Vec3& p_c);

inline constexpr double kBorder_px = 1.5;
inline constexpr double kWidthSlack = 1.6;

}  // namespace semtrack

#endif
