#include "pipeline/usable_detections.hpp"

#include <cmath>

#include "front/associate/associate.hpp"
#include "model/box_geometry.hpp"

namespace semtrack {

namespace {

bool usable(const Detection& d, int width, int height, Box2d& clipped) {
    const Box2d& b = d.box;
    if (!std::isfinite(b.left) || !std::isfinite(b.top) || !std::isfinite(b.right) || !std::isfinite(b.bottom) ||
        !std::isfinite(d.score) || !(b.right > b.left) || !(b.bottom > b.top)) {
        return false;
    }
    return clip_box(b, width, height, clipped) && clipped.right > clipped.left && clipped.bottom > clipped.top;
}

double area(const Box2d& b) {
    return (b.right - b.left) * (b.bottom - b.top);
}

bool same_object(const Detection& a, const Detection& b) {
    const double left = a.box.left > b.box.left ? a.box.left : b.box.left;
    const double right = a.box.right < b.box.right ? a.box.right : b.box.right;
    const double top = a.box.top > b.box.top ? a.box.top : b.box.top;
    const double bottom = a.box.bottom < b.box.bottom ? a.box.bottom : b.box.bottom;
    if (!(right > left) || !(bottom > top) || !may_be_one(a.object_class, b.object_class)) {
        return false;
    }
    const double shared = (right - left) * (bottom - top);
    return shared >= kSameObjectOverlap * (area(a.box) + area(b.box) - shared);
}

}  // namespace

std::uint32_t take_usable(const DetectionList& in, int width, int height, DetectionList& out) {
    std::uint32_t dropped = 0;
    out.time_us = in.time_us;
    out.items.clear();
    for (const Detection& detection : in.items) {
        Detection d = detection;
        if (!usable(detection, width, height, d.box)) {
            ++dropped;
            continue;
        }
        int same = -1;
        for (int k = 0; k < out.items.size() && same < 0; ++k) {
            same = same_object(out.items[k], d) ? k : -1;
        }
        if (same < 0) {
            dropped += out.items.try_push_back(d) ? 0U : 1U;
            continue;
        }
        ++dropped;
        const double more = d.score - out.items[same].score;
        const bool commoner = d.object_class < out.items[same].object_class;
        const bool rarer = out.items[same].object_class < d.object_class;
        if (more > (commoner ? -kEqualScores : rarer ? kEqualScores : 0.0)) {
            out.items[same] = d;
        }
    }
    return dropped;
}

}  // namespace semtrack
