#include "estimate/object/object_features.hpp"

#include <cmath>

#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/double2.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

Double2 both(double x) {
    return Double2{x, x};
}

/// A rotation and a translation, the same in both lanes.
struct Transform2 {
    Double2 r00, r01, r02, r10, r11, r12, r20, r21, r22, t0, t1, t2;

    Transform2(const Mat3& R, const Vec3& t)
        : r00(both(R(0, 0))),
          r01(both(R(0, 1))),
          r02(both(R(0, 2))),
          r10(both(R(1, 0))),
          r11(both(R(1, 1))),
          r12(both(R(1, 2))),
          r20(both(R(2, 0))),
          r21(both(R(2, 1))),
          r22(both(R(2, 2))),
          t0(both(t(0))),
          t1(both(t(1))),
          t2(both(t(2))) {}
};

/// What was measured of one observation, and where it is at the state, two lanes each.
struct Observed {
    Double2 x, y, inv_z, r0, r1, r2, focal_u, focal_v, focal_right, robust;
};

/// M = R^T J_x^T W J_x R and b = R^T J_x^T W r of two observations, in L (R = R_c_l).
struct Information {
    Double2 m00, m01, m02, m11, m12, m22, b0, b1, b2;
};

// J_x R has the rows (w f / z) (R_row - slope R_2): their weighted squares make M.
inline Information information(const Transform2& R, const Double2& baseline, const Observed& o) {
    const Double2 scale = o.robust * o.inv_z;
    const Double2 gx = o.focal_u * scale;
    const Double2 gy = o.focal_v * scale;
    const Double2 gr = o.focal_right * scale;
    const Double2 x_right = o.x - baseline * o.inv_z;
    const Double2 a0 = gx * (R.r00 - o.x * R.r20);
    const Double2 a1 = gx * (R.r01 - o.x * R.r21);
    const Double2 a2 = gx * (R.r02 - o.x * R.r22);
    const Double2 b0 = gy * (R.r10 - o.y * R.r20);
    const Double2 b1 = gy * (R.r11 - o.y * R.r21);
    const Double2 b2 = gy * (R.r12 - o.y * R.r22);
    const Double2 c0 = gr * (R.r00 - x_right * R.r20);
    const Double2 c1 = gr * (R.r01 - x_right * R.r21);
    const Double2 c2 = gr * (R.r02 - x_right * R.r22);
    return {a0 * a0 + b0 * b0 + c0 * c0,       a0 * a1 + b0 * b1 + c0 * c1,       a0 * a2 + b0 * b2 + c0 * c2,
            a1 * a1 + b1 * b1 + c1 * c1,       a1 * a2 + b1 * b2 + c1 * c2,       a2 * a2 + b2 * b2 + c2 * c2,
            a0 * o.r0 + b0 * o.r1 + c0 * o.r2, a1 * o.r0 + b1 * o.r1 + c1 * o.r2, a2 * o.r0 + b2 * o.r1 + c2 * o.r2};
}

/// Sums over the points of a frame, two lanes apart until the end: the frame's own block.
struct FrameSums {
    Information i{};
    Double2 q0{}, q1{}, q2{}, h{}, b_theta{};

    void add(const Information& x, const Double2& x_q0, const Double2& x_q1, const Double2& x_q2, const Double2& x_h,
             const Double2& x_b) {
        i.m00 += x.m00;
        i.m01 += x.m01;
        i.m02 += x.m02;
        i.m11 += x.m11;
        i.m12 += x.m12;
        i.m22 += x.m22;
        i.b0 += x.b0;
        i.b1 += x.b1;
        i.b2 += x.b2;
        q0 += x_q0;
        q1 += x_q1;
        q2 += x_q2;
        h += x_h;
        b_theta += x_b;
    }
    void add_to(NormalEquations& system, int k) const {
        Mat6 H = Mat6::Zero();
        H(0, 0) = sum2(i.m00);
        H(0, 1) = sum2(i.m01);
        H(0, 2) = sum2(i.m02);
        H(1, 1) = sum2(i.m11);
        H(1, 2) = sum2(i.m12);
        H(2, 2) = sum2(i.m22);
        H(0, 3) = sum2(q0);
        H(1, 3) = sum2(q1);
        H(2, 3) = sum2(q2);
        H(3, 3) = sum2(h);
        Vec6 g = Vec6::Zero();
        g(0) = sum2(i.b0);
        g(1) = sum2(i.b1);
        g(2) = sum2(i.b2);
        g(3) = sum2(b_theta);
        system.add_frame(k, H, g);
    }
};

/// Four sums of two lanes each: no chain of additions. n: even.
double sum_lanes(const Lane& a, std::size_t n) {
    std::array<Double2, 4> s{};
    for (std::size_t p = 0; p < n; p += kDouble2) {
        s[p / kDouble2 % 4] += load2(&a[p]);
    }
    return sum2((s[0] + s[1]) + (s[2] + s[3]));
}

}  // namespace

