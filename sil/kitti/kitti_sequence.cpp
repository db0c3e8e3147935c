#include "sil/kitti/kitti_sequence.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "sil/kitti/calibration_file.hpp"
#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/png_image.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTrackingPeriod_us = 103600;  // KITTI tracking has no times: 0.1036 s apart

/// Where a layout keeps its files.
struct Paths {
    fs::path calibration;
    fs::path left;
    fs::path right;
    fs::path times;   // empty: none
    fs::path frames;  // numbers of the pose rows, may be missing
    fs::path poses;
    fs::path labels;
    fs::path viewpoints;
    fs::path labelled;
    int left_camera{0};
    int right_camera{1};
    int detections_camera{0};
    std::size_t digits{6};
    bool stamps{false};  // times are raw time stamps
};

Paths raw_paths(const fs::path& root, const std::string& id) {
    if (id.size() < 15) {
        throw InputError((root / id).string() + ": not a raw drive's name (DATE_drive_NNNN)");
    }
    const fs::path date = root / id.substr(0, 10);
    const fs::path drive = date / (id + "_sync");
    Paths p;
    p.calibration = date / "calib_cam_to_cam.txt";
    p.left = drive / "image_00" / "data";
    p.right = drive / "image_01" / "data";
    p.times = drive / "image_00" / "timestamps.txt";
    p.frames = drive / "frames.txt";
    p.poses = drive / "poses.txt";
    p.labels = drive / "label_02" / (id.substr(id.size() - 4) + ".txt");
    p.labelled = drive / "label_02" / "labelled_frames.txt";
    p.digits = 10;
    p.stamps = true;
    if (!fs::exists(drive)) {
        throw InputError(drive.string() + ": no such drive");
    }
    return p;
}

Paths odometry_paths(const fs::path& root, const std::string& id) {
    const fs::path drive = root / "sequences" / id;
    Paths p;
    p.calibration = drive / "calib.txt";
    p.left = drive / "image_0";
    p.right = drive / "image_1";
    p.times = drive / "times.txt";
    p.poses = root / "poses" / (id + ".txt");
    if (!fs::exists(drive)) {
        throw InputError(drive.string() + ": no such sequence");
    }
    return p;
}

Paths tracking_paths(const fs::path& root, const std::string& id) {
    const fs::path base = root / "training";
    Paths p;
    p.calibration = base / "calib" / (id + ".txt");
    p.left = base / "image_02" / id;
    p.right = base / "image_03" / id;
    p.poses = base / "ego_pose" / (id + ".txt");
    p.labels = base / "label_02" / (id + ".txt");
    p.viewpoints = base / "labels_viewpoints" / (id + ".txt");
    p.left_camera = 2;
    p.right_camera = 3;
    p.detections_camera = 2;
    if (!fs::exists(base)) {
        throw InputError(base.string() + ": no such folder");
    }
    if (!fs::exists(p.calibration) && !fs::exists(p.labels) && !fs::exists(p.left)) {
        throw InputError(p.calibration.string() + ": no such sequence");
    }
    return p;
}

/// Numbers of the images in a folder: names of exactly so many digits and .png; anything else is not ours.
std::set<int> image_numbers(const fs::path& folder, std::size_t digits) {
    std::set<int> out;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string stem = entry.path().stem().string();
        const bool ours = entry.path().extension() == ".png" && stem.size() == digits &&
                          std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
        if (ours && stem.compare(0, digits > 9 ? digits - 9 : 0, std::string(digits > 9 ? digits - 9 : 0, '0')) == 0) {
            out.insert(std::stoi(stem));
        }
    }
    return out;
}

class KittiSequence final : public Sequence {
public:
    KittiSequence(const SequenceOptions& options, Paths paths) : paths_(std::move(paths)) {
        const int detections = options.detections_camera >= 0 ? options.detections_camera : paths_.detections_camera;
        const fs::path calibration = options.calib.empty() ? paths_.calibration : options.calib;
        cameras_ = read_calibration(calibration, paths_.left_camera, paths_.right_camera, detections);
        read_truth();
        if (options.images) {
            find_images();
        } else {
            without_images(options);
        }
        read_stamps(options.images);
        read_object_labels();
    }

