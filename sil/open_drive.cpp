#include "sil/open_drive.hpp"

#include "math/pose.hpp"
#include "math/so3.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/kitti_sequence.hpp"
#include "sil/world/world_sequence.hpp"

namespace semtrack::sil {

namespace {

constexpr double kRotationTolerance = 1e-3;

SequenceOptions kitti_options(const DriveOptions& o) {
    SequenceOptions k;
    k.layout = o.layout;
    k.root = o.root;
    k.sequence = o.sequence;
    k.calib = o.calib;
    k.detections_camera = o.detections_camera;
    k.images = o.images;
    k.width = o.width;
    k.height = o.height;
    k.poses = o.ego;
    return k;
}

}  // namespace

std::unique_ptr<Sequence> open_drive(const DriveOptions& options) {
    if (options.layout != "world") {
        return open_kitti_sequence(kitti_options(options));
    }
    if (!options.calib.empty()) {
        throw InputError(options.calib.string() + ": the layout world has its own calibration");
    }
    return std::make_unique<WorldSequence>(options.sequence);
}

std::map<int, RigidTransform> read_given_poses(const DriveOptions& options) {
    return options.layout == "world" ? read_poses(options.ego, {})
                                     : read_ego_poses(kitti_options(options), options.ego);
}

RigidTransform read_mount(const std::filesystem::path& path) {
    const TextFile file(path, false);
    std::array<double, 12> values{};
    std::size_t count = 0;
    for (const TextRow& row : file.rows()) {
        for (std::size_t i = 0; i < row.words.size(); ++i) {
            if (count == values.size()) {
                file.refuse(row, "more than 12 values");
            }
            values[count++] = file.number(row, i);
        }
    }
    if (count != values.size()) {
        throw InputError(path.string() + ": has " + std::to_string(count) + " values instead of 12");
    }
    Pose T;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            T.R(r, c) = values[static_cast<std::size_t>(4 * r + c)];
        }
        T.t(r) = values[static_cast<std::size_t>(4 * r + 3)];
    }
    const Mat3 off = T.R.transpose() * T.R - Mat3::Identity();
    if (off.cwiseAbs().maxCoeff() > kRotationTolerance || T.R.determinant() < 0.0) {
        throw InputError(path.string() + ":" + std::to_string(file.rows().front().line) + ": not a rotation");
    }
    T.R = orthonormalised(T.R);
    return to_rigid_transform(T);
}

}  // namespace semtrack::sil
