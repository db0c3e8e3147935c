#include "sil/kitti/calibration_file.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

constexpr double kFocalTolerance = 1e-6;  // the last printed digit of KITTI's files
constexpr double kMinBaseline_m = 1e-3;

struct Camera {
    int line{0};
    PinholeCamera K{};
    std::array<double, 3> shift{};  // x_a = x_0 + shift
};

/// P = K [I | shift]: anything else is no rectified camera.
Camera camera_of_row(const TextFile& file, const TextRow& row) {
    file.require_words(row, 13, 13);
    std::array<double, 12> p{};
    for (std::size_t i = 0; i < 12; ++i) {
        p[i] = file.number(row, i + 1);
    }
    if (p[1] != 0.0 || p[4] != 0.0 || p[8] != 0.0 || p[9] != 0.0 || p[10] != 1.0) {
        file.refuse(row, "not the projection of a rectified camera");
    }
    Camera c;
    c.line = row.line;
    c.K = {p[0], p[5], p[2], p[6]};
    if (!(c.K.fx > 1.0) || !(c.K.fy > 1.0)) {
        file.refuse(row, "the focal length is not positive");
    }
    c.shift = {(p[3] - c.K.cx * p[11]) / c.K.fx, (p[7] - c.K.cy * p[11]) / c.K.fy, p[11]};
    return c;
}

std::optional<Camera> find_camera(const TextFile& file, int number) {
    const std::string short_name = "P" + std::to_string(number) + ":";
    const std::string long_name = "P_rect_0" + std::to_string(number) + ":";
    std::optional<Camera> found;
    for (const TextRow& row : file.rows()) {
        if (row.words[0] != short_name && row.words[0] != long_name) {
            continue;
        }
        if (found) {
            file.refuse(row, "a second row for camera " + std::to_string(number));
        }
        found = camera_of_row(file, row);
    }
    return found;
}

Camera need_camera(const TextFile& file, int number) {
    const std::optional<Camera> c = find_camera(file, number);
    if (!c) {
        file.refuse_end("no row P" + std::to_string(number) + ": or P_rect_0" + std::to_string(number) + ":");
    }
    return *c;
}

std::array<double, 3> difference(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

DriveCameras read_calibration(const std::filesystem::path& path, int left, int right, int detection) {
    const TextFile file(path, false);
    const Camera l = need_camera(file, left);
    const Camera r = need_camera(file, right);
    if (std::fabs(l.K.fx - r.K.fx) > kFocalTolerance * l.K.fx ||
        std::fabs(l.K.fy - r.K.fy) > kFocalTolerance * l.K.fy) {
        file.refuse_line(r.line, "the focal lengths of the two cameras differ");
    }
    const double baseline = l.shift[0] - r.shift[0];
    if (!(std::fabs(baseline) > kMinBaseline_m)) {
        file.refuse_line(r.line, "the baseline is zero");
    }
    if (baseline < 0.0) {
        file.refuse_line(r.line, "the baseline has the wrong sign: the right camera is on the left");
    }
    DriveCameras out;
    Calibration& c = out.calibration;
    c.left = l.K;
    c.right = r.K;
    c.baseline_m = baseline;
    // A right camera lower or higher than the left one by dy moves rows by fy dy / z, which is a share of the
    // disparity fx b / z. (KITTI's colour pairs: 0.0052; 0.0043 is measured.) The rest of the row offset is no matter
    // of this file. A shift along z (0.02 mm there) has no place in Calibration and no effect.
    c.row_offset.per_disparity = l.K.fy * (r.shift[1] - l.shift[1]) / (l.K.fx * baseline);
    const Camera d = need_camera(file, detection);
    c.detection = d.K;
    c.t_d_c = difference(d.shift, l.shift);
    out.t_c0_c = {-l.shift[0], -l.shift[1], -l.shift[2]};
    const Camera label = find_camera(file, 2).value_or(l);
    out.label_camera = label.K;
    out.t_label_c = difference(label.shift, l.shift);
    return out;
}

}  // namespace semtrack::sil
