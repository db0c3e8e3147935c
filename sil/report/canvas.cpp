#include "sil/report/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sil/report/canvas_font.hpp"

namespace semtrack::sil {

namespace {

constexpr int kChannels = 3;
constexpr double kMargin_px = 16.0;  // lines are cut this far outside: wide ones still show their side

bool finite(CanvasPoint p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// One border of Liang and Barsky's line cutting: keeps t0..t1 where p t <= q.
bool cut(double p, double q, double& t0, double& t1) {
    if (p == 0.0) {
        return q >= 0.0;
    }
    const double t = q / p;
    if (p < 0.0) {
        t0 = std::max(t0, t);
    } else {
        t1 = std::min(t1, t);
    }
    return t0 <= t1;
}

bool cut_line(CanvasPoint& a, CanvasPoint& b, int width, int height) {
    if (!finite(a) || !finite(b)) {
        return false;
    }
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    double t0 = 0.0;
    double t1 = 1.0;
    if (!cut(-dx, a.x + kMargin_px, t0, t1) || !cut(dx, width + kMargin_px - a.x, t0, t1) ||
        !cut(-dy, a.y + kMargin_px, t0, t1) || !cut(dy, height + kMargin_px - a.y, t0, t1)) {
        return false;
    }
    b = {a.x + t1 * dx, a.y + t1 * dy};
    a = {a.x + t0 * dx, a.y + t0 * dy};
    return true;
}

double coverage(double distance_px, double half_width_px) {
    return std::clamp(half_width_px + 0.5 - distance_px, 0.0, 1.0);
}

}  // namespace

Canvas::Canvas(int width, int height, Colour background)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width * height * kChannels)) {
    for (std::size_t i = 0; i < pixels_.size(); i += kChannels) {
        pixels_[i] = background.r;
        pixels_[i + 1] = background.g;
        pixels_[i + 2] = background.b;
    }
}

Canvas::Canvas(const GreyImage& image, int brightness_256) : Canvas(image.width, image.height, Colour{}) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto grey = static_cast<std::uint8_t>((image.pixels[i] * brightness_256) >> 8);
        std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(i * kChannels), kChannels, grey);
    }
}

Colour Canvas::at(int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y * width_ + x) * kChannels;
    return {pixels_[i], pixels_[i + 1], pixels_[i + 2]};
}

void Canvas::blend(int x, int y, Colour colour, double alpha) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_ || !(alpha > 0.0)) {
        return;
    }
    const int a = static_cast<int>(std::lround(256.0 * std::min(alpha, 1.0)));
    const std::size_t i = static_cast<std::size_t>(y * width_ + x) * kChannels;
    const auto mix = [a](std::uint8_t under, std::uint8_t over) {
        return static_cast<std::uint8_t>((under * (256 - a) + over * a + 128) >> 8);
    };
    pixels_[i] = mix(pixels_[i], colour.r);
    pixels_[i + 1] = mix(pixels_[i + 1], colour.g);
    pixels_[i + 2] = mix(pixels_[i + 2], colour.b);
}

void Canvas::line(CanvasPoint a, CanvasPoint b, Colour colour, double width_px, double alpha) {
    if (!cut_line(a, b, width_, height_)) {
        return;
    }
    const double half = 0.5 * width_px;
    const bool steep = std::fabs(b.y - a.y) > std::fabs(b.x - a.x);
    if (steep) {  // walk along the longer axis, blend the few pixels across it
        std::swap(a.x, a.y);
        std::swap(b.x, b.y);
    }
    if (a.x > b.x) {
        std::swap(a, b);
    }
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0.0;
    const double across = length > 0.0 ? (b.x - a.x) / length : 1.0;  // pixels of distance for one along the short axis
    const int reach = static_cast<int>(std::ceil((half + 0.5) / across)) + 1;
    for (int i = static_cast<int>(std::floor(a.x)); i <= static_cast<int>(std::ceil(b.x)); ++i) {
        const double end = std::clamp(1.0 - std::max(a.x - i, i - b.x), 0.0, 1.0);
        const double centre = a.y + slope * (std::clamp(static_cast<double>(i), a.x, b.x) - a.x);
        const int middle = static_cast<int>(std::lround(centre));
        for (int j = middle - reach; j <= middle + reach; ++j) {
            const double share = alpha * end * coverage(std::fabs(j - centre) * across, half);
            steep ? blend(j, i, colour, share) : blend(i, j, colour, share);
        }
    }
}

void Canvas::dashed_line(CanvasPoint a, CanvasPoint b, Colour colour, double width_px, double alpha) {
    constexpr double kDash_px = 6.0;
    constexpr double kPeriod_px = 10.0;
    if (!cut_line(a, b, width_, height_)) {
        return;
    }
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (double s = 0.0; s < length; s += kPeriod_px) {
        const double e = std::min(s + kDash_px, length);
        line({a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length},
             {a.x + (b.x - a.x) * e / length, a.y + (b.y - a.y) * e / length}, colour, width_px, alpha);
    }
}

