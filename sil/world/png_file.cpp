#include "sil/world/png_file.hpp"

#include <png.h>

#include <stdexcept>

namespace semtrack::sil::world {

void write_png(const std::filesystem::path& path, const GreyImage& image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_GRAY;
    png.flags = PNG_IMAGE_FLAG_FAST;  // a third larger, in a quarter of the time
    if (png_image_write_to_file(&png, path.c_str(), 0, image.pixels.data(), image.width, nullptr) == 0) {
        throw std::runtime_error(path.string() + ": cannot write (" + png.message + ")");
    }
}

}  // namespace semtrack::sil::world
