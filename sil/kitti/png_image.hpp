// PNG in, by libpng: any PNG becomes 8-bit grey. Colour turns grey by (77 R + 150 G + 29 B + 128) >> 8, the same
// integers on every target; 16-bit samples count by their high byte; alpha, gamma and profiles are ignored.
#ifndef SEMTRACK_SIL_KITTI_PNG_IMAGE_HPP
#define SEMTRACK_SIL_KITTI_PNG_IMAGE_HPP

#include <filesystem>

#include "sil/sequence.hpp"

namespace semtrack::sil {

/// Throws InputError with the file's name when it is no whole PNG or larger than the capacity.
[[nodiscard]] GreyImage read_png(const std::filesystem::path& path);

}  // namespace semtrack::sil

#endif
