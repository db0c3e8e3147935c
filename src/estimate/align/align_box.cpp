#include "estimate/align/align_box.hpp"

#include <array>
#include <cmath>

#include "math/camera.hpp"
#include "math/robust.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr int kIterations = 4;
constexpr double kFaceSigma_m = 0.15;   // bodies bend in by 0-0.4 m from the faces of their box
constexpr double kFaceInset_m = 0.10;   // ... by this at the median
constexpr double kShapeSigma_m = 0.10;  // ... and a face as a whole by so much about that: its points share it
constexpr double kCauchy = 2.0;         // sigmas
constexpr double kMaxInside_m = 1.0;    // farther from every visible face: glass, the other side, background
constexpr double kMaxShare = 0.5;       // a shift beyond half of the box is no alignment
constexpr double kDisparitySigma_px = 0.35;

/// A landmark in the object frame and the sigma of its position along the line of sight.
struct CloudPoint {
    double x;
    double y;
    double sigma_m;
    double ray_x;  // direction of the line of sight in O, horizontal part
    double ray_y;
};

struct Face {
    bool along_x;   // normal along x: front or rear
    double offset;  // signed coordinate of the face
};

using Cloud = StaticVector<CloudPoint, kMaxObjectFeatures>;
using Faces = StaticVector<Face, 4>;

void visible(const Vec3& camera_o, const Vec3& size_m, Faces& faces) {
    const double half_l = 0.5 * size_m(0);
    const double half_w = 0.5 * size_m(1);
    if (camera_o(0) > half_l) {
        (void)faces.try_push_back({true, half_l});
    }
    if (camera_o(0) < -half_l) {
        (void)faces.try_push_back({true, -half_l});
    }
    if (camera_o(1) > half_w) {
        (void)faces.try_push_back({false, half_w});
    }
    if (camera_o(1) < -half_w) {
        (void)faces.try_push_back({false, -half_w});
    }
}

void collect(const Calibration& calibration, const ObjectWindow& window, const Vec3& camera_o, Cloud& cloud) {
    const ObjectFrame& frame = window.newest();
    const double fb = calibration.left.fx * calibration.baseline_m;
    const double margin = 0.3;
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        const ObjectLandmark& landmark = window.landmarks[slot];
        if (!landmark.valid || !frame.features[slot].valid) {
            continue;
        }
        const Vec3& f = landmark.f_o;
        // The roof and the ground under the car say nothing about vertical faces.
        if (std::fabs(f(2)) > 0.5 * window.size_m(2) + margin) {
            continue;
        }
        Vec3 ray = f - camera_o;
        const double range = std::sqrt(ray.dot(ray));
        if (!(range > 1.0)) {
            continue;
        }
        ray /= range;
        const double sigma = range * range / fb * kDisparitySigma_px;
        (void)cloud.try_push_back({f(0), f(1), sigma, ray(0), ray(1)});
    }
}

/// Nearest visible face of a point at (x, y); -1: none near.
int nearest_face(const Faces& faces, double x, double y, const Vec3& size_m, double reach_m) {
    int best = -1;
    double best_distance = reach_m;
    for (int i = 0; i < faces.size(); ++i) {
        const double d = std::fabs((faces[i].along_x ? x : y) - faces[i].offset);
        const double beside = faces[i].along_x ? std::fabs(y) - 0.5 * size_m(1) : std::fabs(x) - 0.5 * size_m(0);
        if (d < best_distance && beside < 0.5 * reach_m) {
            best = i;
            best_distance = d;
        }
    }
    return best;
}

struct Alignment {
    double dx{0};
    double dy{0};
    double dtheta{0};
    int points{0};
};

/// Normal equations of one face's points.
struct FaceSum {
    Mat3 H{Mat3::Zero()};
    Vec3 g{Vec3::Zero()};
    double points{0};  // by their weights, one for a near point
};
using FaceSums = std::array<FaceSum, 4>;

/// A point at (x, y) in the moved frame, on face i.
void add_point(const CloudPoint& p, const Face& face, const SinCos& t, double x, double y, FaceSum& sum) {
    const double inward = face.offset > 0.0 ? -kFaceInset_m : kFaceInset_m;
    const double along = face.along_x ? p.ray_x : p.ray_y;
    const double variance = kFaceSigma_m * kFaceSigma_m + p.sigma_m * p.sigma_m * along * along;
    const double sigma = std::sqrt(variance);
    const double r = ((face.along_x ? x : y) - face.offset - inward) / sigma;
    const Vec3 J = face.along_x ? Vec3(-t.cos / sigma, -t.sin / sigma, y / sigma)
                                : Vec3(t.sin / sigma, -t.cos / sigma, -x / sigma);
    const Robust rho = cauchy(r * r, kCauchy);
    sum.H += rho.weight * (J * J.transpose());
    sum.g += rho.weight * r * J;
    sum.points += rho.weight * kFaceSigma_m * kFaceSigma_m / variance;
}