void Canvas::rectangle(CanvasPoint top_left, CanvasPoint bottom_right, Colour colour, double width_px, double alpha) {
    const CanvasPoint top_right{bottom_right.x, top_left.y};
    const CanvasPoint bottom_left{top_left.x, bottom_right.y};
    line(top_left, top_right, colour, width_px, alpha);
    line(top_right, bottom_right, colour, width_px, alpha);
    line(bottom_right, bottom_left, colour, width_px, alpha);
    line(bottom_left, top_left, colour, width_px, alpha);
}

void Canvas::fill_rectangle(int left, int top, int width, int height, Colour colour, double alpha) {
    for (int y = std::max(top, 0); y < std::min(top + height, height_); ++y) {
        for (int x = std::max(left, 0); x < std::min(left + width, width_); ++x) {
            blend(x, y, colour, alpha);
        }
    }
}

void Canvas::fill_polygon(const std::vector<CanvasPoint>& corners, Colour colour, double alpha) {
    if (corners.size() < 3 || !std::all_of(corners.begin(), corners.end(), finite)) {
        return;
    }
    const auto [lowest, highest] = std::minmax_element(
        corners.begin(), corners.end(), [](const CanvasPoint& p, const CanvasPoint& q) { return p.y < q.y; });
    const int first = static_cast<int>(std::clamp(std::ceil(lowest->y), 0.0, static_cast<double>(height_)));
    const int last = static_cast<int>(std::clamp(std::floor(highest->y), -1.0, height_ - 1.0));
    for (int y = first; y <= last; ++y) {
        double from = width_;
        double to = -1.0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const CanvasPoint& p = corners[i];
            const CanvasPoint& q = corners[(i + 1) % corners.size()];
            if ((p.y <= y) == (q.y <= y)) {
                continue;
            }
            const double x = p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        const int x_first = static_cast<int>(std::clamp(std::ceil(from), 0.0, static_cast<double>(width_)));
        const int x_last = static_cast<int>(std::clamp(std::floor(to), -1.0, width_ - 1.0));
        for (int x = x_first; x <= x_last; ++x) {
            blend(x, y, colour, alpha);
        }
    }
}

void Canvas::disc(CanvasPoint centre, double radius_px, Colour colour, double alpha) {
    if (!finite(centre) || std::fabs(centre.x) > 1e6 || std::fabs(centre.y) > 1e6) {
        return;
    }
    const int reach = static_cast<int>(std::ceil(radius_px)) + 1;
    const int cx = static_cast<int>(std::lround(centre.x));
    const int cy = static_cast<int>(std::lround(centre.y));
    for (int y = cy - reach; y <= cy + reach; ++y) {
        for (int x = cx - reach; x <= cx + reach; ++x) {
            blend(x, y, colour, alpha * coverage(std::hypot(x - centre.x, y - centre.y), radius_px));
        }
    }
}

void Canvas::circle(CanvasPoint centre, double radius_px, Colour colour, double width_px, double alpha) {
    constexpr double kTurn = 6.283185307179586;
    const int parts = std::clamp(static_cast<int>(radius_px), 12, 180);
    for (int i = 0; i < parts; ++i) {
        const double a = kTurn * i / parts;
        const double b = kTurn * (i + 1) / parts;
        line({centre.x + radius_px * std::cos(a), centre.y + radius_px * std::sin(a)},
             {centre.x + radius_px * std::cos(b), centre.y + radius_px * std::sin(b)}, colour, width_px, alpha);
    }
}

void Canvas::text(int x, int y, std::string_view text, Colour colour, int scale) {
    for (const char c : text) {
        const Glyph& g = glyph(c);
        for (int row = 0; row < kGlyphHeight; ++row) {
            for (int column = 0; column < kGlyphWidth; ++column) {
                if (((g.rows[static_cast<std::size_t>(row)] >> (kGlyphWidth - 1 - column)) & 1) != 0) {
                    fill_rectangle(x + column * scale, y + row * scale, scale, scale, colour);
                }
            }
        }
        x += (kGlyphWidth + 1) * scale;
    }
}

void Canvas::label(int x, int y, std::string_view words, Colour colour, int scale) {
    constexpr int kPadding = 2;
    fill_rectangle(x - kPadding, y - kPadding, text_width(words, scale) + 2 * kPadding,
                   text_height(scale) + 2 * kPadding, Colour{}, 0.6);
    text(x, y, words, colour, scale);
}

void Canvas::paste(const Canvas& other, int x, int y) {
    for (int row = 0; row < other.height_; ++row) {
        for (int column = 0; column < other.width_; ++column) {
            blend(x + column, y + row, other.at(column, row));
        }
    }
}

int Canvas::text_width(std::string_view text, int scale) {
    return text.empty() ? 0 : (static_cast<int>(text.size()) * (kGlyphWidth + 1) - 1) * scale;
}

int Canvas::text_height(int scale) {
    return kGlyphHeight * scale;
}

}  // namespace semtrack::sil
