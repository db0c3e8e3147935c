#include "sil/kitti/drive_paths.hpp"

#include <algorithm>

#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDateLength = 10;  // 2011_09_26
constexpr std::size_t kDriveDigits = 4;  // .._drive_0039

DrivePaths raw_paths(const fs::path& root, const std::string& id) {
    if (id.size() < kDateLength + kDriveDigits) {
        throw InputError((root / id).string() + ": not a raw drive's name (DATE_drive_NNNN)");
    }
    const fs::path date = root / id.substr(0, kDateLength);
    const fs::path drive = date / (id + "_sync");
    if (!fs::is_directory(drive)) {
        throw InputError(drive.string() + ": no such drive");
    }
    DrivePaths p;
    p.calibration = date / "calib_cam_to_cam.txt";
    p.left = drive / "image_00" / "data";
    p.right = drive / "image_01" / "data";
    p.times = drive / "image_00" / "timestamps.txt";
    p.frames = drive / "frames.txt";
    p.poses = drive / "poses.txt";
    p.labels = drive / "label_02" / (id.substr(id.size() - kDriveDigits) + ".txt");
    p.labelled = drive / "label_02" / "labelled_frames.txt";
    p.tracklets = drive / "tracklet_labels.xml";
    p.cam_to_cam = date / "calib_cam_to_cam.txt";
    p.velo_to_cam = date / "calib_velo_to_cam.txt";
    p.oxts = drive / "oxts" / "data";
    p.imu_to_velo = date / "calib_imu_to_velo.txt";
    p.digits = 10;
    p.stamps = true;
    return p;
}

DrivePaths odometry_paths(const fs::path& root, const std::string& id) {
    const fs::path drive = root / "sequences" / id;
    if (id.empty() || !fs::is_directory(drive)) {
        throw InputError(drive.string() + ": no such sequence");
    }
    DrivePaths p;
    p.calibration = drive / "calib.txt";
    p.left = drive / "image_0";
    p.right = drive / "image_1";
    p.times = drive / "times.txt";
    p.poses = root / "poses" / (id + ".txt");
    return p;
}

DrivePaths tracking_paths(const fs::path& root, const std::string& id) {
    const fs::path base = root / "training";
    if (!fs::is_directory(base)) {
        throw InputError(base.string() + ": no such folder");
    }
    DrivePaths p;
    p.calibration = base / "calib" / (id + ".txt");
    p.left = base / "image_02" / id;
    p.right = base / "image_03" / id;
    p.poses = base / "ego_pose" / (id + ".txt");
    p.labels = base / "label_02" / (id + ".txt");
    p.viewpoints = base / "labels_viewpoints" / (id + ".txt");
    p.left_camera = 2;
    p.right_camera = 3;
    p.detections_camera = 2;
    if (id.empty() || (!fs::exists(p.calibration) && !fs::exists(p.labels) && !fs::exists(p.left))) {
        throw InputError(p.calibration.string() + ": no such sequence");
    }
    return p;
}

/// -1: not ours.
int number_of(const std::string& name, std::size_t digits, const std::string& ending) {
    constexpr std::size_t kFitsInt = 9;
    if (name.size() != digits + ending.size() || name.compare(digits, ending.size(), ending) != 0 ||
        !std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits),
                     [](char c) { return c >= '0' && c <= '9'; })) {
        return -1;
    }
    const std::size_t head = digits > kFitsInt ? digits - kFitsInt : 0;
    if (name.compare(0, head, std::string(head, '0')) != 0) {
        return -1;
    }
    return std::stoi(name.substr(head, digits - head));
}

}  // namespace

std::string DrivePaths::image_name(int frame) const {
    const std::string number = std::to_string(frame);
    return std::string(digits > number.size() ? digits - number.size() : 0, '0') + number + ".png";
}

DrivePaths drive_paths(const std::string& layout, const fs::path& root, const std::string& sequence) {
    if (layout != "raw" && layout != "odometry" && layout != "tracking") {
        throw InputError("--layout " + layout + ": KITTI's layouts are raw, odometry and tracking");
    }
    if (root.empty()) {
        throw InputError("--root is needed for the layout " + layout);
    }
    if (!fs::is_directory(root)) {
        throw InputError(root.string() + ": no such folder");
    }
    return layout == "raw"        ? raw_paths(root, sequence)
           : layout == "odometry" ? odometry_paths(root, sequence)
                                  : tracking_paths(root, sequence);
}

std::set<int> image_numbers(const fs::path& folder, std::size_t digits) {
    return numbered_files(folder, digits, ".png");
}

std::set<int> numbered_files(const fs::path& folder, std::size_t digits, const std::string& ending) {
    std::error_code error;
    fs::directory_iterator it(folder, error);
    if (error) {
        throw InputError(folder.string() + ": no such folder");
    }
    std::set<int> out;
    for (const fs::directory_entry& entry : it) {
        const int number = number_of(entry.path().filename().string(), digits, ending);
        if (number >= 0) {
            out.insert(number);
        }
    }
    return out;
}

}  // namespace semtrack::sil
