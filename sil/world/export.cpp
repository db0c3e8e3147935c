#include "sil/world/export.hpp"

#include "sil/world/export_text.hpp"
#include "sil/world/png_file.hpp"

namespace semtrack::sil {

namespace fs = std::filesystem;
using namespace world;

namespace {

constexpr const char* kDate = "2026_01_01";
constexpr std::int64_t kRawStart_us = 1767268800000000;  // 2026-01-01 12:00:00 UTC
constexpr std::int64_t kTrackingFrame_us = 103600;       // as readers take them
constexpr const char* kRawId = "2026_01_01_drive_0001";

void write_images(const WorldSequence& w, const fs::path& left_dir, const fs::path& right_dir, int digits) {
    fs::create_directories(left_dir);
    fs::create_directories(right_dir);
    GreyImage left;
    GreyImage right;
    for (int frame = w.first_frame(); frame <= w.last_frame(); ++frame) {
        w.render(frame, left, right);
        if (left.empty()) {
            continue;
        }
        const std::string name = padded(frame, digits) + ".png";
        write_png(left_dir / name, left);
        if (!right.empty()) {
            write_png(right_dir / name, right);
        }
    }
}

void export_raw(const WorldSequence& w, const fs::path& out, ExportedDrive& drive) {
    drive.id = kRawId;
    const fs::path date = out / kDate;
    const fs::path sync = date / (drive.id + "_sync");
    drive.detections = sync / "detections" / "detector_10hz.txt";
    write_images(w, sync / "image_00" / "data", sync / "image_01" / "data", 10);
    write_text(date / "calib_cam_to_cam.txt", raw_calibration(w));
    write_text(date / "calib_velo_to_cam.txt", velo_to_cam());
    write_text(date / "calib_imu_to_velo.txt", imu_to_velo());
    for (const char* camera : {"image_00", "image_01"}) {
        write_text(sync / camera / "timestamps.txt", time_stamps(w));
    }
    write_text(sync / "calib.txt", projections(w, 4));
    write_text(sync / "frames.txt", frame_numbers(w, 10));
    write_text(sync / "times.txt", times(w));
    write_text(sync / "poses.txt", poses(w));
    write_text(sync / "vehicle_motion.txt", vehicle_motion_rows(w, kRawStart_us, kFrame_us));
    write_text(sync / "label_02" / "0001.txt", label_rows(w));
    write_text(sync / "label_02" / "labelled_frames.txt", frame_numbers(w, 0));
}

void export_odometry(const WorldSequence& w, const fs::path& out, ExportedDrive& drive) {
    drive.id = "00";
    const fs::path dir = out / "sequences" / drive.id;
    drive.detections = out / "detections" / (drive.id + ".txt");
    write_images(w, dir / "image_0", dir / "image_1", 6);
    write_text(dir / "calib.txt", projections(w, 4));
    write_text(dir / "times.txt", times(w));
    write_text(out / "poses" / (drive.id + ".txt"), poses(w));
    write_text(out / "vehicle_motion" / (drive.id + ".txt"), vehicle_motion_rows(w, 0, kFrame_us));
}

void export_tracking(const WorldSequence& w, const fs::path& out, ExportedDrive& drive) {
    drive.id = "0000";
    const fs::path dir = out / "training";
    const std::string file = drive.id + ".txt";
    drive.detections = dir / "detections" / file;
    write_images(w, dir / "image_02" / drive.id, dir / "image_03" / drive.id, 6);
    write_text(dir / "calib" / file, tracking_calibration(w));
    write_text(dir / "label_02" / file, label_rows(w));
    write_text(dir / "labels_viewpoints" / file, viewpoint_rows(w));
    write_text(dir / "ego_pose" / file, poses(w));
    write_text(dir / "vehicle_motion" / file, vehicle_motion_rows(w, 0, kTrackingFrame_us));
}

}  // namespace

ExportedDrive export_world(const WorldSequence& world_sequence, ExportLayout layout, const fs::path& out) {
    ExportedDrive drive;
    switch (layout) {
        case ExportLayout::kRaw:
            export_raw(world_sequence, out, drive);
            break;
        case ExportLayout::kOdometry:
            export_odometry(world_sequence, out, drive);
            break;
        case ExportLayout::kTracking:
            export_tracking(world_sequence, out, drive);
            break;
    }
    write_text(drive.detections, detection_rows(world_sequence));
    return drive;
}

ExportLayout export_layout(const std::string& name) {
    if (name == "raw") {
        return ExportLayout::kRaw;
    }
    if (name == "odometry") {
        return ExportLayout::kOdometry;
    }
    if (name == "tracking") {
        return ExportLayout::kTracking;
    }
    throw InputError("unknown layout '" + name + "' (raw, odometry, tracking)");
}

}  // namespace semtrack::sil
