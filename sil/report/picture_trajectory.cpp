#include "sil/report/picture_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sil/report/picture_birdseye.hpp"
#include "sil/report/picture_style.hpp"

namespace semtrack::sil {

namespace {

using Path = std::vector<std::array<double, 2>>;

struct Distances {
    std::vector<std::array<double, 2>> by_frame;  // frame, m
    double largest{0};
    double last{0};
    double length{0};  // of the truth
};

Distances distances(const std::map<int, RigidTransform>& poses_w, const std::map<int, std::array<double, 3>>& truth_w) {
    Distances out;
    const std::array<double, 3>* before = nullptr;
    for (const auto& [frame, p] : truth_w) {
        if (before != nullptr) {
            out.length += std::hypot(p[0] - (*before)[0], p[1] - (*before)[1], p[2] - (*before)[2]);
        }
        before = &p;
        const auto pose = poses_w.find(frame);
        if (pose == poses_w.end()) {
            continue;
        }
        const std::array<double, 3>& q = pose->second.t;
        out.last = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        out.largest = std::max(out.largest, out.last);
        out.by_frame.push_back({static_cast<double>(frame), out.last});
    }
    return out;
}

void draw_curve(Canvas& canvas, int top, int height, const Distances& d) {
    if (d.by_frame.size() < 2) {
        return;
    }
    const double full = std::max(d.largest, 1e-3) * 1.1;
    const double first = d.by_frame.front()[0];
    const double frames = d.by_frame.back()[0] - first;
    const double right = canvas.width() - 10.0;
    const auto at = [&](const std::array<double, 2>& p) {
        return CanvasPoint{10.0 + (right - 10.0) * (p[0] - first) / frames,
                           top + height - 14.0 - (height - 30.0) * p[1] / full};
    };
    canvas.line(at({first, 0.0}), at({first + frames, 0.0}), kFaint);
    canvas.line(at({first, d.largest}), at({first + frames, d.largest}), kFaint, 1.0, 0.5);
    for (std::size_t i = 1; i < d.by_frame.size(); ++i) {
        canvas.line(at(d.by_frame[i - 1]), at(d.by_frame[i]), Colour{255, 170, 60}, 1.6);
    }
    canvas.text(12, top + 4, "distance over frames, line at " + fixed(d.largest, 3) + " m", kInk);
    canvas.text(10, top + height - 10, fixed(first, 0), kTruthColour);
    const std::string last = fixed(first + frames, 0);
    canvas.text(canvas.width() - 10 - Canvas::text_width(last), top + height - 10, last, kTruthColour);
}

}  // namespace

std::map<int, std::array<double, 3>> truth_in_world(const std::map<int, RigidTransform>& truth,
                                                    const std::map<int, RigidTransform>& poses_w,
                                                    const RigidTransform& T_v_c, const std::array<double, 3>& t_c0_c) {
    std::map<int, std::array<double, 3>> out;
    Pose T_c0_c;
    T_c0_c.t = Vec3(t_c0_c[0], t_c0_c[1], t_c0_c[2]);
    const Pose T_c0_v = T_c0_c * to_pose(T_v_c).inverse();
    Pose T_w_f;  // W from the truth file's frame
    bool aligned = false;
    for (const auto& [frame, T_f_c0] : truth) {
        const Pose T_f_v = to_pose(T_f_c0) * T_c0_v;
        if (!aligned) {
            const auto pose = poses_w.find(frame);
            if (pose == poses_w.end()) {
                continue;
            }
            T_w_f = to_pose(pose->second) * T_f_v.inverse();
            aligned = true;
        }
        const Vec3 p = T_w_f * T_f_v.t;
        out[frame] = {p(0), p(1), p(2)};
    }
    return out;
}

Canvas draw_trajectory(const std::map<int, RigidTransform>& poses_w,
                       const std::map<int, std::array<double, 3>>& truth_w) {
    constexpr double kMargin_m = 5.0;
    constexpr int kCurve_px = 180;
    constexpr int kNarrowest_px = 480;
    Path estimate;
    Path truth;
    for (const auto& [frame, T] : poses_w) {
        estimate.push_back({T.t[0], T.t[1]});
    }
    for (const auto& [frame, p] : truth_w) {
        if (poses_w.count(frame) > 0) {
            truth.push_back({p[0], p[1]});
        }
    }
    const FittedView fitted = fit_view(estimate, truth, kMargin_m);
    Canvas plan(std::max(fitted.width, kNarrowest_px), fitted.height, kPaper);
    draw_grid(plan, fitted.view);
    draw_trail(plan, fitted.view, truth, kTruthColour, 4.0, false);
    draw_trail(plan, fitted.view, estimate, Colour{255, 170, 60}, 1.6, false);
    Canvas canvas(plan.width(), plan.height() + kCurve_px, kPaper);
    canvas.paste(plan, 0, 0);
    const Distances d = distances(poses_w, truth_w);
    const std::string words = truth.empty()
                                  ? "ego path; no truth"
                                  : "ego path, truth grey; length " + fixed(d.length, 1) + " m, largest distance " +
                                        fixed(d.largest, 2) + " m, at the end " + fixed(d.last, 2) + " m";
    canvas.label(4, 4, words, kInk);
    draw_curve(canvas, plan.height(), kCurve_px, d);
    return canvas;
}

}  // namespace semtrack::sil
