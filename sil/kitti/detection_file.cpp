#include "sil/kitti/detection_file.hpp"

#include <algorithm>

#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

constexpr int kMaxFrame = 10000000;
constexpr const char* kNames[kObjectClasses] = {"Car", "Van", "Truck", "Pedestrian", "Cyclist", "Tram", "Misc"};

bool same_box(const Detection& a, const Detection& b) {
    return a.object_class == b.object_class && a.box.left == b.box.left && a.box.top == b.box.top &&
           a.box.right == b.box.right && a.box.bottom == b.box.bottom;
}

Detection parse(const TextFile& file, const TextRow& row) {
    Detection d;
    if (!class_from_name(std::string(row.words[1]), d.object_class)) {
        file.refuse(row, "unknown class '" + std::string(row.words[1]) + "'");
    }
    d.score = file.number(row, 2);
    d.box = {file.number(row, 3), file.number(row, 4), file.number(row, 5), file.number(row, 6)};
    const int h = file.integer(row, 7);
    const int v = file.integer(row, 8);
    if (h < -1 || h > 7 || v < -1 || v > 1 || ((h < 0) != (v < 0))) {
        file.refuse(row, "viewpoints are 0..7 and 0..1, or -1 -1");
    }
    d.viewpoint = {static_cast<std::int8_t>(h), static_cast<std::int8_t>(v)};
    return d;
}

/// Label's box as a pose in the processed left camera.
Pose label_pose(const Label& l, const DriveCameras& cameras) {
    const SinCos ry = sin_cos(l.rotation_y);
    Pose T;
    T.R << ry.cos, ry.sin, 0.0, 0.0, 0.0, -1.0, -ry.sin, ry.cos, 0.0;
    T.t = Vec3(l.x - cameras.t_c0_c[0], l.y - 0.5 * l.height - cameras.t_c0_c[1], l.z - cameras.t_c0_c[2]);
    return T;
}

Pose shifted(Pose T, const std::array<double, 3>& shift) {
    T.t += Vec3(shift[0], shift[1], shift[2]);
    return T;
}

}  // namespace

const char* class_name(ObjectClass object_class) {
    return kNames[static_cast<int>(object_class)];
}

bool class_from_name(const std::string& name, ObjectClass& out) {
    for (int i = 0; i < kObjectClasses; ++i) {
        if (name == kNames[i]) {
            out = static_cast<ObjectClass>(i);
            return true;
        }
    }
    if (name == "Person_sitting" || name == "Person") {
        out = ObjectClass::kPedestrian;
        return true;
    }
    return false;
}

void tidy(std::vector<Detection>& list, int width, int height, int& dropped) {
    std::vector<Detection> kept;
    for (const Detection& d : list) {
        Detection clipped = d;
        const bool upright = d.box.right > d.box.left && d.box.bottom > d.box.top;
        const bool doubled =
            std::any_of(kept.begin(), kept.end(), [&](const Detection& k) { return same_box(k, clipped); });
        if (!upright || !clip_box(d.box, width, height, clipped.box) ||
            std::any_of(kept.begin(), kept.end(), [&](const Detection& k) { return same_box(k, clipped); }) ||
            doubled) {
            ++dropped;
            continue;
        }
        kept.push_back(clipped);
    }
    std::stable_sort(kept.begin(), kept.end(),
                     [](const Detection& a, const Detection& b) { return a.score > b.score; });
    while (kept.size() > static_cast<std::size_t>(kMaxDetections)) {
        kept.pop_back();
        ++dropped;
    }
    list = kept;
}

Detections read_detections(const std::filesystem::path& path, int width, int height) {
    const TextFile file(path, false);
    Detections out;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, 9, 9);
        const int frame = file.integer(row, 0);
        const bool none = row.words[1] == "none";
        Detection d;
        if (!none) {
            d = parse(file, row);
        } else {
            for (std::size_t i = 2; i < 9; ++i) {
                (void)file.number(row, i);
            }
        }
        if (frame < 0 || frame > kMaxFrame) {
            ++out.bad_frames;
            continue;
        }
        std::vector<Detection>& list = out.by_frame[frame];
        if (!none) {
            list.push_back(d);
        }
    }
    for (auto& [frame, list] : out.by_frame) {
        tidy(list, width, height, out.dropped);
    }
    return out;
}

std::map<int, std::vector<Detection>> detections_from_labels(const std::vector<Label>& labels,
                                                             const std::vector<int>& frames,
                                                             const DriveCameras& cameras) {
    std::map<int, std::vector<Detection>> out;
    for (const int frame : frames) {
        out[frame];
    }
    for (const Label& l : labels) {
        Detection d;
        const auto entry = out.find(l.frame);
        if (l.type == "DontCare" || entry == out.end() || !class_from_name(l.type, d.object_class)) {
            continue;
        }
        const Pose T_c_o = label_pose(l, cameras);
        const Vec3 size(l.length, l.width, l.height);
        const Pose T_d_o = shifted(T_c_o, cameras.calibration.t_d_c);
        d.box = l.box;
        Box2d there;
        Box2d here;
        if (projected_box(cameras.label_camera, shifted(T_c_o, cameras.t_label_c), size, there) == Status::kOk &&
            projected_box(cameras.calibration.detection, T_d_o, size, here) == Status::kOk) {
            d.box = {l.box.left + here.left - there.left, l.box.top + here.top - there.top,
                     l.box.right + here.right - there.right, l.box.bottom + here.bottom - there.bottom};
        }
        d.score = 1.0;
        const bool person = d.object_class == ObjectClass::kPedestrian;
        d.viewpoint = person ? Viewpoint{} : l.viewpoint;
        if (!person && l.viewpoint.horizontal < 0) {
            d.viewpoint = visible_faces(T_d_o, size);
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
