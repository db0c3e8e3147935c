#include "sil/kitti/calibration_file.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

struct Camera {
    int line{0};
    PinholeCamera K{};
    std::array<double, 3> shift{};  // x_a = x_0 + shift
};

std::optional<Camera> find_camera(const TextFile& file, int number) {
    const std::string short_name = "P" + std::to_string(number) + ":";
    const std::string long_name = "P_rect_0" + std::to_string(number) + ":";
    for (const TextRow& row : file.rows()) {
        if (row.words[0] != short_name && row.words[0] != long_name) {
            continue;
        }
        file.require_words(row, 13, 13);
        std::array<double, 12> p{};
        for (std::size_t i = 0; i < 12; ++i) {
            p[i] = file.number(row, i + 1);
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
    return std::nullopt;
}

Camera need_camera(const TextFile& file, const std::filesystem::path& path, int number) {
    const std::optional<Camera> c = find_camera(file, number);
    if (!c) {
        throw InputError(path.string() + ": no row P" + std::to_string(number));
    }
    return *c;
}

std::array<double, 3> difference(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

DriveCameras read_calibration(const std::filesystem::path& path, int left, int right, int detection) {
    const TextFile file(path, false);
    const Camera l = need_camera(file, path, left);
    const Camera r = need_camera(file, path, right);
    if (std::fabs(l.K.fx - r.K.fx) > 1e-3 * l.K.fx || std::fabs(l.K.fy - r.K.fy) > 1e-3 * l.K.fy) {
        file.refuse_line(r.line, "the focal lengths of the two cameras differ");
    }
    const double baseline = l.shift[0] - r.shift[0];
    if (!(std::fabs(baseline) > 1e-3)) {
        file.refuse_line(r.line, "the baseline is zero");
    }
    if (baseline < 0.0) {
        file.refuse_line(r.line, "the baseline has the wrong sign: the right camera is on the left");
    }
    DriveCameras out;
    Calibration& c = out.calibration;
    c.left = l.K;
    c.right = r.K;
    // The cameras' small offsets in y and z move rows by less than 0.1 px beyond a few metres: row offset measures
    // them.
    c.baseline_m = baseline;
    const Camera d = need_camera(file, path, detection);
    c.detection = d.K;
    c.t_d_c = difference(d.shift, l.shift);
    out.t_c0_c = {-l.shift[0], -l.shift[1], -l.shift[2]};
    const Camera label = find_camera(file, 2).value_or(l);
    out.label_camera = label.K;
    out.t_label_c = difference(label.shift, l.shift);
    return out;
}

}  // namespace semtrack::sil
