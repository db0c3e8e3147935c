#include "math/pose.hpp"

#include <cmath>

namespace semtrack {

Pose to_pose(const RigidTransform& T) {
    Pose p;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) { p.R(r, c) = T.R[static_cast<std::size_t>(3 * r + c)]; }
        p.t(r) = T.t[static_cast<std::size_t>(r)];
    }
    return p;
}

RigidTransform to_rigid_transform(const Pose& T) {
    RigidTransform out;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) { out.R[static_cast<std::size_t>(3 * r + c)] = T.R(r, c); }
        out.t[static_cast<std::size_t>(r)] = T.t(r);
    }
    return out;
}

bool is_finite(const Pose& T) {
    bool ok = true;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) { ok = ok && std::isfinite(T.R(r, c)); }
        ok = ok && std::isfinite(T.t(r));
    }
    return ok;
}

}  // namespace semtrack
