#include "front/mask/owner_mask_builder.hpp"

#include <cmath>
#include <cstring>

#include "math/camera.hpp"

namespace semtrack {

namespace {

int ceil_to(double x, int low, int high) {
    const double c = std::ceil(x);
    return c < low ? low : c > high ? high : static_cast<int>(c);
}

int floor_to(double x, int low, int high) {
    const double f = std::floor(x);
    return f < low ? low : f > high ? high : static_cast<int>(f);
}

double cross(const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a(0) - o(0)) * (b(1) - o(1)) - (a(1) - o(1)) * (b(0) - o(0));
}

bool before(const Vec2& a, const Vec2& b) {
    return a(0) < b(0) || (a(0) == b(0) && a(1) < b(1));
}

/// Convex hull of at most 8 points, monotone chain.
template <class Points>
void convex_hull(Vec2* points, int n, Points& hull) {
    for (int i = 1; i < n; ++i) {
        const Vec2 p = points[i];
        int k = i;
        for (; k > 0 && before(p, points[k - 1]); --k) {
            points[k] = points[k - 1];
        }
        points[k] = p;
    }
    Vec2 chain[18];
    int size = 0;
    for (int i = 0; i < n; ++i) {
        for (int guard = 0; guard < n && size >= 2 && cross(chain[size - 2], chain[size - 1], points[i]) <= 0.0;
             ++guard) {
            --size;
        }
        chain[size++] = points[i];
    }
    const int lower = size + 1;
    for (int i = n - 2; i >= 0; --i) {
        for (int guard = 0; guard < n && size >= lower && cross(chain[size - 2], chain[size - 1], points[i]) <= 0.0;
             ++guard) {
            --size;
        }
        chain[size++] = points[i];
    }
    hull.clear();
    for (int i = 0; i + 1 < size; ++i) {
        (void)hull.try_push_back(chain[i]);
    }
}

double share_outside(const Box2d& box, int width, int height) {
    Box2d inside;
    const double area = (box.right - box.left) * (box.bottom - box.top);
    if (!(area > 0.0) || !clip_box(box, width, height, inside)) {
        return 1.0;
    }
    const double share = 1.0 - (inside.right - inside.left) * (inside.bottom - inside.top) / area;
    return share > 0.0 ? share : 0.0;
}

}  // namespace

bool OwnerMaskBuilder::contour_of(const PinholeCamera& camera, const MaskItem& item, Contour& out) const {
    out.corners.clear();
    if (item.has_box3d && projected_box(camera, item.T_c_o, item.size_m, out.bounds) == Status::kOk) {
        Vec2 points[8];
        bool whole = true;
        for (int i = 0; i < 8 && whole; ++i) {
            const BoxVertex corner{static_cast<std::int8_t>((i & 1) != 0 ? 1 : -1),
                                   static_cast<std::int8_t>((i & 2) != 0 ? 1 : -1),
                                   static_cast<std::int8_t>((i & 4) != 0 ? 1 : -1)};
            const Vec3 x_c = item.T_c_o * corner.scaled(item.size_m);
            whole = x_c(2) >= kMinDepth_m;
            if (whole) {
                points[i] = project(camera, x_c);
            }
        }
        if (whole) {
            convex_hull(points, 8, out.corners);
            return out.corners.size() >= 3;
        }
    } else if (item.has_box2d) {
        out.bounds = item.box2d;
    } else {
        return false;
    }
    // Partly behind the camera, or only a 2D box: its rectangle.
    const Box2d& b = out.bounds;
    for (const Vec2& p : {Vec2(b.left, b.top), Vec2(b.right, b.top), Vec2(b.right, b.bottom), Vec2(b.left, b.bottom)}) {
        (void)out.corners.try_push_back(p);
    }
    return true;
}

