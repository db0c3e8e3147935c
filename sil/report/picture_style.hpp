// What all pictures share: colours of objects, words for states, and the plan view.
#ifndef SEMTRACK_SIL_REPORT_PICTURE_STYLE_HPP
#define SEMTRACK_SIL_REPORT_PICTURE_STYLE_HPP

#include <array>
#include <string>
#include <vector>

#include "math/pose.hpp"
#include "semtrack/types.hpp"
#include "sil/report/canvas.hpp"

namespace semtrack::sil {

inline constexpr Colour kPaper{24, 26, 30};
inline constexpr Colour kInk{225, 228, 232};
inline constexpr Colour kFaint{70, 76, 84};
inline constexpr Colour kTruthColour{150, 155, 160};
inline constexpr Colour kEgoColour{255, 255, 255};
inline constexpr Colour kBackgroundFeature{70, 200, 120};

/// The same id has the same colour in every picture; neighbours differ.
[[nodiscard]] Colour colour_of_track(std::uint32_t id);
[[nodiscard]] const char* class_text(ObjectClass object_class);
[[nodiscard]] const char* status_text(TrackStatus status);
[[nodiscard]] const char* status_text(EgoStatus status);
[[nodiscard]] const char* movement_text(MovementState movement);
/// For places of text: any value, also one that is not finite, becomes a pixel number that can be reckoned with.
[[nodiscard]] int pixel(double value);
/// printf's %.Nf; no minus before a zero.
[[nodiscard]] std::string fixed(double value, int digits);

/// A box on the ground plane: centre, heading, length, width; heading from x towards y.
struct PlanBox {
    double x{0};
    double y{0};
    double yaw{0};
    double length{0};
    double width{0};
};

/// Metres of a frame with x forward and y left -> pixels; x to the right, y up.
struct PlanView {
    double u0{0};
    double v0{0};
    double px_per_m{10};
    [[nodiscard]] CanvasPoint at(double x, double y) const { return {u0 + px_per_m * x, v0 - px_per_m * y}; }
};

/// Outline, a light fill, and a stroke from the centre through the front.
void draw_plan_box(Canvas& canvas, const PlanView& view, const PlanBox& box, Colour colour, bool dashed, bool heading);
/// Lines through the points; less visible the older they are when `fade`.
void draw_trail(Canvas& canvas, const PlanView& view, const std::vector<std::array<double, 2>>& points, Colour colour,
                double width_px, bool fade);

}  // namespace semtrack::sil

#endif
