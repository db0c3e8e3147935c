#include "sil/world/export_text.hpp"

#include <fstream>
#include <locale>
#include <sstream>

namespace semtrack::sil::world {

namespace {

// printf would follow the process's locale; streams with the classic one do not.
class Text {
public:
    Text() { stream_.imbue(std::locale::classic()); }
    template <class T>
    Text& operator<<(const T& value) {
        stream_ << value;
        return *this;
    }
    Text& number(double x, int digits, bool scientific = false) {
        stream_.setf(scientific ? std::ios::scientific : std::ios::fixed, std::ios::floatfield);
        stream_.precision(digits);
        stream_ << x;
        return *this;
    }
    [[nodiscard]] std::string str() const { return stream_.str(); }

private:
    std::ostringstream stream_{};
};

using Row = std::vector<double>;

void line(Text& out, const std::string& key, const Row& values, int digits) {
    out << key;
    for (const double v : values) {
        out << " ";
        out.number(v, digits, true);
    }
    out << "\n";
}

Row identity() {
    return {1, 0, 0, 0, 1, 0, 0, 0, 1};
}

// Projection matrix of the left (0, 2) or right (1, 3) camera.
Row projection(const Calibration& c, bool right) {
    const PinholeCamera& k = right ? c.right : c.left;
    const double shift = right ? -k.fx * c.baseline_m : 0.0;
    return {k.fx, 0, k.cx, shift, 0, k.fy, k.cy, 0, 0, 0, 1, 0};
}

std::string camera_number(int n) {
    return "0" + std::to_string(n);
}

}  // namespace

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
        throw std::runtime_error(path.string() + ": cannot write");
    }
}

std::string padded(int number, int digits) {
    std::string s = std::to_string(number);
    while (static_cast<int>(s.size()) < digits) {
        s.insert(s.begin(), '0');
    }
    return s;
}

std::string raw_calibration(const WorldSequence& w) {
    const Calibration& c = w.cameras().calibration;
    Text out;
    out << "calib_time: 01-Jan-2026 12:00:00\n";
    line(out, "corner_dist:", {0.0995}, 6);
    const double width = c.width;
    const double height = c.height;
    for (int n = 0; n < 4; ++n) {
        const bool right = n % 2 == 1;
        const PinholeCamera& k = right ? c.right : c.left;
        const std::string id = camera_number(n);
        line(out, "S_" + id + ":", {width, height}, 6);
        line(out, "K_" + id + ":", {k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1}, 6);
        line(out, "D_" + id + ":", {0, 0, 0, 0, 0}, 6);
        line(out, "R_" + id + ":", identity(), 6);
        line(out, "T_" + id + ":", {right ? -c.baseline_m : 0.0, 0, 0}, 6);
        line(out, "S_rect_" + id + ":", {width, height}, 6);
        line(out, "R_rect_" + id + ":", identity(), 6);
        line(out, "P_rect_" + id + ":", projection(c, right), 6);
    }
    return out.str();
}

std::string velo_to_cam() {
    Text out;
    out << "calib_time: 01-Jan-2026 12:00:00\n";
    line(out, "R:", {0, -1, 0, 0, 0, -1, 1, 0, 0}, 6);
    line(out, "T:", {0, -0.08, -0.27}, 6);
    line(out, "delta_f:", {0, 0}, 6);
    line(out, "delta_c:", {0, 0}, 6);
    return out.str();
}

std::string imu_to_velo() {
    Text out;
    out << "calib_time: 01-Jan-2026 12:00:00\n";
    line(out, "R:", identity(), 6);
    line(out, "T:", {-0.81, 0.32, -0.80}, 6);
    return out.str();
}

std::string projections(const WorldSequence& w, int count) {
    Text out;
    for (int n = 0; n < count; ++n) {
        line(out, "P" + std::to_string(n) + ":", projection(w.cameras().calibration, n % 2 == 1), 12);
    }
    return out.str();
}

