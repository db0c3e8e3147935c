// Masks, paper Sect. 4: the convex contour of every projected 3D box, nearer objects over farther ones; each pixel has
// one owner. A truncated object whose pose is not known gives its 2D box.
#ifndef SEMTRACK_FRONT_MASK_OWNER_MASK_BUILDER_HPP
#define SEMTRACK_FRONT_MASK_OWNER_MASK_BUILDER_HPP

#include "math/pose.hpp"
#include "model/box_geometry.hpp"
#include "model/owner_mask.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/static_vector.hpp"

namespace semtrack {

struct MaskItem {
    std::uint8_t owner{1};
    bool has_box3d{false};
    Pose T_c_o{};  ///< in the camera whose mask is built
    Vec3 size_m{Vec3::Ones()};
    double depth_m{0};      ///< decides who hides whom
    bool has_box2d{false};  ///< detection: pixels inside it but outside the contour are nobody's
    Box2d box2d{};
};
using MaskItems = StaticVector<MaskItem, kMaxObjects>;

struct MaskResult {
    double visible_share{1};  ///< of the contour inside the image
    double truncation{0};     ///< share of the projected box outside the image
};
using MaskResults = StaticVector<MaskResult, kMaxObjects>;

class OwnerMaskBuilder {
public:
    /// results[i] belongs to items[i]. Pixels within kGuard_px of a 3D contour's 2D detection stay without owner: they
    /// may be the object's (mirrors, shadows) and must not count as background. Cost: pixels of all boxes.
    void build(const PinholeCamera& camera, int width, int height, const MaskItems& items, OwnerMask& mask,
               MaskResults& results);

    /// Background inside the box becomes nobody's: an object that is seen, but not placed yet.
    static void leave_out(const Box2d& box, OwnerMask& mask);

private:
    struct Contour {
        StaticVector<Vec2, 16> corners{};
        Box2d bounds{};
    };
    [[nodiscard]] bool contour_of(const PinholeCamera& camera, const MaskItem& item, Contour& out) const;
    int fill(const Contour& contour, std::uint8_t owner, OwnerMask& mask) const;

    std::array<int, kMaxObjects> order_{};
    std::array<int, kMaxObjects> painted_{};
    std::array<int, 256> count_{};
    Contour contour_{};
};

}  // namespace semtrack

#endif
