// KITTI drives on disk (raw, odometry, tracking) as a Sequence.
#ifndef SEMTRACK_SIL_KITTI_KITTI_SEQUENCE_HPP
#define SEMTRACK_SIL_KITTI_KITTI_SEQUENCE_HPP

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "sil/sequence.hpp"

namespace semtrack::sil {

struct SequenceOptions {
    std::string layout;  ///< raw, odometry, tracking
    std::filesystem::path root;
    std::string sequence;
    std::filesystem::path calib;  ///< empty: the layout's own
    int detections_camera{-1};    ///< 0 or 2; -1: 0, tracking 2
    bool images{true};
    int width{1242};  ///< without images
    int height{375};
    std::filesystem::path poses;  ///< without images: its rows are the frames
};

/// Throws InputError that names the path: missing calibration, folder or times, unknown layout or sequence, no images,
/// a calibration without the detections' camera. Missing labels or poses are no truth, not an error.
/// time_us() throws InputError for a frame without a time; load() for a broken image or one whose size is not the
/// first image's.
[[nodiscard]] std::unique_ptr<Sequence> open_kitti_sequence(const SequenceOptions& options);

/// Poses of `--ego FILE` for the drive of these options: frame -> pose of rectified camera 0. Raw drives with a
/// frames.txt: row n is its n-th frame; else row n is frame n.
[[nodiscard]] std::map<int, RigidTransform> read_ego_poses(const SequenceOptions& options,
                                                           const std::filesystem::path& file);

}  // namespace semtrack::sil

#endif
