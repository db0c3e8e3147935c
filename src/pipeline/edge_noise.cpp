#include "pipeline/edge_noise.hpp"

#include <cmath>

#include "model/box_geometry.hpp"

namespace semtrack {

namespace {

constexpr double kBorder_px = 1.5;     // an edge this near to the border is the border's, not the object's,
constexpr double kBorderSigmas = 2.5;  // or this near: detectors draw cut boxes some pixels short of the border

constexpr double kCorrelated = 2.0;  // times: errors stay from frame to frame
constexpr double kHidden = 2.0;      // times, of an edge behind a nearer box

double edge_scatter_px(const Box2d& box) {
    constexpr double kBase_px = 0.8;
    constexpr double kShareOfHeight = 0.022;
    const double h = kShareOfHeight * (box.bottom - box.top);
    return std::sqrt(kBase_px * kBase_px + h * h);
}

}  // namespace

std::array<bool, 4> hidden_edges(const Box2d& box, const Box2d& b) {
    if (!(b.bottom > box.bottom)) {
        return {};
    }
    const double rows = (b.bottom < box.bottom ? b.bottom : box.bottom) - (b.top > box.top ? b.top : box.top);
    const double columns = (b.right < box.right ? b.right : box.right) - (b.left > box.left ? b.left : box.left);
    const bool tall = rows > 0.3 * (box.bottom - box.top);
    const bool wide = columns > 0.3 * (box.right - box.left);
    std::array<bool, 4> hidden{};
    hidden[kLeft] = tall && b.left < box.left && b.right > box.left;
    hidden[kRight] = tall && b.left < box.right && b.right > box.right;
    hidden[kTop] = wide && b.top < box.top && b.bottom > box.top;
    hidden[kBottom] = wide && b.top < box.bottom;
    return hidden;
}

double hidden_edge_sigma(const Box2d& box) {
    return kCorrelated * kHidden * edge_scatter_px(box);
}

Box2d drawn_to_border(const Box2d& box, int width, int height, const std::array<bool, 4>& hidden) {
    const double near = kBorderSigmas * edge_scatter_px(box);
    const auto margin = [&](BoxEdge e) {
        const double m = near * (hidden[static_cast<std::size_t>(e)] ? kHidden : 1.0);
        return m > kBorder_px ? m : kBorder_px;
    };
    const double right = static_cast<double>(width - 1);
    const double bottom = static_cast<double>(height - 1);
    return {box.left < margin(kLeft) ? 0.0 : box.left, box.top < margin(kTop) ? 0.0 : box.top,
            box.right > right - margin(kRight) ? right : box.right,
            box.bottom > bottom - margin(kBottom) ? bottom : box.bottom};
}

std::array<double, 4> edge_sigmas(const DetectionList& list, int item, int width, int height) {
    constexpr double kSideways = 1.25;
    const Box2d& box = list.items[item].box;
    const double sigma = kCorrelated * edge_scatter_px(box);
    std::array<double, 4> out{kSideways * sigma, kSideways * sigma, sigma, sigma};
    std::array<bool, 4> hidden{};
    for (int other = 0; other < list.items.size(); ++other) {
        const std::array<bool, 4> by_other = hidden_edges(box, list.items[other].box);
        for (std::size_t e = 0; e < out.size(); ++e) {
            out[e] *= by_other[e] ? kHidden : 1.0;
            hidden[e] = hidden[e] || by_other[e];
        }
    }
    const Box2d drawn = drawn_to_border(box, width, height, hidden);
    if (drawn.left <= 0.0) {
        out[kLeft] = 0.0;
    }
    if (drawn.right >= width - 1) {
        out[kRight] = 0.0;
    }
    if (drawn.top <= 0.0) {
        out[kTop] = 0.0;
    }
    if (drawn.bottom >= height - 1) {
        out[kBottom] = 0.0;
    }
    return out;
}

}  // namespace semtrack
