// Point-cloud alignment, paper Eq. (17), the last of Sect. 5.2: the box moves so that its visible faces meet the
// recovered points. It is a change of the object frame: poses and points of the whole window move together, so r_Z does
// not change. The size stays. The result of the MAP step holds the directions that the points do not determine.
#ifndef SEMTRACK_ESTIMATE_ALIGN_ALIGN_BOX_HPP
#define SEMTRACK_ESTIMATE_ALIGN_ALIGN_BOX_HPP

#include "model/object_window.hpp"
#include "semtrack/calibration.hpp"
#include "semtrack/status.hpp"

namespace semtrack {

struct AlignmentReport {
    int points{0};   ///< that lie near a visible face
    double dx_m{0};  ///< change of the object frame, along its x
    double dy_m{0};
    double dtheta_rad{0};
};

/// Minimises sum rho(d_n^2 / sigma_n^2) + Delta^T Sigma^-1 Delta over Delta = (dx, dy, dtheta): d_n the distance of
/// landmark n, seen in the newest frame, to the nearest face the camera sees; Sigma the covariance of the MAP step. The
/// points of one face share the error of its shape: they weigh as 1 / (1 / n + (shape / point sigma)^2), not as n.
/// kNotObservable: fewer than kMinAlignmentPoints points near a face, or a class without heading; nothing changes.
/// Four fixed iterations; no allocation.
inline constexpr int kMinAlignmentPoints = 5;
Status align_box(const Calibration& calibration, ObjectWindow& window, AlignmentReport& report);

}  // namespace semtrack

#endif
