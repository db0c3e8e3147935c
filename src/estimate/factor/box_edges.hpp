// Semantic measurement r_S, paper Eq. (13)-(14) [eq:semantic-factor]: edges of the 2D box against the projections of
// the vertices that make them,
//   r_i = (pi(h_Ci)_{u or v} - b_i) / sigma_i,   h_Ci = R_c_l (p + R_z(theta) C_i d) + t_c_l + t_d_c   [px / px]
// The paper takes the prior's size; here d is the window's state, so that box edges inform the size.
#ifndef SEMTRACK_ESTIMATE_FACTOR_BOX_EDGES_HPP
#define SEMTRACK_ESTIMATE_FACTOR_BOX_EDGES_HPP

#include <array>

#include "model/box_outline.hpp"
#include "model/object_window.hpp"

namespace semtrack {

/// Where the detections' camera stands at a frame: x_d = T_d_l * x_l.
struct DetectionView {
    PinholeCamera camera{};
    Pose T_d_l{};
    int width{0};  ///< of the image, px
};

struct EdgeResidual {
    bool valid{false};
    double r{0};
    Vec6 J_state{Vec6::Zero()};  ///< by (p, theta, v, delta)
    Vec3 J_size{Vec3::Zero()};
};
using EdgeResiduals = std::array<EdgeResidual, kBoxEdges>;

/// Heading that the box has for projections. A pedestrian has none: his box faces the camera.
[[nodiscard]] double box_heading(const ObjectState& x, ObjectClass object_class, const DetectionView& view);

/// Edges with sigma 0, without a point in the outline, or whose point is behind the camera, stay invalid. derivatives:
/// fill J too. A class without heading has no derivative by theta. Constant cost, no allocation.
void box_edge_residuals(const ObjectState& x, ObjectClass object_class, const Vec3& size_m, const DetectionView& view,
                        const BoxOutline& outline, const BoxMeasurement& box, bool derivatives, EdgeResiduals& out);

}  // namespace semtrack

#endif
