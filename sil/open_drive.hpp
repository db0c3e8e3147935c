// Any drive by its options, and the files beside it that the command line names.
#ifndef SEMTRACK_SIL_OPEN_DRIVE_HPP
#define SEMTRACK_SIL_OPEN_DRIVE_HPP

#include <filesystem>
#include <map>
#include <memory>

#include "sil/options.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

/// All of these throw InputError.
[[nodiscard]] std::unique_ptr<Sequence> open_drive(const DriveOptions& options);
/// `--ego FILE`: frame -> pose of rectified camera 0.
[[nodiscard]] std::map<int, RigidTransform> read_given_poses(const DriveOptions& options);
/// `--mount FILE`: T_v_c, 12 values row by row, on one line or several; no rotation: refused.
[[nodiscard]] RigidTransform read_mount(const std::filesystem::path& path);

}  // namespace semtrack::sil

#endif
