// Hand-made drives in a folder that is gone after the test.
#ifndef SEMTRACK_TESTS_SIL_KITTI_TEMP_FILES_HPP
#define SEMTRACK_TESTS_SIL_KITTI_TEMP_FILES_HPP

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sil/sequence.hpp"

namespace semtrack::sil {

/// channels: 1 grey, 3 RGB.
inline void write_png(const std::filesystem::path& path, int width, int height, int channels,
                      const std::uint8_t* pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, pixels, width * channels, nullptr), 0) << image.message;
}

class TempFiles : public testing::Test {
protected:
    TempFiles() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        root_ = std::filesystem::path(testing::TempDir()) /
                (std::string("semtrack_") + info->test_suite_name() + "_" + info->name());
        std::filesystem::remove_all(root_);
        std::filesystem::create_directories(root_);
    }
    ~TempFiles() override { std::filesystem::remove_all(root_); }

    [[nodiscard]] std::filesystem::path at(const std::string& name) const { return root_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const std::filesystem::path path = at(name);
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    std::filesystem::path write_grey(const std::string& name, int width, int height, std::uint8_t value) const {
        const std::filesystem::path path = at(name);
        std::filesystem::create_directories(path.parent_path());
        const std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width * height), value);
        write_png(path, width, height, 1, pixels.data());
        return path;
    }

    std::filesystem::path root_;
};

/// What `call` refuses with; empty: it does not.
template <class Call>
std::string refusal(Call&& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

#define EXPECT_REFUSED(call, part)                                                           \
    do {                                                                                     \
        const std::string what_ = ::semtrack::sil::refusal([&] { (void)(call); });           \
        EXPECT_NE(what_.find(part), std::string::npos) << "refused with: '" << what_ << "'"; \
        EXPECT_EQ(what_.find('\n'), std::string::npos) << "more than a line";                \
    } while (false)

}  // namespace semtrack::sil

#endif
