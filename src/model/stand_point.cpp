#include "model/stand_point.hpp"

#include <cmath>

namespace semtrack {

Status stand_point(const PinholeCamera& camera, const Box2d& box, const std::array<double, 4>& sigma_px,
                   const Pose& T_d_o, const Vec3& size_m, double height_sigma_m, StandPoint& out) {
    EdgeVertices vertices;
    for (const double sigma : sigma_px) {
        if (!(sigma > 0.0)) {
            return Status::kNotObservable;
        }
    }
    if (extreme_vertices(camera, T_d_o, size_m, vertices) != Status::kOk) {
        return Status::kNotObservable;
    }
    const auto column = [&](double u) { return Vec3(1.0, 0.0, -(u - camera.cx) / camera.fx); };
    const auto row = [&](double v) { return Vec3(0.0, 1.0, -(v - camera.cy) / camera.fy); };
    const Vec3 planes[kBoxEdges] = {column(box.left), column(box.right), row(box.top), row(box.bottom)};
    Mat3 A;
    Vec3 b;
    for (int e = 0; e < kBoxEdges; ++e) {
        const double c = -planes[e].dot(T_d_o.R * vertices[static_cast<std::size_t>(e)].scaled(size_m));
        if (e == kLeft) {
            A.row(0) = 0.5 * planes[e].transpose();
            b(0) = 0.5 * c;
        } else if (e == kRight) {
            A.row(0) += 0.5 * planes[e].transpose();
            b(0) += 0.5 * c;
        } else {
            A.row(e - 1) = planes[e].transpose();
            b(e - 1) = c;
        }
    }
    const Vec3 p = A.inverse() * b;
    if (!(p(2) > kMinDepth_m) || !std::isfinite(p(0) + p(1) + p(2))) {
        return Status::kNotObservable;
    }
    out.p_d = p - T_d_o.R.col(2) * (0.5 * size_m(2));
    // The bottom lies on the ray of its edge: an error of depth, from the size and the height of the box, moves it
    // along the ray.
    const double rows = box.bottom - box.top;
    const double size = height_sigma_m / size_m(2);
    const double depth2 =
        size * size + (sigma_px[kTop] * sigma_px[kTop] + sigma_px[kBottom] * sigma_px[kBottom]) / (rows * rows);
    const double edge = p(2) * sigma_px[kBottom] / camera.fy;
    const double drop = T_d_o.R.col(2).dot(out.p_d);
    out.sigma_m = std::sqrt(drop * drop * depth2 + edge * edge);
    return Status::kOk;
}

}  // namespace semtrack
