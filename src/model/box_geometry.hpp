// A 3D box seen by a camera: which vertex makes which edge of its 2D box (paper Eq. (1)-(2), [eq:prior],
// [eq:selection]), which faces are visible, and its projection.
#ifndef SEMTRACK_MODEL_BOX_GEOMETRY_HPP
#define SEMTRACK_MODEL_BOX_GEOMETRY_HPP

#include <array>
#include <cstdint>

#include "math/camera.hpp"
#include "math/eigen.hpp"
#include "math/pose.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

/// Signs of a vertex in O: C_i = diag(x, y, z) / 2.
struct BoxVertex {
    std::int8_t x{1};
    std::int8_t y{1};
    std::int8_t z{1};
    [[nodiscard]] Vec3 scaled(const Vec3& size_m) const {
        return {0.5 * x * size_m(0), 0.5 * y * size_m(1), 0.5 * z * size_m(2)};
    }
};

/// The eight of them, 0..7; two that are joined by a side of the box differ in one bit.
[[nodiscard]] BoxVertex box_vertex(int i);

enum BoxEdge : int { kLeft = 0, kRight = 1, kTop = 2, kBottom = 3 };  // order of the paper's Eq. (1)
inline constexpr int kBoxEdges = 4;
/// Vertex of each edge, C_1..C_4.
using EdgeVertices = std::array<BoxVertex, kBoxEdges>;
/// Value of each edge in px: u, u, v, v.
[[nodiscard]] inline double edge_value(const Box2d& box, int edge) {
    return edge == kLeft ? box.left : edge == kRight ? box.right : edge == kTop ? box.top : box.bottom;
}

/// The paper's tables, data for all 16 classes. viewpoint must be complete (0..7, 0..1).
[[nodiscard]] const EdgeVertices& edge_vertices(Viewpoint viewpoint);

/// T_c_o: box centre, heading along O's x. The class that the camera at the origin of c sees.
[[nodiscard]] Viewpoint visible_faces(const Pose& T_c_o, const Vec3& size_m);

/// The vertices that make the extremes of the projection, found among all eight.
/// kBehindCamera: a vertex lies nearer than kMinDepth_m; out is untouched.
[[nodiscard]] Status extreme_vertices(const PinholeCamera& camera, const Pose& T_c_o, const Vec3& size_m,
                                      EdgeVertices& out);

/// Bounding box of the projected vertices, not clipped. Vertices behind the camera are clipped to the near plane
/// along the box's edges. kBehindCamera: the whole box is.
[[nodiscard]] Status projected_box(const PinholeCamera& camera, const Pose& T_c_o, const Vec3& size_m, Box2d& out);

/// Common part of two boxes over their union, 0..1.
[[nodiscard]] double box_overlap(const Box2d& a, const Box2d& b);
/// Cut to [0, width-1] x [0, height-1]. false: no overlap with the image; out untouched.
[[nodiscard]] bool clip_box(const Box2d& box, int width, int height, Box2d& out);

/// Where a box of the left image lies in the right one when its object is between two depths: each edge goes as far out
/// as either depth takes it; an edge at the left image's border stays at the border, as the object goes on behind it.
[[nodiscard]] Box2d carried_to_right(const Calibration& calibration, const Box2d& box, double near_m, double far_m);

}  // namespace semtrack

#endif
