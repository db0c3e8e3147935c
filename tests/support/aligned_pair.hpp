// A stereo pair of the size of KITTI's: two equal cameras, rows aligned.
#ifndef SEMTRACK_TESTS_SUPPORT_ALIGNED_PAIR_HPP
#define SEMTRACK_TESTS_SUPPORT_ALIGNED_PAIR_HPP

#include "semtrack/calibration.hpp"

namespace semtrack {

inline Calibration aligned_pair() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = {721.5, 721.5, 609.6, 172.9};
    c.right = c.detection = c.left;
    c.baseline_m = 0.54;
    return c;
}

}  // namespace semtrack

#endif
