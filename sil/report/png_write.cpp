#include "sil/report/png_write.hpp"

#include <png.h>

#include <stdexcept>

namespace semtrack::sil {

void png_write(const std::filesystem::path& path, int width, int height, int channels, const std::uint8_t* pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;  // a picture a frame: time counts more than a tenth of its size
    const bool ok = png_image_write_to_file(&image, path.c_str(), 0, pixels, width * channels, nullptr) != 0;
    png_image_free(&image);
    if (!ok) {
        throw std::runtime_error(path.string() + ": cannot be written");
    }
}

}  // namespace semtrack::sil
