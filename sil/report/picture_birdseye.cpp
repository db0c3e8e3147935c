#include "sil/report/picture_birdseye.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "math/pose.hpp"

namespace semtrack::sil {

namespace {

using Path = std::vector<std::array<double, 2>>;

/// Points of W in V, on the plane.
Path in_vehicle(const Path& path_w, const Pose& T_v_w, std::size_t newest) {
    Path out;
    const std::size_t begin = path_w.size() > newest ? path_w.size() - newest : 0;
    for (std::size_t i = begin; i < path_w.size(); ++i) {
        // The path lies in W's plane; the vehicle's own height there keeps slopes out of the picture.
        const Vec3 p = T_v_w.R * Vec3(path_w[i][0], path_w[i][1], 0.0) + T_v_w.t;
        out.push_back({p(0), p(1)});
    }
    return out;
}

void draw_rings(Canvas& canvas, const PlanView& view) {
    constexpr int kStep_m = 10;
    constexpr int kFarthest_m = 100;
    for (int r = kStep_m; r <= kFarthest_m; r += kStep_m) {
        canvas.circle(view.at(0, 0), r * view.px_per_m, kFaint, 1.0, r % 50 == 0 ? 1.0 : 0.6);
        const CanvasPoint p = view.at(r, 0);
        canvas.text(pixel(p.x) + 3, pixel(p.y) + 3, std::to_string(r), kFaint);
    }
    canvas.line(view.at(0, 0), view.at(kFarthest_m, 0), kFaint, 1.0, 0.5);
}

void draw_ego(Canvas& canvas, const PlanView& view) {
    // The vehicle frame's origin is where the mount puts it; a car's length behind and a metre to each side.
    draw_plan_box(canvas, view, {-1.2, 0.0, 0.0, 4.2, 1.8}, kEgoColour, false, true);
}

void draw_object(Canvas& canvas, const PlanView& view, const TrackedObject& o, const Path& trail) {
    const Colour colour = colour_of_track(o.id);
    draw_trail(canvas, view, trail, colour, 1.4, true);
    const double x = o.position_v[0];
    const double y = o.position_v[1];
    draw_plan_box(canvas, view, {x, y, o.yaw_v, o.size[0], o.size[1]}, colour, o.status != TrackStatus::kMeasured,
                  o.has_heading);
    canvas.line(view.at(x, y), view.at(x + o.velocity_v[0], y + o.velocity_v[1]), colour, 1.0, 0.8);
    const CanvasPoint p = view.at(x, y - 0.5 * o.size[1]);
    const std::string name = "#" + std::to_string(o.id) + " " + fixed(o.speed, 1) + " " + movement_text(o.movement);
    canvas.text(pixel(p.x) - 10, pixel(p.y) + 8, name, colour);
}

void extend(const Path& path, std::array<double, 4>& box) {
    for (const auto& p : path) {
        if (!std::isfinite(p[0]) || !std::isfinite(p[1])) {
            continue;
        }
        box = {std::min(box[0], p[0]), std::min(box[1], p[1]), std::max(box[2], p[0]), std::max(box[3], p[1])};
    }
}

}  // namespace

void PlanHistory::add(const Output& output) {
    const RigidTransform& T = output.ego.T_w_v;
    ego.push_back({T.t[0], T.t[1]});
    for (const TrackedObject& o : output.objects) {
        if (o.status != TrackStatus::kMeasured && o.status != TrackStatus::kCoasted) {
            continue;
        }
        Track& track = tracks[o.id];
        track.object_class = o.object_class;
        track.path.push_back({o.position_w[0], o.position_w[1]});
        track.last = {o.position_w[0], o.position_w[1], o.yaw_w, o.size[0], o.size[1]};
        track.has_heading = o.has_heading;
    }
}

Canvas draw_birdseye(int width, int height, const Output& output, const PlanHistory& history,
                     const std::vector<PlanBox>& truth) {
    constexpr double kPxPerM = 12.0;
    constexpr double kBehind_m = 14.0;
    constexpr std::size_t kTrail = 50;  // frames
    Canvas canvas(width, height, kPaper);
    const PlanView view{kBehind_m * kPxPerM, 0.5 * height, kPxPerM};
    draw_rings(canvas, view);
    const Pose T_v_w = to_pose(output.ego.T_w_v).inverse();
    for (const PlanBox& box : truth) {
        draw_plan_box(canvas, view, box, kTruthColour, false, true);
    }
    draw_trail(canvas, view, in_vehicle(history.ego, T_v_w, kTrail), kEgoColour, 1.6, true);
    draw_ego(canvas, view);
    for (const TrackedObject& o : output.objects) {
        if (o.status == TrackStatus::kLost) {
            continue;
        }
        const auto track = history.tracks.find(o.id);
        draw_object(canvas, view, o,
                    track == history.tracks.end() ? Path{} : in_vehicle(track->second.path, T_v_w, kTrail));
    }
    canvas.text(4, height - 11, truth.empty() ? "vehicle frame, rings 10 m" : "vehicle frame, rings 10 m, labels grey",
                kTruthColour);
    return canvas;
}

FittedView fit_view(const Path& a, const Path& b, double margin_m) {
    constexpr double kMostWide_px = 1600.0;
    constexpr double kMostHigh_px = 1200.0;
    constexpr double kMostPxPerM = 12.0;
    std::array<double, 4> box{1e9, 1e9, -1e9, -1e9};
    extend(a, box);
    extend(b, box);
    if (box[0] > box[2]) {
        box = {0, 0, 0, 0};
    }
    box = {box[0] - margin_m, box[1] - margin_m, box[2] + margin_m, box[3] + margin_m};
    FittedView out;
    const double scale = std::min({kMostWide_px / (box[2] - box[0]), kMostHigh_px / (box[3] - box[1]), kMostPxPerM});
    out.view = {-box[0] * scale, box[3] * scale, scale};
    out.width = static_cast<int>(std::ceil((box[2] - box[0]) * scale));
    out.height = static_cast<int>(std::ceil((box[3] - box[1]) * scale));
    return out;
}

void draw_grid(Canvas& canvas, const PlanView& view) {
    const double step_m = view.px_per_m > 4.0 ? 10.0 : view.px_per_m > 0.8 ? 50.0 : 250.0;
    const double right = (canvas.width() - view.u0) / view.px_per_m;
    const double bottom = (view.v0 - canvas.height()) / view.px_per_m;
    for (double x = std::ceil(-view.u0 / view.px_per_m / step_m) * step_m; x <= right; x += step_m) {
        const CanvasPoint p = view.at(x, 0);
        canvas.line({p.x, 0.0}, {p.x, canvas.height() - 1.0}, kFaint, 1.0, 0.5);
        canvas.text(pixel(p.x) + 2, canvas.height() - 10, fixed(x, 0), kFaint);
    }
    for (double y = std::ceil(bottom / step_m) * step_m; y <= view.v0 / view.px_per_m; y += step_m) {
        const CanvasPoint p = view.at(0, y);
        canvas.line({0.0, p.y}, {canvas.width() - 1.0, p.y}, kFaint, 1.0, 0.5);
        canvas.text(2, pixel(p.y) + 2, fixed(y, 0), kFaint);
    }
}

Canvas draw_map(const PlanHistory& history, const Path& ego_truth, const std::vector<PlanBox>& truth) {
    constexpr double kAround_m = 25.0;
    const FittedView fitted = fit_view(history.ego, ego_truth, kAround_m);
    Canvas canvas(fitted.width, fitted.height, kPaper);
    draw_grid(canvas, fitted.view);
    for (const PlanBox& box : truth) {
        draw_plan_box(canvas, fitted.view, box, kFaint, false, false);
    }
    draw_trail(canvas, fitted.view, ego_truth, kTruthColour, 3.0, false);
    for (const auto& [id, track] : history.tracks) {
        draw_trail(canvas, fitted.view, track.path, colour_of_track(id), 1.2, false);
    }
    for (const auto& [id, track] : history.tracks) {
        draw_plan_box(canvas, fitted.view, track.last, colour_of_track(id), false, track.has_heading);
        const CanvasPoint p = fitted.view.at(track.last.x, track.last.y);
        canvas.text(pixel(p.x) + 6, pixel(p.y) - 10, std::to_string(id), colour_of_track(id));
    }
    draw_trail(canvas, fitted.view, history.ego, kEgoColour, 1.6, false);
    canvas.label(4, 4, "world frame, m; ego white" + std::string(ego_truth.empty() ? "" : ", its truth grey"), kInk);
    return canvas;
}

}  // namespace semtrack::sil
