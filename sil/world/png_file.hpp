// 8-bit grey PNG by libpng.
#ifndef SEMTRACK_SIL_WORLD_PNG_FILE_HPP
#define SEMTRACK_SIL_WORLD_PNG_FILE_HPP

#include <filesystem>

#include "sil/sequence.hpp"

namespace semtrack::sil::world {

/// Throws std::runtime_error if the file cannot be written.
void write_png(const std::filesystem::path& path, const GreyImage& image);

}  // namespace semtrack::sil::world

#endif