std::string tracking_calibration(const WorldSequence& w) {
    Text out;
    out << projections(w, 4);
    line(out, "R0_rect:", identity(), 12);
    line(out, "Tr_velo_to_cam:", {0, -1, 0, 0, 0, 0, -1, -0.08, 1, 0, 0, -0.27}, 12);
    line(out, "Tr_imu_to_velo:", {1, 0, 0, -0.81, 0, 1, 0, 0.32, 0, 0, 1, -0.80}, 12);
    return out.str();
}

std::string time_stamps(const WorldSequence& w) {
    Text out;
    for (int frame = w.first_frame(); frame <= w.last_frame(); ++frame) {
        const std::int64_t us = w.time_us(frame);
        const int seconds = static_cast<int>(us / 1000000);
        out << "2026-01-" << padded(1 + (12 + seconds / 3600) / 24, 2) << " " << padded((12 + seconds / 3600) % 24, 2)
            << ":" << padded(seconds / 60 % 60, 2) << ":" << padded(seconds % 60, 2) << "."
            << padded(static_cast<int>(us % 1000000), 6) << "000\n";
    }
    return out.str();
}

std::string times(const WorldSequence& w) {
    Text out;
    for (int frame = w.first_frame(); frame <= w.last_frame(); ++frame) {
        out.number(1e-6 * static_cast<double>(w.time_us(frame)), 6, true) << "\n";
    }
    return out.str();
}

std::string vehicle_motion_rows(const WorldSequence& w, std::int64_t start_us, std::int64_t period_us) {
    Text out;
    std::int64_t time_us = start_us;
    for (const auto& [world_us, motion] : w.simulated_vehicle_motion()) {
        out << std::to_string(time_us) << " ";
        out.number(motion.speed, 4, true) << " ";
        out.number(motion.yaw_rate, 5, true) << "\n";
        time_us += period_us;
    }
    return out.str();
}

std::string frame_numbers(const WorldSequence& w, int digits) {
    Text out;
    for (int frame = w.first_frame(); frame <= w.last_frame(); ++frame) {
        out << padded(frame, digits) << "\n";
    }
    return out.str();
}

std::string poses(const WorldSequence& w) {
    Text out;
    for (const auto& [frame, T] : w.ego_truth()) {
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t k = 0; k < 3; ++k) {
                out.number(T.R[3 * row + k], 12, true) << " ";
            }
            out.number(T.t[row], 12, true) << (row == 2 ? "\n" : " ");
        }
    }
    return out.str();
}

std::string label_rows(const WorldSequence& w) {
    Text out;
    for (const Label& l : w.labels()) {
        out << l.frame << " " << l.id << " " << l.type << " ";
        out.number(l.truncated, 2) << " " << l.occluded;
        for (const double v : {l.alpha, l.box.left, l.box.top, l.box.right, l.box.bottom, l.height, l.width, l.length,
                               l.x, l.y, l.z, l.rotation_y}) {
            out << " ";
            out.number(v, 6);
        }
        out << "\n";
    }
    return out.str();
}

std::string viewpoint_rows(const WorldSequence& w) {
    Text out;
    for (const Label& l : w.labels()) {
        out << l.frame << " " << l.id << " " << static_cast<int>(l.viewpoint.horizontal) << " "
            << static_cast<int>(l.viewpoint.vertical) << "\n";
    }
    return out.str();
}

std::string detection_rows(const WorldSequence& w) {
    Text out;
    for (const auto& [frame, list] : w.label_detections()) {
        if (list.empty()) {
            out << frame << " none 0 0 0 0 0 -1 -1\n";
        }
        for (const Detection& d : list) {
            out << frame << " " << type_name(d.object_class);
            for (const double v : {d.score, d.box.left, d.box.top, d.box.right, d.box.bottom}) {
                out << " ";
                out.number(v, 4);
            }
            out << " " << static_cast<int>(d.viewpoint.horizontal) << " " << static_cast<int>(d.viewpoint.vertical)
                << "\n";
        }
    }
    return out.str();
}

}  // namespace semtrack::sil::world
