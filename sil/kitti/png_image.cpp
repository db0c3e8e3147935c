#include "sil/kitti/png_image.hpp"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>

#include "semtrack/capacity.hpp"

namespace semtrack::sil {

namespace {

struct Closer {
    void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, Closer>;

// libpng reports by long jumps; its messages must not reach the terminal.
void on_error(png_structp png, png_const_charp) {
    std::longjmp(png_jmpbuf(png), 1);
}
void on_warning(png_structp, png_const_charp) {}

struct Raw {
    png_uint_32 width{0};
    png_uint_32 height{0};
    int channels{0};
    std::vector<std::uint8_t> bytes;
    std::vector<png_bytep> rows;
};

/// Plain C inside: nothing with a destructor lives across the jump. false: broken, or too large.
bool decode(png_structp png, png_infop info, std::FILE* file, Raw& raw) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_init_io(png, file);
    png_read_info(png, info);
    raw.width = png_get_image_width(png, info);
    raw.height = png_get_image_height(png, info);
    if (raw.width > static_cast<png_uint_32>(kMaxImageWidth) ||
        raw.height > static_cast<png_uint_32>(kMaxImageHeight)) {
        return false;
    }
    png_set_strip_16(png);
    png_set_palette_to_rgb(png);
    png_set_expand_gray_1_2_4_to_8(png);
    png_set_strip_alpha(png);
    (void)png_set_interlace_handling(png);
    png_read_update_info(png, info);
    raw.channels = png_get_channels(png, info);
    const std::size_t stride = png_get_rowbytes(png, info);
    raw.bytes.resize(stride * raw.height);
    raw.rows.resize(raw.height);
    for (std::size_t y = 0; y < raw.height; ++y) {
        raw.rows[y] = raw.bytes.data() + y * stride;
    }
    png_read_image(png, raw.rows.data());
    png_read_end(png, nullptr);
    return true;
}

GreyImage to_grey(const Raw& raw) {
    GreyImage out;
    out.width = static_cast<int>(raw.width);
    out.height = static_cast<int>(raw.height);
    const std::size_t n = static_cast<std::size_t>(raw.width) * raw.height;
    out.pixels.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (raw.channels < 3) {
            out.pixels[i] = raw.bytes[i * static_cast<std::size_t>(raw.channels)];
            continue;
        }
        const std::uint8_t* p = raw.bytes.data() + 3 * i;
        out.pixels[i] = static_cast<std::uint8_t>((77 * p[0] + 150 * p[1] + 29 * p[2] + 128) >> 8);
    }
    return out;
}

}  // namespace

GreyImage read_png(const std::filesystem::path& path) {
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        throw InputError(path.string() + ": cannot be read");
    }
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    Raw raw;
    const bool ok = info != nullptr && decode(png, info, file.get(), raw);
    png_destroy_read_struct(&png, &info, nullptr);
    if (!ok && (raw.width > static_cast<png_uint_32>(kMaxImageWidth) ||
                raw.height > static_cast<png_uint_32>(kMaxImageHeight))) {
        throw InputError(path.string() + ": image of " + std::to_string(raw.width) + " x " +
                         std::to_string(raw.height) + " px is larger than " + std::to_string(kMaxImageWidth) + " x " +
                         std::to_string(kMaxImageHeight));
    }
    if (!ok) {
        throw InputError(path.string() + ": not a whole PNG image");
    }
    return to_grey(raw);
}

}  // namespace semtrack::sil
