// A picture to draw on: RGB, smooth lines, text. What lies outside is cut off, whatever the coordinates are.
// Coordinates are pixels, the centre of the first one at 0 (as in images). Not part of any result that is compared.
#ifndef SEMTRACK_SIL_REPORT_CANVAS_HPP
#define SEMTRACK_SIL_REPORT_CANVAS_HPP

#include <cstdint>
#include <string_view>
#include <vector>

#include "sil/sequence.hpp"

namespace semtrack::sil {

struct Colour {
    std::uint8_t r{0};
    std::uint8_t g{0};
    std::uint8_t b{0};
};

struct CanvasPoint {
    double x{0};
    double y{0};
};

class Canvas {
public:
    Canvas(int width, int height, Colour background);
    /// A grey picture, darkened so that lines stand out; 256: as it is.
    explicit Canvas(const GreyImage& image, int brightness_256 = 200);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const std::uint8_t* data() const { return pixels_.data(); }
    /// x, y must be inside.
    [[nodiscard]] Colour at(int x, int y) const;

    /// alpha 0..1: how much of the colour; outside: nothing. The same holds for all below.
    void blend(int x, int y, Colour colour, double alpha = 1.0);
    /// Points that are not finite draw nothing.
    void line(CanvasPoint a, CanvasPoint b, Colour colour, double width_px = 1.0, double alpha = 1.0);
    /// Dashes of 6 px, gaps of 4.
    void dashed_line(CanvasPoint a, CanvasPoint b, Colour colour, double width_px = 1.0, double alpha = 1.0);
    void rectangle(CanvasPoint top_left, CanvasPoint bottom_right, Colour colour, double width_px = 1.0,
                   double alpha = 1.0);
    void fill_rectangle(int left, int top, int width, int height, Colour colour, double alpha = 1.0);
    /// Convex, any direction of turning.
    void fill_polygon(const std::vector<CanvasPoint>& corners, Colour colour, double alpha = 1.0);
    void disc(CanvasPoint centre, double radius_px, Colour colour, double alpha = 1.0);
    void circle(CanvasPoint centre, double radius_px, Colour colour, double width_px = 1.0, double alpha = 1.0);
    /// x, y: top left pixel of the text. Glyphs are 5 x 7, 6 apart, times scale.
    void text(int x, int y, std::string_view text, Colour colour, int scale = 1);
    /// Text on a darkened ground.
    void label(int x, int y, std::string_view text, Colour colour, int scale = 1);
    void paste(const Canvas& other, int x, int y);

    [[nodiscard]] static int text_width(std::string_view text, int scale = 1);
    [[nodiscard]] static int text_height(int scale = 1);

private:
    int width_;
    int height_;
    std::vector<std::uint8_t> pixels_;
};

}  // namespace semtrack::sil

#endif
