// What everything in the street is made of: convex polyhedra with textured faces, and ellipsoids.
//
// Model frame M of a thing: x forward (along the street for houses), y left, z up, origin on the ground.
// World frame N of the street: x right, y down, z forward (camera axes), origin on the road under the first camera.
#ifndef SEMTRACK_SIL_WORLD_MODEL_PIECE_HPP
#define SEMTRACK_SIL_WORLD_MODEL_PIECE_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "math/eigen.hpp"
#include "math/pose.hpp"

namespace semtrack::sil::world {

enum class Material : std::uint8_t {
    kPlain,    ///< tone with fine noise
    kAsphalt,  ///< world coordinates: cracks, patches, lane markings
    kPaving,   ///< stones with joints; kerb
    kFacade,   ///< p: length, height, window spacing, style
    kRoof,
    kBrick,
    kLeaves,
    kBark,
    kCarSide,   ///< p: length, height, wheel radius, beltline
    kCarFront,  ///< p: width, height
    kCarRear,
    kCarTop,     ///< hood, boot, roof
    kGlassSide,  ///< p: height of the beltline, height, length
    kGlassEnd,
    kWheel,  ///< p: centre x, centre z, radius
    kCargo,  ///< tarpaulin with lettering
    kCloth,
    kSkin,
    kSign
};

struct Surface {
    Material material{Material::kPlain};
    float tone{0.5F};  ///< reflectance 0..1
    std::uint32_t seed{0};
    std::array<float, 4> p{};
};

/// Half space n x <= d. Texture coordinates are model coordinates: s = s_axis x + s0, the two axes along which the
/// face extends most, so that a texture sticks to its thing.
struct Face {
    Vec3 n{Vec3::Zero()};
    double d{0};
    Vec3 s_axis{Vec3::Zero()};
    Vec3 t_axis{Vec3::Zero()};
    double s0{0};
    double t0{0};
    Surface surface{};
};

struct Piece {
    // Polyhedron: outline for screen bounds (empty: unbounded, like the road).
    std::vector<Vec3> vertices{};
    std::vector<Face> faces{};
    // Ellipsoid if radii are not zero: |diag(1/radii) R^T (x - centre)| <= 1.
    Vec3 centre{Vec3::Zero()};
    Vec3 radii{Vec3::Zero()};
    Mat3 R{Mat3::Identity()};
    Surface skin{};      ///< of the ellipsoid
    bool ragged{false};  ///< leaves with holes at the rim

    [[nodiscard]] bool is_ellipsoid() const { return radii(0) > 0.0; }
};

using Pieces = std::vector<Piece>;

/// Polygon in the plane of `a` and `b` (convex, counter-clockwise), extruded along `c` = a x b or its opposite.
/// The half width falls linearly from half_low at b_low to half_high at b_high: a cabin is narrower at the roof.
struct Prism {
    std::vector<Vec2> profile{};
    Vec3 a{1, 0, 0};
    Vec3 b{0, 0, 1};
    Vec3 c{0, 1, 0};
    Vec3 origin{Vec3::Zero()};
    double half_low{0.5};
    double half_high{0.5};
    double b_low{0};
    double b_high{1};
};
/// Faces: one per profile edge (edge k from vertex k), then the +c side, then the -c side.
[[nodiscard]] Piece make_prism(const Prism& prism, const Surface& surface);
/// Axis-parallel box [lo, hi] in M. Faces: bottom, front (+x), top, rear, left (+y), right.
[[nodiscard]] Piece make_box(const Vec3& lo, const Vec3& hi, const Surface& surface);
/// Cylinder of n faces between two points; its two ends are the last faces.
[[nodiscard]] Piece make_rod(const Vec3& from, const Vec3& to, double radius, int n, const Surface& surface);
[[nodiscard]] Piece make_ellipsoid(const Vec3& centre, const Vec3& radii, const Surface& surface);

/// The piece seen from frame a: T_a_b applied to everything.
[[nodiscard]] Piece transformed(const Piece& piece, const Pose& T_a_b);
/// T_n_m of a thing at (x, height, z) in N; heading from +z towards +x, pitch nose up.
[[nodiscard]] Pose model_pose(double x, double y, double z, double heading_rad, double pitch_rad = 0.0);

}  // namespace semtrack::sil::world

#endif