    [[nodiscard]] const DriveCameras& cameras() const override { return cameras_; }
    [[nodiscard]] int first_frame() const override { return first_; }
    [[nodiscard]] int last_frame() const override { return last_; }
    [[nodiscard]] std::int64_t time_us(int frame) const override {
        if (times_.empty()) {
            return static_cast<std::int64_t>(frame) * kTrackingPeriod_us;
        }
        return times_.at(static_cast<std::size_t>(frame));
    }
    void load(int frame, GreyImage& left, GreyImage& right) override {
        left = load_one(paths_.left, frame);
        right = load_one(paths_.right, frame);
    }
    [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return labelled_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return truth_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override {
        return label_detections_;
    }

private:
    [[nodiscard]] fs::path image_path(const fs::path& folder, int frame) const {
        std::string name = std::to_string(frame);
        name.insert(0, paths_.digits > name.size() ? paths_.digits - name.size() : 0, '0');
        return folder / (name + ".png");
    }

    GreyImage load_one(const fs::path& folder, int frame) {
        const fs::path path = image_path(folder, frame);
        if (!fs::exists(path)) {
            return {};
        }
        GreyImage image = read_png(path);
        if (image.width != cameras_.calibration.width || image.height != cameras_.calibration.height) {
            throw InputError(path.string() + ": is " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " px, the others are " +
                             std::to_string(cameras_.calibration.width) + " x " +
                             std::to_string(cameras_.calibration.height));
        }
        return image;
    }

    void find_images() {
        if (!fs::exists(paths_.left)) {
            throw InputError(paths_.left.string() + ": no such folder");
        }
        if (!fs::exists(paths_.right)) {
            throw InputError(paths_.right.string() + ": no such folder");
        }
        std::set<int> numbers = image_numbers(paths_.left, paths_.digits);
        const std::set<int> right = image_numbers(paths_.right, paths_.digits);
        if (numbers.empty()) {
            throw InputError(paths_.left.string() + ": holds no images");
        }
        const GreyImage sample = read_png(image_path(paths_.left, *numbers.begin()));
        numbers.insert(right.begin(), right.end());
        cameras_.calibration.width = sample.width;
        cameras_.calibration.height = sample.height;
        first_ = *numbers.begin();
        last_ = *numbers.rbegin();
    }

    void without_images(const SequenceOptions& options) {
        cameras_.calibration.width = options.width;
        cameras_.calibration.height = options.height;
        std::map<int, RigidTransform> rows = truth_;
        if (!options.poses.empty()) {
            rows = read_poses(options.poses, pose_numbers());
        }
        if (rows.empty()) {
            throw InputError(paths_.poses.string() + ": without images the frames come from a poses file");
        }
        first_ = rows.begin()->first;
        last_ = rows.rbegin()->first;
    }

    [[nodiscard]] std::vector<int> pose_numbers() const {
        return !paths_.frames.empty() && fs::exists(paths_.frames) ? read_frame_list(paths_.frames)
                                                                   : std::vector<int>{};
    }

    void read_truth() {
        if (fs::exists(paths_.poses)) {
            truth_ = read_poses(paths_.poses, pose_numbers());
        }
    }

    void read_stamps(bool images) {
        if (paths_.times.empty()) {
            return;
        }
        if (!images && !fs::exists(paths_.times)) {
            return;
        }
        times_ = paths_.stamps ? read_timestamps(paths_.times) : read_times(paths_.times);
        if (times_.size() <= static_cast<std::size_t>(last_)) {
            throw InputError(paths_.times.string() + ": has " + std::to_string(times_.size()) + " rows, frame " +
                             std::to_string(last_) + " has no time");
        }
    }

    void read_object_labels() {
        if (paths_.labels.empty() || !fs::exists(paths_.labels)) {
            return;
        }
        labels_ = read_labels(paths_.labels, paths_.viewpoints);
        if (!paths_.labelled.empty() && fs::exists(paths_.labelled)) {
            labelled_ = read_frame_list(paths_.labelled);
        } else {
            for (int n = first_; n <= last_; ++n) {
                labelled_.push_back(n);
            }
        }
        label_detections_ = detections_from_labels(labels_, labelled_, cameras_);
    }

    Paths paths_;
    DriveCameras cameras_;
    int first_{0};
    int last_{0};
    std::vector<std::int64_t> times_;
    std::vector<Label> labels_;
    std::vector<int> labelled_;
    std::map<int, RigidTransform> truth_;
    std::map<int, std::vector<Detection>> label_detections_;
};

}  // namespace

std::unique_ptr<Sequence> open_kitti_sequence(const SequenceOptions& options) {
    if (options.root.empty()) {
        throw InputError("--root is needed for the layout " + options.layout);
    }
    if (!fs::exists(options.root)) {
        throw InputError(options.root.string() + ": no such folder");
    }
    const Paths paths = options.layout == "raw"        ? raw_paths(options.root, options.sequence)
                        : options.layout == "odometry" ? odometry_paths(options.root, options.sequence)
                                                       : tracking_paths(options.root, options.sequence);
    return std::make_unique<KittiSequence>(options, paths);
}

}  // namespace semtrack::sil
