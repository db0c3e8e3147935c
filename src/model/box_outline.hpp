// What an image shows of a 3D box: the points that make the four edges of its 2D box when the image's left or right
// border cuts it. A roof corner outside the image is not what the top edge touches; where the roof's side leaves the
// image is. (A car beside the camera: its nearest corner would put the top edge metres off.)
#ifndef SEMTRACK_MODEL_BOX_OUTLINE_HPP
#define SEMTRACK_MODEL_BOX_OUTLINE_HPP

#include "model/box_geometry.hpp"

namespace semtrack {

/// A vertex a, or, with cut, the point between the vertices a and b in the plane x = slope z of a border.
struct OutlinePoint {
    bool valid{false};
    bool cut{false};
    BoxVertex a{};
    BoxVertex b{};
    double slope{0};

    /// x_a, x_b in the camera -> the share of b: 0 at a. Only for a cut point.
    [[nodiscard]] double share_of_b(const Vec3& x_a, const Vec3& x_b) const;
};
using BoxOutline = std::array<OutlinePoint, kBoxEdges>;

/// Points of left, right, top, bottom. Top and bottom: of the part between the two borders. Left and right: of the
/// whole box; not valid where the box goes on behind the camera on that side. Nothing in view: none is valid.
[[nodiscard]] BoxOutline box_outline(const PinholeCamera& camera, int width, const Pose& T_c_o, const Vec3& size_m);

/// The 2D box of what is seen, cut to the image. kBehindCamera: nothing is; out is untouched.
[[nodiscard]] Status seen_box(const PinholeCamera& camera, int width, int height, const Pose& T_c_o, const Vec3& size_m,
                              Box2d& out);

}  // namespace semtrack

#endif
