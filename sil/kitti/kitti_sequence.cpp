#include "sil/kitti/kitti_sequence.hpp"

#include <set>
#include <utility>

#include "semtrack/capacity.hpp"
#include "sil/kitti/calibration_file.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/drive_paths.hpp"
#include "sil/kitti/label_detections.hpp"
#include "sil/kitti/mount_files.hpp"
#include "sil/kitti/oxts_files.hpp"
#include "sil/kitti/png_image.hpp"
#include "sil/kitti/tracklet_file.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTrackingPeriod_us = 103600;  // KITTI tracking has no times: 0.1036 s apart

bool is_there(const fs::path& path) {
    return !path.empty() && fs::exists(path);
}

std::map<int, RigidTransform> poses_of(const DrivePaths& paths, const fs::path& file) {
    return read_poses(file, is_there(paths.frames) ? read_frame_list(paths.frames) : std::vector<int>{});
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " px";
}

class KittiSequence final : public Sequence {
public:
    KittiSequence(const SequenceOptions& options, DrivePaths paths) : paths_(std::move(paths)) {
        const int detections = options.detections_camera >= 0 ? options.detections_camera : paths_.detections_camera;
        const fs::path calibration = options.calib.empty() ? paths_.calibration : options.calib;
        cameras_ = read_calibration(calibration, paths_.left_camera, paths_.right_camera, detections);
        if (is_there(paths_.poses)) {
            truth_ = poses_of(paths_, paths_.poses);
        } else if (is_there(paths_.oxts)) {
            const Pose T_c0_velo = read_velodyne_mount(paths_.cam_to_cam, paths_.velo_to_cam);
            truth_ = read_oxts(paths_.oxts, T_c0_velo * read_sensor_mount(paths_.imu_to_velo));
        }
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
        if (frame < 0 || static_cast<std::size_t>(frame) >= times_.size()) {
            // Counted rows: the number of the last one is its line.
            throw InputError(paths_.times.string() + ":" + std::to_string(times_.size()) + ": ends here, frame " +
                             std::to_string(frame) + " has no time");
        }
        return times_[static_cast<std::size_t>(frame)];
    }
    void load(int frame, GreyImage& left, GreyImage& right) override {
        left = load_one(paths_.left_image(frame));
        right = load_one(paths_.right_image(frame));
    }
    [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
    [[nodiscard]] const std::vector<int>& labelled_frames() const override { return labelled_; }
    [[nodiscard]] const std::map<int, RigidTransform>& ego_truth() const override { return truth_; }
    [[nodiscard]] const std::map<int, std::vector<Detection>>& label_detections() const override {
        return label_detections_;
    }

private:
    GreyImage load_one(const fs::path& path) const {
        if (!images_ || !fs::exists(path)) {
            return {};
        }
        GreyImage image = read_png(path);
        const Calibration& c = cameras_.calibration;
        if (image.width != c.width || image.height != c.height) {
            throw InputError(path.string() + ": is " + size_text(image.width, image.height) + ", the first image is " +
                             size_text(c.width, c.height));
        }
        return image;
    }

    void find_images() {
        std::set<int> numbers = image_numbers(paths_.left, paths_.digits);
        const std::set<int> right = image_numbers(paths_.right, paths_.digits);
        if (numbers.empty()) {
            throw InputError(paths_.left.string() + ": holds no images");
        }
        const GreyImage first = read_png(paths_.left_image(*numbers.begin()));
        numbers.insert(right.begin(), right.end());
        cameras_.calibration.width = first.width;
        cameras_.calibration.height = first.height;
        first_ = *numbers.begin();
        last_ = *numbers.rbegin();
        images_ = true;
    }

    void without_images(const SequenceOptions& options) {
        if (options.width < 1 || options.height < 1 || options.width > kMaxImageWidth ||
            options.height > kMaxImageHeight) {
            throw InputError("--image-size: " + size_text(options.width, options.height) + " is not within " +
                             size_text(kMaxImageWidth, kMaxImageHeight));
        }
        cameras_.calibration.width = options.width;
        cameras_.calibration.height = options.height;
        const fs::path file = options.poses.empty() ? paths_.poses : options.poses;
        const std::map<int, RigidTransform> rows = options.poses.empty() ? truth_ : poses_of(paths_, file);
        if (rows.empty()) {
            throw InputError(file.string() + ":1: has no rows: without images the frames are the rows of a poses file");
        }
        first_ = rows.begin()->first;
        last_ = rows.rbegin()->first;
    }

    /// Without images a drive may come without times, too: the tracking layout's spacing then.
    void read_stamps(bool images) {
        if (paths_.times.empty() || (!images && !fs::exists(paths_.times))) {
            return;
        }
        times_ = paths_.stamps ? read_timestamps(paths_.times) : read_times(paths_.times);
        if (times_.empty()) {
            throw InputError(paths_.times.string() + ":1: has no rows");
        }
        (void)time_us(last_);
    }

    void read_object_labels() {
        if (is_there(paths_.labels)) {
            labels_ = read_labels(paths_.labels, paths_.viewpoints);
        } else if (is_there(paths_.tracklets)) {
            labels_ =
                read_tracklets(paths_.tracklets, read_velodyne_mount(paths_.cam_to_cam, paths_.velo_to_cam), cameras_);
        } else {
            return;
        }
        if (is_there(paths_.labels) && is_there(paths_.labelled)) {
            labelled_ = read_frame_list(paths_.labelled);
        } else {
            for (int n = first_; n <= last_; ++n) {
                labelled_.push_back(n);
            }
        }
        label_detections_ = detections_from_labels(labels_, labelled_, cameras_);
    }

    DrivePaths paths_;
    DriveCameras cameras_;
    bool images_{false};
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
    if (options.detections_camera != -1 && options.detections_camera != 0 && options.detections_camera != 2) {
        throw InputError("--detections-camera " + std::to_string(options.detections_camera) + ": is 0 or 2");
    }
    return std::make_unique<KittiSequence>(options, drive_paths(options.layout, options.root, options.sequence));
}

std::map<int, RigidTransform> read_ego_poses(const SequenceOptions& options, const fs::path& file) {
    return poses_of(drive_paths(options.layout, options.root, options.sequence), file);
}

}  // namespace semtrack::sil
