#include <cmath>

#include "math/camera.hpp"
#include "sil/world/raycast.hpp"
#include "sil/world/world_sequence.hpp"
#include "tests/bench/pair_truth.hpp"

namespace semtrack::bench {

namespace {

using sil::world::FrameScene;
using sil::world::Shade;
using sil::world::Target;
using sil::world::View;

constexpr double kSameDepth = 0.05;  // relative: else something stands in front
constexpr double kBorder_px = 20.0;  // no extractor describes points nearer to the border

struct Surface {
    float q{0};  ///< inverse depth; 0: the sky
    int owner{-1};
};

/// What each pixel of a left image sees.
class SurfaceMap {
public:
    SurfaceMap(const sil::world::Scene& scene, int frame, const Calibration& c)
        : width_(c.width), surfaces_(static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height)) {
        const FrameScene now = scene.at(frame);
        View view;
        view.T_n_c = now.T_n_c;
        view.width = c.width;
        view.height = c.height;
        view.fx = c.left.fx;
        view.cx = c.left.cx;
        view.row_cy = c.left.cy;
        view.row_scale = 1.0 / c.left.fy;
        std::vector<Shade> shades{Shade{}};
        std::vector<Target> targets;
        for (const auto& p : scene.still()) {
            targets.push_back(prepare(view, p, -1, shades));
        }
        for (std::size_t k = 0; k < now.users.size(); ++k) {
            for (const auto& p : now.users[k]) {
                targets.push_back(prepare(view, p, static_cast<int>(k), shades));
            }
        }
        const auto grid = sil::world::sample_grid(view.samples);
        sil::world::RowSamples samples;
        samples.resize(view.width, view.samples);
        for (int row = 0; row < view.height; ++row) {
            samples.clear(view.samples);
            for (const Target& t : targets) {
                if (row >= t.row0 && row <= t.row1) {
                    (void)trace_row(view, grid, t, row, samples);
                }
            }
            for (int x = 0; x < view.width; ++x) {
                const auto at = static_cast<std::size_t>(x);
                Surface& s = surfaces_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + at];
                s.q = samples.q[1][at];
                s.owner = s.q > 0.0F ? shades[samples.id[1][at]].owner : -1;
            }
        }
    }
    [[nodiscard]] const Surface& at(int x, int y) const {
        return surfaces_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }

private:
    int width_;
    std::vector<Surface> surfaces_;
};

class RenderedTruth final : public PairTruth {
public:
    RenderedTruth(const sil::world::Scene& scene, int frame, const Calibration& c)
        : c_(c),
          now_(scene, frame, c),
          next_(scene, frame + 1, c),
          T_next_now_(scene.T_n_c(frame + 1).inverse() * scene.T_n_c(frame)) {}

    [[nodiscard]] std::optional<Point> in_right(double u, double v) const override {
        const Surface s = nearest(now_, u, v);
        if (s.q <= 0.0F) {
            return std::nullopt;
        }
        const double u_right = right_column(c_, u, 1.0 / static_cast<double>(s.q));
        const Point p{u_right, right_row(c_, v, disparity(c_, u, u_right))};
        return inside(p) ? std::optional<Point>(p) : std::nullopt;
    }
    [[nodiscard]] std::optional<Point> in_next(double u, double v) const override {
        const Surface s = nearest(now_, u, v);
        if (s.q <= 0.0F || s.owner >= 0) {
            return std::nullopt;
        }
        const Vec3 x = T_next_now_ * Vec3(bearing(c_.left, u, v) / static_cast<double>(s.q));
        if (x(2) < 1.0) {
            return std::nullopt;
        }
        const Vec2 pixel = project(c_.left, x);
        const Point p{pixel(0), pixel(1)};
        if (!inside(p)) {
            return std::nullopt;
        }
        const double q = static_cast<double>(nearest(next_, p.u, p.v).q);
        return std::fabs(q * x(2) - 1.0) < kSameDepth ? std::optional<Point>(p) : std::nullopt;
    }
    [[nodiscard]] bool same_in_right(double u, double v, const Point& right, double tolerance_px) const override {
        const int x = static_cast<int>(std::lround(u));
        const int y = static_cast<int>(std::lround(v));
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto q = static_cast<double>(now_.at(x + dx, y + dy).q);
                const double d = q * c_.left.fx * c_.baseline_m;
                if (q > 0.0 && std::fabs(disparity(c_, u, right.u) - d) <= tolerance_px) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    [[nodiscard]] bool inside(const Point& p) const {
        return p.u >= kBorder_px && p.v >= kBorder_px && p.u < c_.width - kBorder_px && p.v < c_.height - kBorder_px;
    }
    /// Of the 3 x 3 pixels around: a corner on an outline belongs to what is in front.
    [[nodiscard]] static Surface nearest(const SurfaceMap& map, double u, double v) {
        const int x = static_cast<int>(std::lround(u));
        const int y = static_cast<int>(std::lround(v));
        Surface best = map.at(x, y);
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                best = map.at(x + dx, y + dy).q > best.q ? map.at(x + dx, y + dy) : best;
            }
        }
        return best;
    }

    Calibration c_;
    SurfaceMap now_;
    SurfaceMap next_;
    Pose T_next_now_;
};

}  // namespace

std::vector<FramePair> rendered_pairs(const std::string& scenario, const std::vector<int>& frames) {
    const sil::WorldSequence world(scenario);
    std::vector<FramePair> out;
    for (const int frame : frames) {
        FramePair pair;
        sil::GreyImage unused;
        world.render(frame, pair.left, pair.right);
        world.render(frame + 1, pair.next_left, unused);
        pair.calibration = world.cameras().calibration;
        pair.truth = std::make_unique<RenderedTruth>(world.scene(), frame, pair.calibration);
        out.push_back(std::move(pair));
    }
    return out;
}

}  // namespace semtrack::bench
