#include "sil/report/picture_writer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "math/pose.hpp"
#include "sil/report/picture_overlay.hpp"
#include "sil/report/picture_trajectory.hpp"
#include "sil/report/png_write.hpp"

namespace semtrack::sil {

namespace {

void write(const std::filesystem::path& path, const Canvas& canvas) {
    png_write(path, canvas.width(), canvas.height(), 3, canvas.data());
}

}  // namespace

PlanBox plan_box(const Label& label, const RigidTransform& T_v_c, const std::array<double, 3>& t_c0_c) {
    const Pose T = to_pose(T_v_c);
    const Vec3 centre_v = T * Vec3(label.x - t_c0_c[0], label.y - 0.5 * label.height - t_c0_c[1], label.z - t_c0_c[2]);
    const Vec3 heading_v = T.R * Vec3(std::cos(label.rotation_y), 0.0, -std::sin(label.rotation_y));
    return {centre_v(0), centre_v(1), std::atan2(heading_v(1), heading_v(0)), label.length, label.width};
}

PictureWriter::PictureWriter(const std::filesystem::path& dir, const Calibration& calibration, const Sequence& sequence)
    : folder_(dir / "pictures"),
      calibration_(calibration),
      t_c0_c_(sequence.cameras().t_c0_c),
      ego_truth_(sequence.ego_truth()) {
    std::filesystem::create_directories(folder_);
    for (const Label& l : sequence.labels()) {
        if (l.type != "DontCare") {
            labels_[l.frame].push_back(l);
        }
    }
}

std::vector<PlanBox> PictureWriter::labelled_boxes(int frame) const {
    std::vector<PlanBox> out;
    const auto labels = labels_.find(frame);
    if (labels != labels_.end()) {
        for (const Label& l : labels->second) {
            out.push_back(plan_box(l, calibration_.T_v_c, t_c0_c_));
        }
    }
    return out;
}

void PictureWriter::add(int frame, const GreyImage& left, const Output& output) {
    constexpr int kBirdseyeHeight_px = 480;
    history_.add(output);
    poses_w_[frame] = output.ego.T_w_v;
    const std::vector<PlanBox> truth = labelled_boxes(frame);
    const Pose T_w_v = to_pose(output.ego.T_w_v);
    for (const PlanBox& b : truth) {
        const Vec3 centre = T_w_v * Vec3(b.x, b.y, 0.0);
        const Vec3 heading = T_w_v.R * Vec3(std::cos(b.yaw), std::sin(b.yaw), 0.0);
        labelled_w_.push_back({centre(0), centre(1), std::atan2(heading(1), heading(0)), b.length, b.width});
    }
    const Canvas overlay = draw_overlay(frame, left, calibration_, output);
    const Canvas above = draw_birdseye(overlay.width(), kBirdseyeHeight_px, output, history_, truth);
    Canvas picture(overlay.width(), overlay.height() + above.height(), kPaper);
    picture.paste(overlay, 0, 0);
    picture.paste(above, 0, overlay.height());
    const std::string number = std::to_string(frame);
    write(folder_ / (std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png"), picture);
}

void PictureWriter::finish() {
    const std::map<int, std::array<double, 3>> truth =
        truth_in_world(ego_truth_, poses_w_, calibration_.T_v_c, t_c0_c_);
    std::vector<std::array<double, 2>> path;
    for (const auto& [frame, p] : truth) {
        if (poses_w_.count(frame) > 0) {
            path.push_back({p[0], p[1]});
        }
    }
    write(folder_ / "birdseye.png", draw_map(history_, path, labelled_w_));
    write(folder_ / "trajectory.png", draw_trajectory(poses_w_, truth));
}

}  // namespace semtrack::sil