void ObjectFeatures::begin(const ObjectWindow& window, const Calibration& calibration, bool enabled) {
    calibration_ = calibration;
    has_heading_ = class_prior(window.object_class).has_heading;
    frames_ = window.frames.size();
    points_ = 0;
    for (int s = 0; s < kMaxObjectFeatures; ++s) {
        const auto slot = static_cast<std::size_t>(s);
        if (!enabled || !window.landmarks[slot].valid) {
            continue;
        }
        int seen = 0;
        for (const ObjectFrame& frame : window.frames) {
            seen += frame.features[slot].valid ? 1 : 0;
        }
        if (seen >= 2) {
            slot_of_point_[static_cast<std::size_t>(points_++)] = static_cast<std::int16_t>(s);
        }
    }
    lane_count_ = padded_lanes(points_);
    for (int k = 0; k < frames_; ++k) {
        gather_frame(window.frames[k], frame_lanes_[static_cast<std::size_t>(k)]);
    }
}

void ObjectFeatures::gather_frame(const ObjectFrame& frame, FrameLanes& lanes) const {
    lanes.R_c_l = frame.T_c_l.R;
    lanes.t_c_l = frame.T_c_l.t;
    lanes.seen_any = false;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const bool lane_used = p < static_cast<std::size_t>(points_);
        const FeatureObservation& o =
            frame.features[lane_used ? static_cast<std::size_t>(slot_of_point_[p]) : std::size_t{0}];
        const bool seen = lane_used && o.valid;
        lanes.seen_any = lanes.seen_any || seen;
        const double weight = seen ? 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_px)) : 0.0;
        const double weight_right =
            seen && o.stereo ? 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_right_px)) : 0.0;
        lanes.behind[p] = seen ? -1.0 : 0.0;
        lanes.focal_u[p] = weight * calibration_.left.fx;
        lanes.focal_v[p] = weight * calibration_.left.fy;
        lanes.focal_right[p] = weight_right * calibration_.left.fx;
        lanes.u[p] = seen ? weight * (static_cast<double>(o.u) - calibration_.left.cx) : 0.0;
        lanes.v[p] = seen ? weight * (static_cast<double>(o.v) - calibration_.left.cy) : 0.0;
        lanes.u_right[p] =
            seen && o.stereo ? weight_right * (static_cast<double>(o.u_right) - calibration_.right.cx) : 0.0;
    }
}

double ObjectFeatures::evaluate(const ObjectVariables& x) {
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const bool lane_used = p < static_cast<std::size_t>(points_);
        for (int axis = 0; axis < 3; ++axis) {
            f_[static_cast<std::size_t>(axis)][p] =
                lane_used ? x.f_o[static_cast<std::size_t>(slot_of_point_[p])](axis) : 0.0;
        }
    }
    double cost = 0.0;
    for (int k = 0; k < frames_; ++k) {
        FrameLanes& lanes = frame_lanes_[static_cast<std::size_t>(k)];
        if (lanes.seen_any) {
            project(x.state[static_cast<std::size_t>(k)], lanes);
            cost += robust_cost(lanes);
        }
    }
    return cost;
}

// x_c = R_c_l (p + R_z f) + t; a lane behind the camera has no residual, and r2 = -1 when its point was seen.
void ObjectFeatures::project(const ObjectState& state, FrameLanes& lanes) const {
    const SinCos heading = has_heading_ ? sin_cos(state.theta) : SinCos{0.0, 1.0};
    lanes.cos = heading.cos;
    lanes.sin = heading.sin;
    Mat3 R_l_o = Mat3::Identity();
    R_l_o(0, 0) = R_l_o(1, 1) = heading.cos;
    R_l_o(1, 0) = heading.sin;
    R_l_o(0, 1) = -heading.sin;
    const Mat3 R = lanes.R_c_l * R_l_o;
    const Vec3 t = lanes.R_c_l * state.p + lanes.t_c_l;
    const Transform2 T(R, t);
    const Double2 baseline = both(calibration_.baseline_m);
    FrameLanes& l = lanes;
    for (std::size_t p = 0; p < lane_count_; p += kDouble2) {
        const Double2 f0 = load2(&f_[0][p]);
        const Double2 f1 = load2(&f_[1][p]);
        const Double2 f2 = load2(&f_[2][p]);
        Double2 z_c = T.r20 * f0 + T.r21 * f1 + T.r22 * f2 + T.t2;
        Double2 ahead = both(1.0);
        for (int lane = 0; lane < 2; ++lane) {
            if (!(z_c[lane] >= kMinDepth_m)) {
                z_c[lane] = 1.0;
                ahead[lane] = 0.0;
            }
        }
        const Double2 inv_z = 1.0 / z_c;
        const Double2 x = (T.r00 * f0 + T.r01 * f1 + T.r02 * f2 + T.t0) * inv_z;
        const Double2 y = (T.r10 * f0 + T.r11 * f1 + T.r12 * f2 + T.t1) * inv_z;
        // w f slope - w (measured - centre)
        const Double2 r0 = ahead * (load2(&l.focal_u[p]) * x - load2(&l.u[p]));
        const Double2 r1 = ahead * (load2(&l.focal_v[p]) * y - load2(&l.v[p]));
        const Double2 r2 = ahead * (load2(&l.focal_right[p]) * (x - baseline * inv_z) - load2(&l.u_right[p]));
        store2(&l.x[p], x);
        store2(&l.y[p], y);
        store2(&l.inv_z[p], inv_z);
        store2(&l.r[0][p], r0);
        store2(&l.r[1][p], r1);
        store2(&l.r[2][p], r2);
        store2(&l.rho[p], r0 * r0 + r1 * r1 + r2 * r2 + (1.0 - ahead) * load2(&l.behind[p]));
        store2(&l.robust[p], ahead);
    }
}

