#include "sil/world/renderer.hpp"

#include <thread>

#include "sil/world/rectify.hpp"
#include "sil/world/shading.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

constexpr int kWidth = 1242;
constexpr int kHeight = 375;
constexpr double kBaseline_m = 0.54;

View left_view(const Calibration& c, const Pose& T_n_c, int samples) {
    View v;
    v.T_n_c = T_n_c;
    v.width = c.width;
    v.height = c.height;
    v.fx = c.left.fx;
    v.cx = c.left.cx;
    v.row_cy = c.left.cy;
    v.row_scale = 1.0 / c.left.fy;
    v.samples = samples;
    return v;
}

// RowOffset exactly: constant and slope by the rows, the part per disparity by a camera that stands higher or lower.
View right_view(const Calibration& c, const Pose& T_n_c, int samples) {
    View v = left_view(c, T_n_c, samples);
    const double stretch = 1.0 + c.row_offset.slope;
    v.T_n_c.t = T_n_c * Vec3(c.baseline_m, -c.row_offset.per_disparity * c.baseline_m / stretch, 0.0);
    v.cx = c.right.cx;
    v.row_cy = c.right.cy + c.row_offset.constant;
    v.row_scale = 1.0 / (c.right.fy * stretch);
    return v;
}

// All that one view can see: what stands still first, then road user by road user.
struct ViewTargets {
    std::vector<Shade> shades{Shade{}};  // 0: the sky
    std::vector<Target> still{};
    std::vector<std::vector<Target>> users{};
};

ViewTargets prepare_all(const Scene& scene, const FrameScene& frame, const View& view) {
    ViewTargets out;
    for (const Piece& p : scene.still()) {
        Target t = prepare(view, p, -1, out.shades);
        if (t.row1 >= t.row0) {
            out.still.push_back(std::move(t));
        }
    }
    for (std::size_t k = 0; k < frame.users.size(); ++k) {
        out.users.emplace_back();
        for (const Piece& p : frame.users[k]) {
            Target t = prepare(view, p, static_cast<int>(k), out.shades);
            if (t.row1 >= t.row0) {
                out.users.back().push_back(std::move(t));
            }
        }
    }
    return out;
}

void grow(Box2d& b, double u, double v, double half, bool first) {
    if (first) {
        b = Box2d{u - half, v - half, u + half, v + half};
    }
    b.left = u - half < b.left ? u - half : b.left;
    b.right = u + half > b.right ? u + half : b.right;
    b.top = v - half < b.top ? v - half : b.top;
    b.bottom = v + half > b.bottom ? v + half : b.bottom;
}

struct RowRange {
    int first{1 << 30};
    int last{-1};
};

// Drops standing things that no road user's bounds meet; returns the rows that show road users at all.
RowRange keep_what_hides_users(ViewTargets& targets) {
    RowRange rows;
    std::vector<Target> kept;
    for (const std::vector<Target>& user : targets.users) {
        for (const Target& t : user) {
            rows.first = t.row0 < rows.first ? t.row0 : rows.first;
            rows.last = t.row1 > rows.last ? t.row1 : rows.last;
        }
    }
    for (Target& still : targets.still) {
        bool meets = false;
        for (const std::vector<Target>& user : targets.users) {
            for (const Target& t : user) {
                meets = meets || (still.row0 <= t.row1 && still.row1 >= t.row0 && still.u0 <= t.u1 && still.u1 >= t.u0);
            }
        }
        if (meets) {
            kept.push_back(std::move(still));
        }
    }
    targets.still = std::move(kept);
    return rows;
}

struct RowWork {
    RowSamples nearest{};
    RowSamples own{};
    std::vector<Span> spans{};
    std::vector<Silhouette> silhouettes{};
};

class RowTracer {
public:
    RowTracer(const View& view, const ViewTargets& targets, bool count)
        : view_(view), targets_(targets), grid_(sample_grid(view.samples)), count_(count) {
        work_.nearest.resize(view.width, view.samples);
        work_.own.resize(view.width, view.samples);
        work_.spans.resize(targets.users.size());
        work_.silhouettes.resize(targets.users.size());
    }

    const RowSamples& trace(int row) {
        work_.nearest.clear(view_.samples);
        for (const Target& t : targets_.still) {
            if (row >= t.row0 && row <= t.row1) {
                (void)trace_row(view_, grid_, t, row, work_.nearest);
            }
        }
        for (std::size_t k = 0; k < targets_.users.size(); ++k) {
            trace_user(k, row);
        }
        if (count_) {
            for (std::size_t k = 0; k < targets_.users.size(); ++k) {
                count_visible(k, row);
            }
        }
        return work_.nearest;
    }

