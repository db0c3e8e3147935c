#include "sil/report/picture_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "math/camera.hpp"
#include "math/pose.hpp"
#include "sil/report/picture_style.hpp"

namespace semtrack::sil {

namespace {

/// Object in V -> camera.
Pose object_in_camera(const Calibration& calibration, const TrackedObject& o) {
    Pose T_v_o;
    const double c = std::cos(o.yaw_v);
    const double s = std::sin(o.yaw_v);
    T_v_o.R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    T_v_o.t = Vec3(o.position_v[0], o.position_v[1], o.position_v[2]);
    return to_pose(calibration.T_v_c).inverse() * T_v_o;
}

class BoxPainter {
public:
    BoxPainter(Canvas& canvas, const PinholeCamera& camera, const Pose& T_c_o, const std::array<double, 3>& size,
               Colour colour, bool dashed)
        : canvas_(canvas), camera_(camera), colour_(colour), dashed_(dashed) {
        for (int i = 0; i < 8; ++i) {
            const Vec3 corner((i & 1) != 0 ? 0.5 * size[0] : -0.5 * size[0],
                              (i & 2) != 0 ? 0.5 * size[1] : -0.5 * size[1],
                              (i & 4) != 0 ? 0.5 * size[2] : -0.5 * size[2]);
            corners_[static_cast<std::size_t>(i)] = T_c_o * corner;
        }
    }

    void draw() {
        for (int i = 0; i < 8; ++i) {
            for (int bit = 1; bit < 8; bit <<= 1) {
                const int j = i | bit;
                if (j != i) {
                    const bool front = (i & 1) != 0 && (j & 1) != 0;
                    edge(i, j, front ? 2.2 : 1.3, 0.95);
                }
            }
        }
        edge(1, 7, 1.0, 0.7);  // diagonals of the front face, x > 0
        edge(3, 5, 1.0, 0.7);
    }

private:
    void edge(int i, int j, double width_px, double alpha) {
        Vec3 a = corners_[static_cast<std::size_t>(i)];
        Vec3 b = corners_[static_cast<std::size_t>(j)];
        if (a(2) < kMinDepth_m && b(2) < kMinDepth_m) {
            return;
        }
        if (a(2) < kMinDepth_m) {
            std::swap(a, b);
        }
        if (b(2) < kMinDepth_m) {
            b = a + (b - a) * ((kMinDepth_m - a(2)) / (b(2) - a(2)));
            b(2) = kMinDepth_m;
        }
        const Vec2 p = project(camera_, a);
        const Vec2 q = project(camera_, b);
        if (dashed_) {
            canvas_.dashed_line({p(0), p(1)}, {q(0), q(1)}, colour_, width_px, alpha);
        } else {
            canvas_.line({p(0), p(1)}, {q(0), q(1)}, colour_, width_px, alpha);
        }
    }

    Canvas& canvas_;
    const PinholeCamera& camera_;
    Colour colour_;
    bool dashed_;
    std::array<Vec3, 8> corners_;
};

void draw_features(Canvas& canvas, const Output& output) {
    std::map<int, Colour> owners;
    for (const TrackedObject& o : output.objects) {
        owners[o.slot + 1] = colour_of_track(o.id);
    }
    for (const SparsePoint& p : output.points) {
        const auto owner = owners.find(p.owner);
        const bool background = p.owner == 0 || owner == owners.end();
        const CanvasPoint at{static_cast<double>(p.u), static_cast<double>(p.v)};
        // Without a position the point is only a direction: a small ring's worth of colour.
        canvas.disc(at, p.has_position ? 1.3 : 0.7, background ? kBackgroundFeature : owner->second, 0.9);
    }
}

void draw_name(Canvas& canvas, const TrackedObject& o, Colour colour) {
    const std::string name = "#" + std::to_string(o.id) + " " + class_text(o.object_class);
    const std::string state = fixed(o.speed, 1) + " m/s" + (o.status == TrackStatus::kMeasured ? "" : " ") +
                              (o.status == TrackStatus::kMeasured ? "" : status_text(o.status));
    const int width = std::max(Canvas::text_width(name), Canvas::text_width(state));
    const int x = std::clamp(pixel(o.box.left) + 2, 2, std::max(canvas.width() - width - 3, 2));
    const int lines = 2 * (Canvas::text_height() + 3);
    const int y = std::clamp(pixel(o.box.top) - lines - 1, 14, std::max(canvas.height() - lines - 2, 14));
    canvas.label(x, y, name, colour);
    canvas.label(x, y + Canvas::text_height() + 3, state, colour);
}

void draw_object(Canvas& canvas, const Calibration& calibration, const TrackedObject& o) {
    const Colour colour = colour_of_track(o.id);
    const bool dashed = o.status != TrackStatus::kMeasured;
    BoxPainter(canvas, calibration.left, object_in_camera(calibration, o), o.size, colour, dashed).draw();
    if (o.box_valid) {
        canvas.rectangle({o.box.left, o.box.top}, {o.box.right, o.box.bottom}, colour, 1.0, 0.55);
        draw_name(canvas, o, colour);
    }
}

}  // namespace

Canvas draw_overlay(int frame, const GreyImage& left, const Calibration& calibration, const Output& output) {
    Canvas canvas = left.empty() ? Canvas(calibration.width, calibration.height, Colour{40, 42, 46}) : Canvas(left);
    draw_features(canvas, output);
    std::vector<const TrackedObject*> far_first;
    for (const TrackedObject& o : output.objects) {
        if (o.status != TrackStatus::kLost) {
            far_first.push_back(&o);
        }
    }
    std::stable_sort(far_first.begin(), far_first.end(), [](const TrackedObject* a, const TrackedObject* b) {
        return a->position_v[0] > b->position_v[0];
    });
    for (const TrackedObject* o : far_first) {
        draw_object(canvas, calibration, *o);
    }
    const EgoState& ego = output.ego;
    std::string head = "frame " + std::to_string(frame) + "  ego " + status_text(ego.status) + " " +
                       fixed(ego.speed, 1) + " m/s " + fixed(ego.yaw_rate, 3) + " rad/s  features " +
                       std::to_string(ego.inliers) + "/" + std::to_string(ego.features) + "  objects " +
                       std::to_string(far_first.size());
    head += output.health.ego_degraded ? "  degraded" : "";
    head += output.health.no_right_image ? "  no right image" : "";
    head += output.health.no_detections ? "  no detections" : "";
    head += output.health.road_not_plane ? "  road not plane" : "";
    canvas.label(4, 3, head, kInk);
    return canvas;
}

}  // namespace semtrack::sil
