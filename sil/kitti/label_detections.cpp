#include "sil/kitti/label_detections.hpp"

#include <algorithm>
#include <cmath>

#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "sil/kitti/detection_file.hpp"

namespace semtrack::sil {

namespace {

constexpr double kOwnEdge_px = 10.0;

Pose shifted(Pose T, const std::array<double, 3>& shift) {
    T.t += Vec3(shift[0], shift[1], shift[2]);
    return T;
}

/// An edge at the border stays there until its projection comes in.
double moved(double labelled, double there, double here, int size_px) {
    const auto last = static_cast<double>(size_px - 1);
    return labelled + std::clamp(here, 0.0, last) - std::clamp(there, 0.0, last);
}

/// The cameras stand at one height: rows move by less than 0.1 px. Where the projection says otherwise, a corner of a
/// box that reaches behind the image plane makes it, and that corner is not in the picture.
double moved_row(double labelled, double there, double here, int size_px) {
    return std::fabs(there - labelled) > kOwnEdge_px ? labelled : moved(labelled, there, here, size_px);
}

Box2d moved_box(const Label& l, const Pose& T_c_o, const Vec3& size, const DriveCameras& cameras) {
    const Calibration& c = cameras.calibration;
    Box2d there;
    Box2d here;
    if (projected_box(cameras.label_camera, shifted(T_c_o, cameras.t_label_c), size, there) != Status::kOk ||
        projected_box(c.detection, shifted(T_c_o, c.t_d_c), size, here) != Status::kOk) {
        return l.box;
    }
    return {moved(l.box.left, there.left, here.left, c.width), moved_row(l.box.top, there.top, here.top, c.height),
            moved(l.box.right, there.right, here.right, c.width),
            moved_row(l.box.bottom, there.bottom, here.bottom, c.height)};
}

bool same_camera(const DriveCameras& cameras) {
    const PinholeCamera& a = cameras.label_camera;
    const PinholeCamera& b = cameras.calibration.detection;
    return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy &&
           cameras.t_label_c == cameras.calibration.t_d_c;
}

}  // namespace

Pose label_pose(const Label& label) {
    const SinCos ry = sin_cos(label.rotation_y);
    Pose T;
    T.R << ry.cos, ry.sin, 0.0, 0.0, 0.0, -1.0, -ry.sin, ry.cos, 0.0;
    T.t = Vec3(label.x, label.y - 0.5 * label.height, label.z);
    return T;
}

std::map<int, std::vector<Detection>> detections_from_labels(const std::vector<Label>& labels,
                                                             const std::vector<int>& frames,
                                                             const DriveCameras& cameras) {
    std::map<int, std::vector<Detection>> out;
    for (const int frame : frames) {
        out[frame];
    }
    const std::array<double, 3>& s = cameras.t_c0_c;
    for (const Label& l : labels) {
        Detection d;
        const auto entry = out.find(l.frame);
        if (l.type == "DontCare" || entry == out.end() || !class_from_name(l.type, d.object_class)) {
            continue;
        }
        const Pose T_c_o = shifted(label_pose(l), {-s[0], -s[1], -s[2]});
        const Vec3 size(l.length, l.width, l.height);
        d.box = same_camera(cameras) ? l.box : moved_box(l, T_c_o, size, cameras);
        d.score = 1.0;
        if (d.object_class != ObjectClass::kPedestrian) {
            d.viewpoint = l.viewpoint.horizontal >= 0 ? l.viewpoint
                                                      : visible_faces(shifted(T_c_o, cameras.calibration.t_d_c), size);
        }
        entry->second.push_back(d);
    }
    int dropped = 0;
    for (auto& [frame, list] : out) {
        tidy(list, cameras.calibration.width, cameras.calibration.height, dropped);
    }
    return out;
}

}  // namespace semtrack::sil