    [[nodiscard]] const std::vector<Silhouette>& silhouettes() const { return work_.silhouettes; }
    [[nodiscard]] const SampleGrid& grid() const { return grid_; }

private:
    // On its own first: what it would show without the others in front of it.
    void trace_user(std::size_t k, int row) {
        Span span;
        for (const Target& t : targets_.users[k]) {
            if (row < t.row0 || row > t.row1) {
                continue;
            }
            const Span s = trace_row(view_, grid_, t, row, work_.own);
            if (s.first <= s.last) {
                span.add(s.first, s.last);
            }
        }
        work_.spans[k] = span;
        for (std::size_t i = 0; i < static_cast<std::size_t>(view_.samples); ++i) {
            for (int x = span.first; x <= span.last; ++x) {
                merge(k, row, i, x);
            }
        }
    }

    void merge(std::size_t k, int row, std::size_t i, int x) {
        const std::size_t at = static_cast<std::size_t>(x);
        float& own = work_.own.q[i][at];
        if (own <= 0.0F) {
            return;
        }
        if (own > work_.nearest.q[i][at]) {
            work_.nearest.q[i][at] = own;
            work_.nearest.id[i][at] = work_.own.id[i][at];
        }
        own = 0.0F;
        if (!count_) {
            return;
        }
        Silhouette& s = work_.silhouettes[k];
        grow(s.whole, x + grid_.du[i], row + grid_.dv[i], 0.5 / view_.samples, s.samples == 0);
        ++s.samples;
    }

    void count_visible(std::size_t k, int row) {
        Silhouette& s = work_.silhouettes[k];
        const Span& span = work_.spans[k];
        for (std::size_t i = 0; i < static_cast<std::size_t>(view_.samples); ++i) {
            for (int x = span.first; x <= span.last; ++x) {
                const std::uint32_t id = work_.nearest.id[i][static_cast<std::size_t>(x)];
                if (targets_.shades[id].owner != static_cast<int>(k)) {
                    continue;
                }
                grow(s.visible, x + grid_.du[i], row + grid_.dv[i], 0.5 / view_.samples, s.visible_samples == 0);
                ++s.visible_samples;
            }
        }
    }

    const View& view_;
    const ViewTargets& targets_;
    SampleGrid grid_;
    bool count_;
    RowWork work_{};
};

// Runs f(thread) for every thread; thread i takes rows i, i + n, ... so that both have road and sky.
template <class F>
void on_threads(int threads, F f) {
    if (threads <= 1) {
        f(0);
        return;
    }
    std::thread other([&f] { f(1); });
    f(0);
    other.join();
}

struct Sensor {
    double gain{1};
    double offset{0};
    double noise_sigma{0};
    std::uint32_t seed{0};
};

// Sum of four bytes: near enough to a Gaussian, standard deviation 147.8.
float sensor_noise(std::uint32_t seed, int row, int column) {
    const std::uint32_t h = hash(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), seed);
    const std::uint32_t sum = (h & 255U) + ((h >> 8U) & 255U) + ((h >> 16U) & 255U) + (h >> 24U);
    return (static_cast<float>(sum) - 510.0F) / 147.8F;
}

// Every sample where surfaces meet. Inside one face its textures are filtered to the sample's footprint, and the two
// samples that lie furthest apart along the face's longer footprint stand for all four.
float pixel_sum(const View& view, const SampleGrid& grid, const RowSamples& samples, const Shader& shader, int row,
                int x) {
    const std::size_t at = static_cast<std::size_t>(x);
    const auto one = [&](std::size_t i) {
        return shader.radiance(samples.id[i][at], samples.q[i][at], view.ray_x(x + grid.du[i]),
                               view.ray_y(row + grid.dv[i]));
    };
    const std::uint32_t id = samples.id[0][at];
    const std::size_t n = static_cast<std::size_t>(view.samples);
    bool same = n == 4U;
    for (std::size_t i = 1; i < n; ++i) {
        same = same && samples.id[i][at] == id;
    }
    if (same) {
        return shader.is_ground(id) ? 2.0F * (one(0) + one(3)) : 2.0F * (one(1) + one(2));
    }
    float sum = 0.0F;
    for (std::size_t i = 0; i < n; ++i) {
        sum += one(i);
    }
    return sum;
}

void shade_row(const View& view, const SampleGrid& grid, const RowSamples& samples, const Shader& shader,
               const Sensor& sensor, int row, std::uint8_t* out) {
    const float scale = static_cast<float>(sensor.gain) * 255.0F / static_cast<float>(view.samples);
    for (int x = 0; x < view.width; ++x) {
        const float value = scale * pixel_sum(view, grid, samples, shader, row, x) + static_cast<float>(sensor.offset) +
                            static_cast<float>(sensor.noise_sigma) * sensor_noise(sensor.seed, row, x) + 0.5F;
        out[x] =
            value < 0.0F ? std::uint8_t{0} : (value >= 255.0F ? std::uint8_t{255} : static_cast<std::uint8_t>(value));
    }
}

