// PNG out.
#ifndef SEMTRACK_SIL_REPORT_PNG_WRITE_HPP
#define SEMTRACK_SIL_REPORT_PNG_WRITE_HPP

#include <cstdint>
#include <filesystem>

namespace semtrack::sil {

/// channels: 1 grey, 3 RGB; rows without padding. Throws std::runtime_error with the file's name when it cannot be
/// written.
void png_write(const std::filesystem::path& path, int width, int height, int channels, const std::uint8_t* pixels);

}  // namespace semtrack::sil

#endif
