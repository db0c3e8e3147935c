// KITTI drives on disk (raw, odometry, tracking) as a Sequence.
#ifndef SEMTRACK_SIL_KITTI_KITTI_SEQUENCE_HPP
#define SEMTRACK_SIL_KITTI_KITTI_SEQUENCE_HPP

#include <filesystem>
#include <memory>
#include <string>

#include "sil/sequence.hpp"

namespace semtrack::sil {

struct SequenceOptions {
    std::string layout;  ///< raw, odometry, tracking
    std::filesystem::path root;
    std::string sequence;
    std::filesystem::path calib;  ///< empty: the layout's own
    int detections_camera{-1};    ///< -1: 0, tracking 2
    bool images{true};
    int width{1242};  ///< without images
    int height{375};
    std::filesystem::path poses;  ///< without images: its rows are the frames
};

/// Throws InputError: missing calibration, unknown sequence, no images, images of unequal size, ...
[[nodiscard]] std::unique_ptr<Sequence> open_kitti_sequence(const SequenceOptions& options);

}  // namespace semtrack::sil

#endif