void render_view(const Scene& scene, const FrameScene& frame, const View& view, const Sensor& sensor, int threads,
                 GreyImage& out) {
    const ViewTargets targets = prepare_all(scene, frame, view);
    const Shader shader(scene, view, targets.shades, frame.shadows);
    out.width = view.width;
    out.height = view.height;
    out.pixels.assign(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), 0U);
    const int step = threads <= 1 ? 1 : 2;
    on_threads(step, [&](int thread) {
        RowTracer tracer(view, targets, false);
        for (int row = thread; row < view.height; row += step) {
            const RowSamples& samples = tracer.trace(row);
            shade_row(view, tracer.grid(), samples, shader, sensor, row,
                      out.pixels.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width));
        }
    });
}

double exposure_gain(const Imaging& imaging, int frame) {
    double gain = imaging.gain;
    for (const ExposureChange& e : imaging.exposure) {
        if (frame >= e.frame) {
            gain = imaging.gain * e.gain;
        }
    }
    return gain;
}

bool is_in(const std::vector<int>& list, int value) {
    for (const int x : list) {
        if (x == value) {
            return true;
        }
    }
    return false;
}

Silhouette joined(const Silhouette& a, const Silhouette& b) {
    Silhouette out = a.samples > 0 ? a : b;
    if (a.samples == 0 || b.samples == 0) {
        return out;
    }
    const auto join = [](const Box2d& p, const Box2d& q) {
        return Box2d{p.left < q.left ? p.left : q.left, p.top < q.top ? p.top : q.top,
                     p.right > q.right ? p.right : q.right, p.bottom > q.bottom ? p.bottom : q.bottom};
    };
    out.whole = join(a.whole, b.whole);
    out.visible =
        a.visible_samples == 0 ? b.visible : (b.visible_samples == 0 ? a.visible : join(a.visible, b.visible));
    out.samples += b.samples;
    out.visible_samples += b.visible_samples;
    return out;
}

void clip(Box2d& b, const View& view) {
    b.left = b.left < 0.0 ? 0.0 : b.left;
    b.top = b.top < 0.0 ? 0.0 : b.top;
    b.right = b.right > view.width - 1.0 ? view.width - 1.0 : b.right;
    b.bottom = b.bottom > view.height - 1.0 ? view.height - 1.0 : b.bottom;
}

}  // namespace

Calibration world_calibration(const Scenario& scenario) {
    Calibration c;
    c.width = kWidth;
    c.height = kHeight;
    c.left = PinholeCamera{721.5, 721.5, 609.6, 172.9};
    c.right = c.left;
    c.baseline_m = kBaseline_m;
    c.row_offset = scenario.imaging.row_offset;
    c.detection = c.left;
    return c;
}

void Renderer::render(int frame, GreyImage& left, GreyImage& right, int threads) const {
    const Imaging& imaging = scene_.scenario().imaging;
    left = GreyImage{};
    right = GreyImage{};
    if (is_in(imaging.dropped, frame)) {
        return;
    }
    const FrameScene now = scene_.at(frame);
    const double gain = exposure_gain(imaging, frame);
    const std::uint32_t seed = hash(scene_.scenario().seed, static_cast<std::uint32_t>(frame));
    render_view(scene_, now, left_view(calibration_, now.T_n_c, imaging.samples),
                {gain, 0.0, imaging.noise_sigma, hash(seed, 0U)}, threads, left);
    Calibration right_camera = calibration_;
    right_camera.row_offset.constant += imaging.row_error_px;
    render_view(scene_, now, right_view(right_camera, now.T_n_c, imaging.samples),
                {gain * imaging.right_gain, imaging.right_offset, imaging.noise_sigma, hash(seed, 1U)}, threads, right);
    rectify(left, imaging.rectification_px, hash(scene_.scenario().seed, 31U));
    rectify(right, imaging.rectification_px, hash(scene_.scenario().seed, 32U));
    if (frame >= imaging.blind_right_from && frame <= imaging.blind_right_to) {
        for (std::uint8_t& p : right.pixels) {
            p = 0;
        }
    }
}

std::vector<Silhouette> Renderer::silhouettes(int frame, int threads) const {
    const FrameScene now = scene_.at(frame);
    const View view = left_view(calibration_, now.T_n_c, scene_.scenario().imaging.samples);
    ViewTargets targets = prepare_all(scene_, now, view);
    const RowRange rows = keep_what_hides_users(targets);
    std::vector<std::vector<Silhouette>> parts(static_cast<std::size_t>(threads <= 1 ? 1 : 2));
    on_threads(threads, [&](int thread) {
        RowTracer tracer(view, targets, true);
        for (int row = rows.first + thread; row <= rows.last; row += threads <= 1 ? 1 : 2) {
            (void)tracer.trace(row);
        }
        parts[static_cast<std::size_t>(thread)] = tracer.silhouettes();
    });
    std::vector<Silhouette> out = parts[0];
    for (std::size_t k = 0; k < out.size(); ++k) {
        if (parts.size() > 1U) {
            out[k] = joined(parts[0][k], parts[1][k]);
        }
        clip(out[k].whole, view);
        clip(out[k].visible, view);
    }
    return out;
}

}  // namespace semtrack::sil::world
