// Views from above: around the vehicle for one frame, and the whole drive in W.
#ifndef SEMTRACK_SIL_REPORT_PICTURE_BIRDSEYE_HPP
#define SEMTRACK_SIL_REPORT_PICTURE_BIRDSEYE_HPP

#include <array>
#include <map>
#include <vector>

#include "semtrack/types.hpp"
#include "sil/report/canvas.hpp"
#include "sil/report/picture_style.hpp"

namespace semtrack::sil {

/// Where things have been, on the ground plane of W.
struct PlanHistory {
    std::vector<std::array<double, 2>> ego;
    struct Track {
        ObjectClass object_class{ObjectClass::kCar};
        std::vector<std::array<double, 2>> path;
        PlanBox last{};
        bool has_heading{false};
    };
    std::map<std::uint32_t, Track> tracks;  ///< by id; confirmed ones only

    void add(const Output& output);
};

/// The vehicle at the left, driving to the right; 12 px a metre; rings every 10 m. truth: boxes in V, grey. Arrows
/// show where an object will be in a second.
[[nodiscard]] Canvas draw_birdseye(int width, int height, const Output& output, const PlanHistory& history,
                                   const std::vector<PlanBox>& truth);

/// Everything in W, x to the right and y up, scaled so that the ego path and 25 m around it fill at most 1600 x 1200
/// px. ego_truth (grey) may be empty.
[[nodiscard]] Canvas draw_map(const PlanHistory& history, const std::vector<std::array<double, 2>>& ego_truth,
                              const std::vector<PlanBox>& truth);

/// A view that shows these points with a margin, and the size of its canvas.
struct FittedView {
    PlanView view{};
    int width{0};
    int height{0};
};
[[nodiscard]] FittedView fit_view(const std::vector<std::array<double, 2>>& a,
                                  const std::vector<std::array<double, 2>>& b, double margin_m);
/// Grid with its distance written on it.
void draw_grid(Canvas& canvas, const PlanView& view);

}  // namespace semtrack::sil

#endif
