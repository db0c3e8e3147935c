#include "sil/report/picture_style.hpp"

#include <cmath>
#include <cstdio>

namespace semtrack::sil {

Colour colour_of_track(std::uint32_t id) {
    // Hues a golden angle apart; full brightness, so that they stand out on a grey picture.
    const double hue = std::fmod(0.58 + 0.6180339887498949 * id, 1.0) * 6.0;
    const auto channel = [hue](double offset) {
        const double k = std::fmod(hue + offset, 6.0);
        const double ramp = std::fmax(0.0, std::fmin(1.0, std::fmin(k, 4.0 - k)));
        return static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - 0.8 * ramp)));
    };
    return {channel(5.0), channel(3.0), channel(1.0)};
}

const char* class_text(ObjectClass object_class) {
    constexpr const char* kText[kObjectClasses] = {"Car", "Van", "Truck", "Pedestrian", "Cyclist", "Tram", "Misc"};
    return kText[static_cast<int>(object_class)];
}

const char* status_text(TrackStatus status) {
    constexpr const char* kText[] = {"new", "measured", "coasted", "lost"};
    return kText[static_cast<int>(status)];
}

const char* status_text(EgoStatus status) {
    constexpr const char* kText[] = {"start", "tracked", "predicted", "given"};
    return kText[static_cast<int>(status)];
}

const char* movement_text(MovementState movement) {
    constexpr const char* kText[] = {"", "standing", "moving", "oncoming", "reversing"};
    return kText[static_cast<int>(movement)];
}

int pixel(double value) {
    constexpr double kFar = 1e6;
    return std::isfinite(value) ? static_cast<int>(std::fmax(-kFar, std::fmin(kFar, value))) : static_cast<int>(-kFar);
}

std::string fixed(double value, int digits) {
    std::array<char, 64> text{};
    const int n = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    if (n <= 0 || n >= static_cast<int>(text.size())) {
        return "?";
    }
    const std::string out(text.data());
    return out[0] == '-' && out.find_first_not_of("-0.") == std::string::npos ? out.substr(1) : out;
}

void draw_plan_box(Canvas& canvas, const PlanView& view, const PlanBox& box, Colour colour, bool dashed, bool heading) {
    const double c = std::cos(box.yaw);
    const double s = std::sin(box.yaw);
    const auto corner = [&](double along, double across) {
        const double x = 0.5 * along * box.length;
        const double y = 0.5 * across * box.width;
        return view.at(box.x + c * x - s * y, box.y + s * x + c * y);
    };
    const std::vector<CanvasPoint> corners{corner(1, 1), corner(1, -1), corner(-1, -1), corner(-1, 1)};
    canvas.fill_polygon(corners, colour, dashed ? 0.10 : 0.25);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const CanvasPoint& next = corners[(i + 1) % corners.size()];
        if (dashed) {
            canvas.dashed_line(corners[i], next, colour, 1.2);
        } else {
            canvas.line(corners[i], next, colour, 1.6);
        }
    }
    if (heading) {
        canvas.line(view.at(box.x, box.y), corner(1.4, 0.0), colour, 1.6);
        canvas.line(corner(0.5, 1.0), corner(1.0, 0.0), colour, 1.0);
        canvas.line(corner(0.5, -1.0), corner(1.0, 0.0), colour, 1.0);
    }
}

void draw_trail(Canvas& canvas, const PlanView& view, const std::vector<std::array<double, 2>>& points, Colour colour,
                double width_px, bool fade) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double age = static_cast<double>(points.size() - i) / static_cast<double>(points.size());
        canvas.line(view.at(points[i - 1][0], points[i - 1][1]), view.at(points[i][0], points[i][1]), colour, width_px,
                    fade ? 0.9 - 0.75 * age : 0.9);
    }
}

}  // namespace semtrack::sil
