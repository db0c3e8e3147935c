// `--pictures`: a picture a frame and two of the whole drive.
#ifndef SEMTRACK_SIL_REPORT_PICTURE_WRITER_HPP
#define SEMTRACK_SIL_REPORT_PICTURE_WRITER_HPP

#include <filesystem>
#include <map>
#include <vector>

#include "semtrack/calibration.hpp"
#include "semtrack/types.hpp"
#include "sil/report/picture_birdseye.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Writes DIR/pictures/NNNNNN.png (the camera picture above, the bird's eye view below), and at the end
/// DIR/pictures/birdseye.png (the drive in W) and DIR/pictures/trajectory.png (the ego path against its truth).
/// Truth is grey and left out where there is none. Throws std::runtime_error when a file cannot be written.
class PictureWriter {
public:
    /// Creates DIR/pictures. calibration: as the tracker has it (with its mount). The sequence is asked for its
    /// labels, ego truth and cameras in here only.
    PictureWriter(const std::filesystem::path& dir, const Calibration& calibration, const Sequence& sequence);
    /// Once per frame number, growing; left may be empty.
    void add(int frame, const GreyImage& left, const Output& output);
    void finish();

private:
    [[nodiscard]] std::vector<PlanBox> labelled_boxes(int frame) const;  ///< in V

    std::filesystem::path folder_;
    Calibration calibration_;
    std::array<double, 3> t_c0_c_;
    std::map<int, std::vector<Label>> labels_;
    std::map<int, RigidTransform> ego_truth_;
    std::map<int, RigidTransform> poses_w_;
    std::vector<PlanBox> labelled_w_;
    PlanHistory history_;
};

/// A label's footprint in V: from rectified camera 0 through the processed camera and the mount.
[[nodiscard]] PlanBox plan_box(const Label& label, const RigidTransform& T_v_c, const std::array<double, 3>& t_c0_c);

}  // namespace semtrack::sil

#endif