// Scan conversion of a convex polygon: row by row between its left and right border. Returns the painted pixels.
int OwnerMaskBuilder::fill(const Contour& contour, std::uint8_t owner, OwnerMask& mask) const {
    const int first = ceil_to(contour.bounds.top, 0, mask.height);
    const int last = floor_to(contour.bounds.bottom, -1, mask.height - 1);
    const int n = contour.corners.size();
    int painted = 0;
    for (int y = first; y <= last; ++y) {
        double left = 1e9;
        double right = -1e9;
        for (int i = 0; i < n; ++i) {
            const Vec2& a = contour.corners[i];
            const Vec2& b = contour.corners[i + 1 == n ? 0 : i + 1];
            const double low = a(1) < b(1) ? a(1) : b(1);
            const double high = a(1) < b(1) ? b(1) : a(1);
            if (y < low || y > high) {
                continue;
            }
            const double x = high > low ? a(0) + (b(0) - a(0)) * ((y - a(1)) / (b(1) - a(1))) : a(0);
            left = x < left ? x : left;
            right = x > right ? x : right;
        }
        const int from = ceil_to(left, 0, mask.width);
        const int to = floor_to(right, -1, mask.width - 1);
        if (to < from) {
            continue;
        }
        std::memset(mask.row(y) + from, owner, static_cast<std::size_t>(to - from + 1));
        painted += to - from + 1;
    }
    return painted;
}

void OwnerMaskBuilder::build(const PinholeCamera& camera, int width, int height, const MaskItems& items,
                             OwnerMask& mask, MaskResults& results) {
    mask.width = width;
    mask.height = height;
    std::memset(mask.data.data(), kBackgroundOwner, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    results.clear();
    const int n = items.size();
    for (int i = 0; i < n; ++i) {  // far to near; equal depths by index
        int k = i;
        for (; k > 0 && items[order_[static_cast<std::size_t>(k - 1)]].depth_m < items[i].depth_m; --k) {
            order_[static_cast<std::size_t>(k)] = order_[static_cast<std::size_t>(k - 1)];
        }
        order_[static_cast<std::size_t>(k)] = i;
        (void)results.try_push_back(MaskResult{});
    }
    for (const MaskItem& item : items) {  // first the guards: never over an object
        if (!item.has_box2d || !item.has_box3d) {
            continue;
        }
        contour_.corners.clear();
        contour_.bounds = item.box2d;
        const Box2d& b = item.box2d;
        for (const Vec2& p :
             {Vec2(b.left, b.top), Vec2(b.right, b.top), Vec2(b.right, b.bottom), Vec2(b.left, b.bottom)}) {
            (void)contour_.corners.try_push_back(p);
        }
        (void)fill(contour_, kNoOwner, mask);
    }
    for (int k = 0; k < n; ++k) {
        const int i = order_[static_cast<std::size_t>(k)];
        painted_[static_cast<std::size_t>(i)] = 0;
        if (!contour_of(camera, items[i], contour_)) {
            results[i] = {0.0, 1.0};
            continue;
        }
        results[i].truncation = share_outside(contour_.bounds, width, height);
        painted_[static_cast<std::size_t>(i)] = fill(contour_, items[i].owner, mask);
    }
    count_.fill(0);
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* row = mask.row(y);
        for (int x = 0; x < width; ++x) {
            ++count_[row[x]];
        }
    }
    for (int i = 0; i < n; ++i) {
        const int painted = painted_[static_cast<std::size_t>(i)];
        const int left = count_[items[i].owner];
        results[i].visible_share = painted > 0 ? static_cast<double>(left) / static_cast<double>(painted) : 0.0;
    }
}

void OwnerMaskBuilder::leave_out(const Box2d& box, OwnerMask& mask) {
    Box2d inside;
    if (!clip_box(box, mask.width, mask.height, inside)) {
        return;
    }
    const int left = static_cast<int>(inside.left);
    const int right = static_cast<int>(inside.right);
    const int bottom = static_cast<int>(inside.bottom);
    for (int y = static_cast<int>(inside.top); y <= bottom; ++y) {
        std::uint8_t* row = mask.row(y);
        for (int x = left; x <= right; ++x) {
            row[x] = row[x] == kBackgroundOwner ? kNoOwner : row[x];
        }
    }
}

}  // namespace semtrack
