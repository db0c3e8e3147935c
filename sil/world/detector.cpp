#include "sil/world/detector.hpp"

#include "math/rng.hpp"
#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "sil/world/texture.hpp"

namespace semtrack::sil::world {

namespace {

constexpr double kSurePx = 40.0;  // from this height on only the basic miss rate holds

double miss_rate(const DetectorErrors& e, double height_px, double visible_share) {
    double rate = e.miss;
    if (height_px < kSurePx) {
        rate += 0.25 * (kSurePx - height_px) / (kSurePx - e.least_height_px);
    }
    if (visible_share < 0.6) {
        rate += 0.4 * (0.6 - visible_share);
    }
    return rate;
}

// One class to the side, three of four times across the nearer boundary in alpha.
Viewpoint confused(const Viewpoint& truth, double alpha, Rng& rng) {
    const double centre = kPi / 4.0 * static_cast<double>(truth.horizontal);
    const bool nearer = rng.below(4) != 0;
    const int step = (wrap_angle(alpha - centre) >= 0.0) == nearer ? 1 : -1;
    Viewpoint v = truth;
    v.horizontal = static_cast<std::int8_t>((truth.horizontal + step + 8) % 8);
    return v;
}

void add_edge_errors(const DetectorErrors& e, Rng& rng, Box2d& box) {
    const auto sigma = [&e](double size) {
        const double s = e.edge_sigma_share * size;
        return s > e.edge_sigma_px ? s : e.edge_sigma_px;
    };
    const double across = sigma(box.right - box.left);
    const double down = sigma(box.bottom - box.top);
    box.left += across * rng.normal();
    box.right += across * rng.normal();
    box.top += down * rng.normal();
    box.bottom += down * rng.normal();
}

bool false_positive(const Calibration& c, Rng& rng, Detection& out) {
    const double height = 25.0 + 60.0 * rng.uniform();
    const double width = height * (0.9 + 1.2 * rng.uniform());
    const double left = rng.uniform() * (c.width - width);
    const double bottom = c.left.cy + 0.6 * height + 15.0 * rng.uniform();
    out.box = Box2d{left, bottom - height, left + width, bottom};
    out.score = 0.3 + 0.3 * rng.uniform();
    out.viewpoint.horizontal = static_cast<std::int8_t>(rng.below(8));
    out.viewpoint.vertical = 1;
    return clip_box(Box2d(out.box), c.width, c.height, out.box);
}

// false: the detector missed it.
bool with_errors(const DetectorErrors& e, double alpha, double visible_share, Rng& rng, Detection& d) {
    const double height = d.box.bottom - d.box.top;
    const bool missed = rng.uniform() < miss_rate(e, height, visible_share);
    const bool confuse = rng.uniform() < e.viewpoint_wrong;
    add_edge_errors(e, rng, d.box);
    if (confuse && d.viewpoint.horizontal >= 0) {
        d.viewpoint = confused(d.viewpoint, alpha, rng);
    }
    const double small = height < 60.0 ? 0.15 * (60.0 - height) / 40.0 : 0.0;
    d.score = 0.97 - small - 0.3 * (1.0 - visible_share) - 0.08 * rng.uniform();
    return !missed;
}

}  // namespace

std::vector<Detection> detect(const Scene& scene, const Calibration& calibration, int frame,
                              const std::vector<Silhouette>& silhouettes, DetectorMode mode) {
    const Scenario& scenario = scene.scenario();
    const std::uint32_t frame_seed = hash(scenario.seed + 77U, static_cast<std::uint32_t>(frame));
    std::vector<Detection> out;
    for (std::size_t k = 0; k < silhouettes.size(); ++k) {
        const Silhouette& s = silhouettes[k];
        if (s.visible_samples == 0 || s.visible_share() < kMinDetectedShare ||
            s.visible.bottom - s.visible.top < scenario.detector.least_height_px) {
            continue;
        }
        const Label label = make_label(scene, calibration, k, frame, s);
        Detection d;
        d.box = s.visible;
        d.object_class = scenario.users[k].object_class;
        d.viewpoint = label.viewpoint;
        d.score = 1.0;
        if (mode == DetectorMode::kRealistic) {
            Rng rng(hash(frame_seed, static_cast<std::uint32_t>(scenario.users[k].id)));
            if (!with_errors(scenario.detector, label.alpha, s.visible_share(), rng, d)) {
                continue;
            }
        }
        if (!clip_box(Box2d(d.box), calibration.width, calibration.height, d.box) || d.box.right <= d.box.left ||
            d.box.bottom <= d.box.top) {
            continue;
        }
        out.push_back(d);
    }
    if (mode == DetectorMode::kRealistic) {
        Rng rng(hash(frame_seed, 0xfa15eU));
        Detection d;
        if (rng.uniform() < scenario.detector.false_positives && false_positive(calibration, rng, d)) {
            out.push_back(d);
        }
    }
    if (!scenario.detector.viewpoints) {
        for (Detection& d : out) {
            d.viewpoint = Viewpoint{};
        }
    }
    return out;
}

}  // namespace semtrack::sil::world