/// One Gauss-Newton step over all points; false: too few, or singular.
bool iterate(const Cloud& cloud, const Faces& faces, const Vec3& size_m, const Mat3& prior, Alignment& a) {
    const SinCos t = sin_cos(a.dtheta);
    FaceSums sums{};
    a.points = 0;
    for (const CloudPoint& p : cloud) {
        // Coordinates in the moved frame: R^T (f - d)
        const double rx = p.x - a.dx;
        const double ry = p.y - a.dy;
        const double x = t.cos * rx + t.sin * ry;
        const double y = -t.sin * rx + t.cos * ry;
        const int i = nearest_face(faces, x, y, size_m, kMaxInside_m + p.sigma_m);
        if (i >= 0) {
            add_point(p, faces[i], t, x, y, sums[static_cast<std::size_t>(i)]);
            ++a.points;
        }
    }
    Mat3 H = prior;
    Vec3 g = prior * Vec3(a.dx, a.dy, a.dtheta);
    for (const FaceSum& sum : sums) {
        // n points with a common error are worth no more than that error allows.
        const double common = sum.points * kShapeSigma_m * kShapeSigma_m / (kFaceSigma_m * kFaceSigma_m);
        const double share = 1.0 / (1.0 + common);
        H += share * sum.H;
        g += share * sum.g;
    }
    if (a.points < kMinAlignmentPoints || !(std::fabs(H.determinant()) > 0.0)) {
        return false;
    }
    const Vec3 step = H.inverse() * g;
    if (!std::isfinite(step(0)) || !std::isfinite(step(1)) || !std::isfinite(step(2))) {
        return false;
    }
    a.dx -= step(0);
    a.dy -= step(1);
    a.dtheta -= step(2);
    return true;
}

/// Information of (dx, dy, dtheta) in O from the covariance of (p, theta) in L.
bool map_information(const ObjectWindow& window, Mat3& information) {
    const double theta = window.newest().state.theta;
    const Mat3 R = rot_z(theta).transpose();
    Mat3 C;
    const int index[3] = {0, 1, 3};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            C(r, c) = window.covariance(index[r], index[c]);
        }
    }
    Mat3 T = Mat3::Identity();
    T.topLeftCorner<2, 2>() = R.topLeftCorner<2, 2>();
    C = T * C * T.transpose();
    const double determinant = C.determinant();
    if (!(determinant > 0.0) || !std::isfinite(determinant)) {
        return false;
    }
    information = C.inverse();
    return true;
}

}  // namespace

Status align_box(const Calibration& calibration, ObjectWindow& window, AlignmentReport& report) {
    report = AlignmentReport{};
    if (window.frames.empty() || !class_prior(window.object_class).has_heading) {
        return Status::kNotObservable;
    }
    const ObjectFrame& frame = window.newest();
    const Vec3 camera_l = -(frame.T_c_l.R.transpose() * frame.T_c_l.t);
    const Vec3 camera_o = frame.state.T_l_o().inverse() * camera_l;
    Faces faces;
    visible(camera_o, window.size_m, faces);
    Cloud cloud;
    collect(calibration, window, camera_o, cloud);
    Mat3 prior;
    if (cloud.size() < kMinAlignmentPoints || faces.empty() || !map_information(window, prior)) {
        return Status::kNotObservable;
    }
    Alignment a;
    for (int k = 0; k < kIterations; ++k) {
        if (!iterate(cloud, faces, window.size_m, prior, a)) {
            return Status::kNotObservable;
        }
    }
    if (std::fabs(a.dx) > kMaxShare * window.size_m(0) || std::fabs(a.dy) > kMaxShare * window.size_m(0) ||
        std::fabs(a.dtheta) > 0.5) {
        return Status::kNotObservable;
    }
    change_object_frame(window, Vec3(a.dx, a.dy, 0.0), a.dtheta);
    report = {a.points, a.dx, a.dy, a.dtheta};
    return Status::kOk;
}

}  // namespace semtrack
