// 3D box inference from a 2D box and a viewpoint, paper Sect. 3.2, Eq. (1)-(2) [eq:prior], [eq:selection].
//
// Each edge says that one vertex lies in one plane through the camera, with a_e = (1, 0, -u) or (0, 1, -v) for an edge
// at the normalised coordinate u or v:
//   a_e . (p + R_c_l R_z(theta) C_e d) = 0
// Linear in p and in (cos theta, sin theta). The left null vector of the four a_e removes p and leaves
//   a cos(theta) + b sin(theta) + c = 0:  two roots (front/box/edge_planes.hpp); the viewpoint says which is allowed.
// The class's left and right vertices are exact. Those of the top and bottom edge are not (docs/viewpoints.md), so all
// sixteen pairs of corners are solved, and a solution counts when its own corners are the ones it assumed.
#ifndef SEMTRACK_FRONT_BOX_INFER_BOX_HPP
#define SEMTRACK_FRONT_BOX_INFER_BOX_HPP

#include "math/pose.hpp"
#include "model/box_geometry.hpp"
#include "semtrack/static_vector.hpp"
#include "semtrack/status.hpp"
#include "semtrack/types.hpp"

namespace semtrack {

struct BoxInferenceInput {
    Box2d box{};            ///< px of `camera`
    Viewpoint viewpoint{};  ///< -1, -1: all classes are tried; vertical alone -1: roof seen or not is tried
    ObjectClass object_class{ObjectClass::kCar};
    Vec3 size_m{Vec3::Ones()};  ///< length, width, height
    PinholeCamera camera{};
    Mat3 R_c_l{Mat3::Identity()};  ///< local-level frame (z up) to camera
    int width{0};                  ///< of the image, px: an edge at its border is the border's, not the object's
    int height{0};
    bool has_theta{false};  ///< theta is known: three edges are enough
    double theta{0};        ///< heading in L
};

struct BoxHypothesis {
    Vec3 p_c{Vec3::Zero()};  ///< box centre in the camera frame
    double theta{0};         ///< heading in L; meaningless for classes without heading
    Viewpoint viewpoint{};   ///< the faces that this pose shows
    unsigned edges{0};       ///< bit e: edge e was used
    double residual_px{0};   ///< largest distance of a used edge from the reprojected box
    double rank_px{0};       ///< order of the list: the residual, and what speaks against class or heading
};

inline constexpr int kMaxBoxHypotheses = 16;
using BoxHypotheses = StaticVector<BoxHypothesis, kMaxBoxHypotheses>;

inline constexpr double kMaxInferredDepth_m = 200.0;

/// Ranked, best first. With a viewpoint: one pose, or two where both roots show these very faces and fill this very box
/// (four in ten; no single image can tell them apart). Without: all poses that fit, those along the camera's axis
/// first. Accuracy on exact input 1e-9 m, 1e-9 rad, but near a double root, where an error e of the input becomes
/// sqrt(e). Four edges: closed form. Three: theta from the input, or the middle of the viewpoint's range of angles.
/// Classes without heading: depth from top and bottom, sideways from left or right or both. kNotObservable: fewer
/// edges, a box that no heading makes (too wide: kWidthSlack; off by 0.8 of its
/// larger side), or no pose in front of the camera within kMaxInferredDepth_m; out
/// is then empty. Bounded: at most 8 classes x (16 corner pairs + 4 passes) x 2 roots, no allocation.
Status infer_box(const BoxInferenceInput& input, BoxHypotheses& out);

/// Class that a continuous observation angle alpha = rotation_y - atan2(x, z) stands for, for an object at p_c.
[[nodiscard]] Viewpoint viewpoint_from_alpha(double alpha_rad, const Vec3& p_c, const Vec3& size_m);

}  // namespace semtrack

#endif
