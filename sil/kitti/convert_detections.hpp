// The detection format from what people have: `semtrack-sil convert-detections`.
#ifndef SEMTRACK_SIL_KITTI_CONVERT_DETECTIONS_HPP
#define SEMTRACK_SIL_KITTI_CONVERT_DETECTIONS_HPP

#include <filesystem>
#include <optional>
#include <string>

namespace semtrack::sil {

struct ConvertOptions {
    /// kitti: results or labels, `frame id type truncated occluded alpha box h w l x y z ry [score]` in one file, or a
    ///        folder of one file a frame (NNNNNN.txt, without frame and id). alpha -10: no viewpoint.
    /// rrc: rows `frame,x1,y1,x2,y2,score`, or `frame,class,x1,y1,x2,y2,score` with COCO's number of the class (from
    /// 0). pointrcnn: rows `frame,type,x1,y1,x2,y2,score,h,w,l,x,y,z,ry,alpha` (1 pedestrian, 2 car, 3 cyclist). coco:
    /// JSON array of {image_id, category_id, bbox [x, y, w, h], score}; image_id a number or a file name.
    std::string format;
    std::filesystem::path in;
    std::filesystem::path labels_viewpoints;  ///< rrc: companion rows `frame id h_view v_view` of `labels`
    std::filesystem::path labels;             ///< KITTI tracking labels
    bool viewpoints{true};
    std::string object_class{"Car"};  ///< of rrc rows without class
    double least_score{-1e9};         ///< below: left out
    double focal_px{721.5};           ///< kitti without a 3D place: distance from the box's height
    std::optional<int> first;         ///< frames that the detector answered; default: from 0 to the last row's
    std::optional<int> last;
};

/// The text of a detection file; frames without rows become `FRAME none ..`. A box is matched with the label of largest
/// overlap, 0.5 or more, and takes its viewpoint; without one it has none. Scores beyond 0..1 are squeezed in by
/// (1 + s / (1 + |s|)) / 2. InputError by file and line.
[[nodiscard]] std::string converted_detections(const ConvertOptions& options);

}  // namespace semtrack::sil

#endif
