#include "sil/report/canvas.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "sil/report/canvas_font.hpp"
#include "sil/report/png_write.hpp"

namespace semtrack::sil {
namespace {

constexpr Colour kRed{255, 0, 0};

/// Sum of red over the canvas, in full pixels.
double ink(const Canvas& canvas) {
    double sum = 0.0;
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            sum += canvas.at(x, y).r / 255.0;
        }
    }
    return sum;
}

TEST(Canvas, LinesCoverTheirLengthTimesTheirWidth) {
    for (const CanvasPoint end : {CanvasPoint{90, 10}, {90, 90}, {10, 90}, {90, 40}, {40, 90}}) {
        for (const double width : {1.0, 3.0}) {
            Canvas canvas(100, 100, Colour{});
            canvas.line({10, 10}, end, kRed, width);
            const double length = std::hypot(end.x - 10, end.y - 10);
            EXPECT_NEAR(ink(canvas), width * length, 0.15 * width * length + width);
            Canvas back(100, 100, Colour{});
            back.line(end, {10, 10}, kRed, width);
            EXPECT_NEAR(ink(back), ink(canvas), 1e-9);
        }
    }
}

TEST(Canvas, WhatLiesOutsideIsCutOff) {
    Canvas canvas(50, 40, Colour{});
    canvas.line({-1e12, 20}, {1e12, 20}, kRed);
    EXPECT_NEAR(ink(canvas), 50.0, 1e-9);
    canvas.line({-10, -100}, {-5, 1000}, kRed);
    canvas.disc({1e300, 0}, 3, kRed);
    canvas.disc({-100, -100}, 3, kRed);
    canvas.fill_rectangle(60, 60, 10, 10, kRed);
    canvas.text(-100, 20, "left", kRed);
    canvas.text(1000, 20, "right", kRed);
    canvas.fill_polygon({{-50, -50}, {-10, -50}, {-10, -10}}, kRed);
    canvas.rectangle({-20, -20}, {-18, -18}, kRed);
    EXPECT_NEAR(ink(canvas), 50.0, 1e-9);
    canvas.fill_rectangle(-10, -10, 1000, 1000, kRed);
    EXPECT_NEAR(ink(canvas), 50.0 * 40.0, 1e-9);
}

TEST(Canvas, NotANumberDrawsNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    Canvas canvas(20, 20, Colour{});
    canvas.line({nan, 0}, {10, 10}, kRed);
    canvas.line({0, 0}, {inf, 10}, kRed);
    canvas.dashed_line({0, nan}, {10, 10}, kRed);
    canvas.disc({nan, nan}, 3, kRed);
    canvas.circle({nan, 5}, 3, kRed);
    canvas.rectangle({nan, 0}, {5, nan}, kRed);
    canvas.fill_polygon({{0, 0}, {nan, 5}, {9, 9}}, kRed);
    canvas.blend(3, 3, kRed, nan);
    EXPECT_EQ(ink(canvas), 0.0);
}

TEST(Canvas, ShapesHaveTheirArea) {
    Canvas disc(60, 60, Colour{});
    disc.disc({30, 30}, 10, kRed);
    EXPECT_NEAR(ink(disc), 314.16, 4.0);
    Canvas polygon(60, 60, Colour{});
    polygon.fill_polygon({{10.2, 10.2}, {50.2, 10.2}, {50.2, 30.2}, {10.2, 30.2}}, kRed);
    EXPECT_NEAR(ink(polygon), 800.0, 1e-9);
    Canvas turned(60, 60, Colour{});
    turned.fill_polygon({{30, 10.5}, {49.5, 30}, {30, 49.5}, {10.5, 30}}, kRed);
    EXPECT_NEAR(ink(turned), 19.5 * 19.5 * 2, 10.0);
    Canvas dashed(120, 20, Colour{});
    dashed.dashed_line({10, 10}, {110, 10}, kRed);
    EXPECT_NEAR(ink(dashed), 60.0, 12.0);
}

TEST(Canvas, BlendingMixesByAlpha) {
    Canvas canvas(2, 1, Colour{100, 100, 100});
    canvas.blend(0, 0, Colour{200, 0, 100}, 0.5);
    EXPECT_EQ(canvas.at(0, 0).r, 150);
    EXPECT_EQ(canvas.at(0, 0).g, 50);
    EXPECT_EQ(canvas.at(0, 0).b, 100);
    EXPECT_EQ(canvas.at(1, 0).r, 100);
}

TEST(Canvas, GreyPicturesAreTakenOver) {
    GreyImage image{3, 1, {0, 128, 255}};
    const Canvas canvas(image, 256);
    EXPECT_EQ(canvas.at(1, 0).g, 128);
    EXPECT_EQ(canvas.at(2, 0).b, 255);
}

TEST(CanvasFont, EveryPrintableCharacterIsDrawnAndDiffersFromTheOthers) {
    std::set<std::array<std::uint8_t, static_cast<std::size_t>(kGlyphHeight)>> shapes;
    for (char c = ' '; c <= '~'; ++c) {
        shapes.insert(glyph(c).rows);
        for (const std::uint8_t row : glyph(c).rows) {
            EXPECT_LT(row, 32);
        }
    }
    EXPECT_EQ(shapes.size(), 95U);
    EXPECT_EQ(glyph('\n').rows, glyph('?').rows);
    EXPECT_EQ(glyph(static_cast<char>(0xE4)).rows, glyph('?').rows);
}

TEST(CanvasFont, TextFillsItsBox) {
    Canvas canvas(100, 30, Colour{});
    canvas.text(5, 6, "HE", kRed, 2);
    EXPECT_EQ(Canvas::text_width("HE", 2), 22);
    EXPECT_EQ(Canvas::text_height(2), 14);
    EXPECT_EQ(canvas.at(5, 6).r, 255);
    EXPECT_EQ(canvas.at(5 + 21, 6).r, 255);
    EXPECT_EQ(canvas.at(5 + 22, 6).r, 0);
    EXPECT_EQ(canvas.at(5, 6 + 13).r, 255);
    EXPECT_EQ(canvas.at(5, 6 + 14).r, 0);
}

TEST(PngWrite, PixelsComeBack) {
    const auto path = std::filesystem::path(testing::TempDir()) / "semtrack_png_write.png";
    Canvas canvas(7, 5, Colour{1, 2, 3});
    canvas.blend(6, 4, kRed);
    png_write(path, 7, 5, 3, canvas.data());
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
    ASSERT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0);
    EXPECT_EQ(image.width, 7U);
    EXPECT_EQ(image.height, 5U);
    EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), canvas.data()));
    std::filesystem::remove(path);
}

TEST(PngWrite, AFileThatCannotBeWrittenThrowsItsName) {
    const std::uint8_t pixel = 0;
    const auto path = std::filesystem::path(testing::TempDir()) / "semtrack_no_such_folder" / "a.png";
    try {
        png_write(path, 1, 1, 1, &pixel);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("a.png"), std::string::npos);
    }
}

}  // namespace
}  // namespace semtrack::sil
