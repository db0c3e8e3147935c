#include "sil/kitti/png_image.hpp"

#include <png.h>

#include <functional>

#include "semtrack/capacity.hpp"
#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

constexpr int kWidth = 13;
constexpr int kHeight = 9;

std::uint8_t grey_at(int x, int y) {
    return static_cast<std::uint8_t>(x * 19 + y * 3);
}

struct Form {
    int type;
    int depth;
    int interlace{PNG_INTERLACE_NONE};
    std::function<void(png_structp, png_infop)> extra{};
};

/// Bytes of a pixel with all colours equal to grey; alpha and low bytes hold something else.
void put_pixel(std::vector<std::uint8_t>& row, const Form& form, std::uint8_t grey) {
    const bool colour = (form.type & PNG_COLOR_MASK_COLOR) != 0 && (form.type & PNG_COLOR_MASK_PALETTE) == 0;
    const int samples = (colour ? 3 : 1) + ((form.type & PNG_COLOR_MASK_ALPHA) != 0 ? 1 : 0);
    for (int s = 0; s < samples; ++s) {
        const bool alpha = s == samples - 1 && (form.type & PNG_COLOR_MASK_ALPHA) != 0;
        row.push_back(alpha ? static_cast<std::uint8_t>(grey / 2) : grey);
        if (form.depth == 16) {
            row.push_back(grey);
        }
    }
}

void write_form(const std::filesystem::path& path, const Form& form) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, kWidth, kHeight, form.depth, form.type, form.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    if (form.type == PNG_COLOR_TYPE_PALETTE) {
        for (int i = 0; i < 256; ++i) {
            const auto v = static_cast<png_byte>(i);
            palette.push_back({v, v, v});
        }
        png_set_PLTE(png, info, palette.data(), 256);
    }
    if (form.extra) {
        form.extra(png, info);
    }
    png_write_info(png, info);
    std::vector<std::vector<std::uint8_t>> rows(kHeight);
    std::vector<png_bytep> pointers;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            put_pixel(rows[static_cast<std::size_t>(y)], form, grey_at(x, y));
        }
        pointers.push_back(rows[static_cast<std::size_t>(y)].data());
    }
    png_write_image(png, pointers.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

class PngImages : public TempFiles {
protected:
    void expect_the_grey_image(const Form& form) const {
        const std::filesystem::path path = at("form.png");
        write_form(path, form);
        const GreyImage image = read_png(path);
        ASSERT_EQ(image.width, kWidth);
        ASSERT_EQ(image.height, kHeight);
        int wrong = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                wrong += image.view().at(x, y) == grey_at(x, y) ? 0 : 1;
            }
        }
        EXPECT_EQ(wrong, 0);
    }
};

TEST_F(PngImages, EveryFormOfAGreyPictureReadsAsTheSameBytes) {
    for (const int depth : {8, 16}) {
        for (const int type :
             {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA}) {
            for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
                SCOPED_TRACE(testing::Message() << "depth " << depth << " type " << type << " interlace " << interlace);
                expect_the_grey_image({type, depth, interlace});
            }
        }
    }
    expect_the_grey_image({PNG_COLOR_TYPE_PALETTE, 8});
    expect_the_grey_image({PNG_COLOR_TYPE_PALETTE, 8, PNG_INTERLACE_ADAM7});
}

TEST_F(PngImages, GammaProfilesAndTransparencyChunksChangeNothing) {
    const auto gamma = [](png_structp png, png_infop info) { png_set_gAMA(png, info, 0.3); };
    const auto srgb = [](png_structp png, png_infop info) {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    };
    const auto key = [](png_structp png, png_infop info) {
        png_color_16 grey{};
        grey.gray = grey.red = grey.green = grey.blue = grey_at(3, 3);
        png_set_tRNS(png, info, nullptr, 0, &grey);
    };
    const auto stored = [](png_structp png, png_infop) { png_set_compression_level(png, 0); };
    for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB}) {
        expect_the_grey_image({type, 8, PNG_INTERLACE_NONE, gamma});
        expect_the_grey_image({type, 8, PNG_INTERLACE_NONE, srgb});
        expect_the_grey_image({type, 8, PNG_INTERLACE_NONE, key});
        expect_the_grey_image({type, 8, PNG_INTERLACE_NONE, stored});
    }
    expect_the_grey_image({PNG_COLOR_TYPE_PALETTE, 8, PNG_INTERLACE_NONE, [](png_structp png, png_infop info) {
                               std::vector<png_byte> alpha(256, 7);
                               png_set_tRNS(png, info, alpha.data(), 256, nullptr);
                           }});
}

TEST_F(PngImages, ColourTurnsGreyByTheDocumentedIntegers) {
    const std::vector<std::uint8_t> pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 10, 200, 90, 0, 0, 0};
    write_png(at("colour.png"), 6, 1, 3, pixels.data());
    const GreyImage image = read_png(at("colour.png"));
    for (std::size_t i = 0; i < 6; ++i) {
        const int expected = (77 * pixels[3 * i] + 150 * pixels[3 * i + 1] + 29 * pixels[3 * i + 2] + 128) >> 8;
        EXPECT_EQ(image.pixels[i], expected);
    }
    EXPECT_EQ(image.pixels[3], 255);
    for (int v = 0; v < 256; ++v) {
        EXPECT_EQ((77 * v + 150 * v + 29 * v + 128) >> 8, v);
    }
}

TEST_F(PngImages, BrokenFilesAreRefusedByNameAndLibpngIsSilent) {
    const auto whole = write_grey("whole.png", 40, 30, 7);
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    testing::internal::CaptureStderr();
    int refused = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        const auto path = write("cut.png", bytes.substr(0, n));
        refused += refusal([&] { (void)read_png(path); }).find(path.string()) == 0 ? 1 : 0;
    }
    std::string flipped = bytes;
    flipped[bytes.size() / 2] = static_cast<char>(flipped[bytes.size() / 2] ^ 0x40);
    EXPECT_REFUSED(read_png(write("flipped.png", flipped)), "flipped.png");
    EXPECT_REFUSED(read_png(write("text.png", "this is no picture at all")), "text.png");
    EXPECT_REFUSED(read_png(at("missing.png")), "missing.png");
    EXPECT_REFUSED(read_png(root_), root_.string());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(refused, static_cast<int>(bytes.size()));
}

TEST_F(PngImages, ImagesBeyondTheCapacityAreRefused) {
    EXPECT_EQ(read_png(write_grey("most.png", kMaxImageWidth, kMaxImageHeight, 1)).width, kMaxImageWidth);
    EXPECT_REFUSED(read_png(write_grey("wide.png", kMaxImageWidth + 1, 8, 1)), "wide.png: image of 1249 x 8 px");
    EXPECT_REFUSED(read_png(write_grey("high.png", 8, kMaxImageHeight + 1, 1)), "high.png: image of 8 x 385 px");
}

}  // namespace
}  // namespace semtrack::sil
