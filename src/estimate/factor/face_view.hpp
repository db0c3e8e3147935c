// The faces that a detector's viewpoint class names are seen: the camera lies outside their planes.
#ifndef SEMTRACK_ESTIMATE_FACTOR_FACE_VIEW_HPP
#define SEMTRACK_ESTIMATE_FACTOR_FACE_VIEW_HPP

#include "math/eigen.hpp"
#include "model/object_window.hpp"

namespace semtrack {

struct FaceViewResidual {
    double r{0};  ///< 0: every face of the class is seen
    Vec3 J_p{Vec3::Zero()};
    double J_theta{0};
    double J_width{0};
};

/// One-sided: c the camera in O, s the sign of the class's long side (left +1, right -1): where it is not seen,
///   r = (width / 2 - s c_y) / (|c| sigma),  the angle by which it is missed. camera_l: camera centre in L.
/// Front and rear are not looked at: they tell headings 180 degrees apart, which no step changes.
[[nodiscard]] FaceViewResidual face_view_residual(const ObjectState& x, double width_m, const Vec3& camera_l,
                                                  int horizontal, double sigma_rad);

}  // namespace semtrack

#endif
