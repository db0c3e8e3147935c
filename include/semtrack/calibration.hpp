// Geometry of the rectified pair, its mount, and the camera the detector looks through.
#ifndef SEMTRACK_CALIBRATION_HPP
#define SEMTRACK_CALIBRATION_HPP

#include "semtrack/types.hpp"

namespace semtrack {

/// u = fx x/z + cx, v = fy y/z + cy.
struct PinholeCamera {
    double fx{0};
    double fy{0};
    double cx{0};
    double cy{0};
};

/// Row of a point in the right image: v_R = v_L + (cy_R - cy_L) + constant + slope (v_L - cy_L) + per_disparity d.
struct RowOffset {
    double constant{0};       ///< px
    double slope{0};          ///< px per px
    double per_disparity{0};  ///< px per px
};

struct Calibration {
    int width{0};
    int height{0};
    PinholeCamera left{};
    PinholeCamera right{};              ///< fx, fy as left; cx, cy may differ (disparity = uL - uR - (cxL - cxR))
    double baseline_m{0};               ///< the right camera stands at x = +baseline in C
    RowOffset row_offset{};
    RigidTransform T_v_c{{0, 0, 1, -1, 0, 0, 0, -1, 0}, {0, 0, 0}};  ///< default: V at the camera, axes permuted
    PinholeCamera detection{};          ///< camera in whose pixels the detections' boxes are
    std::array<double, 3> t_d_c{};      ///< x_d = x_c + t_d_c: that camera is rectified with the pair
};

}  // namespace semtrack

#endif
