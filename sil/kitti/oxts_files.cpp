#include "sil/kitti/oxts_files.hpp"

#include <cmath>
#include <optional>
#include <set>

#include "math/trig.hpp"
#include "sil/kitti/drive_paths.hpp"
#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

constexpr double kEarth_m = 6378137.0;
constexpr double kRadians = kPi / 180.0;
constexpr double kMostLatitude_deg = 85.0;
constexpr std::size_t kLeastValues = 6;
constexpr std::size_t kMostValues = 30;
constexpr std::size_t kDigits = 10;

struct Fix {
    double latitude{0};  ///< rad
    double longitude{0};
    double altitude_m{0};
    Mat3 R_w_imu{Mat3::Identity()};
};

Mat3 attitude(double roll, double pitch, double yaw) {
    const SinCos r = sin_cos(roll);
    const SinCos p = sin_cos(pitch);
    const SinCos y = sin_cos(yaw);
    Mat3 Rx;
    Mat3 Ry;
    Mat3 Rz;
    Rx << 1.0, 0.0, 0.0, 0.0, r.cos, -r.sin, 0.0, r.sin, r.cos;
    Ry << p.cos, 0.0, p.sin, 0.0, 1.0, 0.0, -p.sin, 0.0, p.cos;
    Rz << y.cos, -y.sin, 0.0, y.sin, y.cos, 0.0, 0.0, 0.0, 1.0;
    return Rz * Ry * Rx;
}

Fix read_fix(const std::filesystem::path& path) {
    const TextFile file(path, true);
    if (file.rows().size() != 1U) {
        file.refuse_end("has one row, with the state of one frame");
    }
    const TextRow& row = file.rows()[0];
    file.require_words(row, kLeastValues, kMostValues);
    if (std::fabs(file.number(row, 0)) > kMostLatitude_deg) {
        file.refuse(row, "a latitude beyond 85 degrees");
    }
    Fix fix;
    fix.latitude = kRadians * file.number(row, 0);
    fix.longitude = kRadians * file.number(row, 1);
    fix.altitude_m = file.number(row, 2);
    fix.R_w_imu = attitude(file.number(row, 3), file.number(row, 4), file.number(row, 5));
    return fix;
}

/// ln tan(pi/4 + phi/2), as half of ln((1 + sin) / (1 - sin)).
double mercator(double latitude) {
    const double s = sin_cos(latitude).sin;
    return 0.5 * log_real((1.0 + s) / (1.0 - s));
}

}  // namespace

std::map<int, RigidTransform> read_oxts(const std::filesystem::path& folder, const Pose& T_c0_imu) {
    std::map<int, RigidTransform> out;
    if (!std::filesystem::is_directory(folder)) {
        return out;
    }
    const Pose T_imu_c0 = T_c0_imu.inverse();
    std::optional<Fix> first;
    Pose T_first_w;
    for (const int frame : numbered_files(folder, kDigits, ".txt")) {
        const std::string number = std::to_string(frame);
        const Fix fix = read_fix(folder / (std::string(kDigits - number.size(), '0') + number + ".txt"));
        if (!first) {
            first = fix;
        }
        // Places count from the first one: differences of large numbers are taken before they are scaled.
        const double scale = kEarth_m * sin_cos(first->latitude).cos;
        Pose T_w_imu;
        T_w_imu.R = fix.R_w_imu;
        T_w_imu.t = Vec3(scale * wrap_angle(fix.longitude - first->longitude),
                         scale * (mercator(fix.latitude) - mercator(first->latitude)),
                         fix.altitude_m - first->altitude_m);
        if (out.empty()) {
            T_first_w = T_w_imu.inverse();
        }
        out[frame] = to_rigid_transform(T_c0_imu * T_first_w * T_w_imu * T_imu_c0);
    }
    return out;
}

}  // namespace semtrack::sil
