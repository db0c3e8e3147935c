// Where KITTI's layouts keep their files.
#ifndef SEMTRACK_SIL_KITTI_DRIVE_PATHS_HPP
#define SEMTRACK_SIL_KITTI_DRIVE_PATHS_HPP

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace semtrack::sil {

/// An empty path: the layout has no such file. Truth files need not exist.
struct DrivePaths {
    std::filesystem::path calibration;
    std::filesystem::path left;
    std::filesystem::path right;
    std::filesystem::path times;
    std::filesystem::path frames;  ///< numbers of the pose rows
    std::filesystem::path poses;
    std::filesystem::path labels;
    std::filesystem::path viewpoints;
    std::filesystem::path labelled;    ///< frames to evaluate
    std::filesystem::path tracklets;   ///< labels of raw drives, when `labels` does not exist
    std::filesystem::path cam_to_cam;  ///< of the tracklets
    std::filesystem::path velo_to_cam;
    std::filesystem::path oxts;         ///< GPS and IMU: truth of raw drives, when `poses` does not exist
    std::filesystem::path imu_to_velo;  ///< of them
    int left_camera{0};
    int right_camera{1};
    int detections_camera{0};
    std::size_t digits{6};  ///< of an image's name
    bool stamps{false};     ///< `times` holds calendar stamps, not seconds

    [[nodiscard]] std::filesystem::path left_image(int frame) const { return left / image_name(frame); }
    [[nodiscard]] std::filesystem::path right_image(int frame) const { return right / image_name(frame); }

private:
    [[nodiscard]] std::string image_name(int frame) const;
};

/// layout: raw, odometry, tracking. InputError that names the path: no root, unknown layout, no such sequence.
[[nodiscard]] DrivePaths drive_paths(const std::string& layout, const std::filesystem::path& root,
                                     const std::string& sequence);

/// Numbers of the images in a folder: names of exactly so many digits and .png; any other file is foreign.
/// InputError: no such folder.
[[nodiscard]] std::set<int> image_numbers(const std::filesystem::path& folder, std::size_t digits);
/// The same for another ending.
[[nodiscard]] std::set<int> numbered_files(const std::filesystem::path& folder, std::size_t digits,
                                           const std::string& ending);

}  // namespace semtrack::sil

#endif
