// The camera picture with what the tracker knows: features by owner, boxes, identities, speeds.
#ifndef SEMTRACK_SIL_REPORT_PICTURE_OVERLAY_HPP
#define SEMTRACK_SIL_REPORT_PICTURE_OVERLAY_HPP

#include "semtrack/calibration.hpp"
#include "semtrack/types.hpp"
#include "sil/report/canvas.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// `left` may be empty (boxes only, a dropped frame): a dark ground of the calibration's size. Objects come from
/// their position, yaw and size in V through T_v_c; the part of a box behind the image plane is cut off. The front
/// face is crossed; coasting and new tracks are dashed; lost ones are not drawn.
[[nodiscard]] Canvas draw_overlay(int frame, const GreyImage& left, const Calibration& calibration,
                                  const Output& output);

}  // namespace semtrack::sil

#endif