// Huber; few lanes lie outside, and only those need a root.
double ObjectFeatures::robust_cost(FrameLanes& lanes) const {
    constexpr double k = kFeatureHuber;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const double r2 = lanes.rho[p];
        if (r2 < 0.0) {
            lanes.rho[p] = kFeatureCull * kFeatureCull;
        } else if (!(r2 <= k * k)) {
            const double r = std::sqrt(r2);
            lanes.rho[p] = 2.0 * k * r - k * k;
            const double root = std::sqrt(k / r);
            lanes.robust[p] = root;
            for (Lane& residual : lanes.r) {
                residual[p] *= root;
            }
        }
    }
    return 0.5 * sum_lanes(lanes.rho, lane_count_);
}

void ObjectFeatures::add_frame(int k, NormalEquations& system) const {
    constexpr std::size_t kStride = kCouplingStride<Coupling::kPlanar>;
    const FrameLanes& lanes = frame_lanes_[static_cast<std::size_t>(k)];
    const FramePoints out = system.open_frame(k);
    FrameSums sums;
    const Transform2 R(lanes.R_c_l, lanes.t_c_l);
    const Double2 baseline = both(calibration_.baseline_m);
    const Double2 turns = both(has_heading_ ? 1.0 : 0.0);
    const Double2 cos = both(lanes.cos);
    const Double2 sin = both(lanes.sin);
    for (std::size_t p = 0; p < lane_count_; p += kDouble2) {
        const Observed o{load2(&lanes.x[p]),       load2(&lanes.y[p]),       load2(&lanes.inv_z[p]),
                         load2(&lanes.r[0][p]),    load2(&lanes.r[1][p]),    load2(&lanes.r[2][p]),
                         load2(&lanes.focal_u[p]), load2(&lanes.focal_v[p]), load2(&lanes.focal_right[p]),
                         load2(&lanes.robust[p])};
        const Information i = information(R, baseline, o);
        const Double2 f0 = load2(&f_[0][p]);
        const Double2 f1 = load2(&f_[1][p]);
        // By theta: g = R_z (z x f), whose third entry is 0, and q = M g.
        const Double2 g0 = -turns * (sin * f0 + cos * f1);
        const Double2 g1 = turns * (cos * f0 - sin * f1);
        const Double2 q0 = i.m00 * g0 + i.m01 * g1;
        const Double2 q1 = i.m01 * g0 + i.m11 * g1;
        const Double2 q2 = i.m02 * g0 + i.m12 * g1;
        sums.add(i, q0, q1, q2, g0 * q0 + g1 * q1, g0 * i.b0 + g1 * i.b1);
        // E^T = R_z^T M [I, g], C = R_z^T M R_z: two rows and two columns are turned.
        const Double2 e00 = cos * i.m00 + sin * i.m01;
        const Double2 e01 = cos * i.m01 + sin * i.m11;
        const Double2 e02 = cos * i.m02 + sin * i.m12;
        const Double2 e10 = cos * i.m01 - sin * i.m00;
        const Double2 e11 = cos * i.m11 - sin * i.m01;
        const Double2 e12 = cos * i.m12 - sin * i.m02;
        double* const Et = out.Et + p;
        store2(Et, e00);
        store2(Et + kStride, e01);
        store2(Et + 2 * kStride, e02);
        store2(Et + 3 * kStride, cos * q0 + sin * q1);
        store2(Et + 4 * kStride, e10);
        store2(Et + 5 * kStride, e11);
        store2(Et + 6 * kStride, e12);
        store2(Et + 7 * kStride, cos * q1 - sin * q0);
        store2(Et + 8 * kStride, i.m02);
        store2(Et + 9 * kStride, i.m12);
        store2(Et + 10 * kStride, i.m22);
        store2(Et + 11 * kStride, q2);
        add2(&out.C[0][p], cos * e00 + sin * e01);
        add2(&out.C[1][p], cos * e01 - sin * e00);
        add2(&out.C[2][p], e02);
        add2(&out.C[3][p], cos * e11 - sin * e10);
        add2(&out.C[4][p], e12);
        add2(&out.C[5][p], i.m22);
        add2(&out.w[0][p], cos * i.b0 + sin * i.b1);
        add2(&out.w[1][p], cos * i.b1 - sin * i.b0);
        add2(&out.w[2][p], i.b2);
    }
    sums.add_to(system, k);
}

void ObjectFeatures::add_to(NormalEquations& system) const {
    for (int k = 0; k < frames_; ++k) {
        if (frame_lanes_[static_cast<std::size_t>(k)].seen_any) {
            add_frame(k, system);
        }
    }
}

}  // namespace semtrack
