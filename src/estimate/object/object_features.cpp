#include "estimate/object/object_features.hpp"

#include <cmath>

#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/double2.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

/// Two lanes of an observation at the state.
struct Observed {
    Double2 x, y, inv_z, r0, r1, r2, weight, weight_right, robust;
};

/// M = R^T J_x^T W J_x R and b = R^T J_x^T W r of two observations, in L (R = R_c_l).
struct Information {
    Double2 m00, m01, m02, m11, m12, m22, b0, b1, b2;
};

// J_x R has the rows (w f / z) (R_row - slope R_2): their weighted squares make M.
inline Information information(const Calibration& calibration, const Mat3& R, const Observed& o) {
    const Double2 gx = o.weight * calibration.left.fx * o.inv_z;
    const Double2 gy = o.weight * calibration.left.fy * o.inv_z;
    const Double2 gr = o.weight_right * calibration.left.fx * o.inv_z;
    const Double2 x_right = o.x - calibration.baseline_m * o.inv_z;
    const Double2 a0 = gx * (R(0, 0) - o.x * R(2, 0));
    const Double2 a1 = gx * (R(0, 1) - o.x * R(2, 1));
    const Double2 a2 = gx * (R(0, 2) - o.x * R(2, 2));
    const Double2 b0 = gy * (R(1, 0) - o.y * R(2, 0));
    const Double2 b1 = gy * (R(1, 1) - o.y * R(2, 1));
    const Double2 b2 = gy * (R(1, 2) - o.y * R(2, 2));
    const Double2 c0 = gr * (R(0, 0) - x_right * R(2, 0));
    const Double2 c1 = gr * (R(0, 1) - x_right * R(2, 1));
    const Double2 c2 = gr * (R(0, 2) - x_right * R(2, 2));
    const Double2 s = o.robust;
    return {s * (a0 * a0 + b0 * b0 + c0 * c0),       s * (a0 * a1 + b0 * b1 + c0 * c1),
            s * (a0 * a2 + b0 * b2 + c0 * c2),       s * (a1 * a1 + b1 * b1 + c1 * c1),
            s * (a1 * a2 + b1 * b2 + c1 * c2),       s * (a2 * a2 + b2 * b2 + c2 * c2),
            s * (a0 * o.r0 + b0 * o.r1 + c0 * o.r2), s * (a1 * o.r0 + b1 * o.r1 + c1 * o.r2),
            s * (a2 * o.r0 + b2 * o.r1 + c2 * o.r2)};
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
        lanes.behind_cost[p] = seen ? -1.0 : 0.0;
        lanes.u[p] = seen ? static_cast<double>(o.u) : 0.0;
        lanes.v[p] = seen ? static_cast<double>(o.v) : 0.0;
        lanes.u_right[p] = seen ? static_cast<double>(o.u_right) : 0.0;
        lanes.weight[p] = seen ? 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_px)) : 0.0;
        lanes.weight_right[p] =
            seen && o.stereo ? 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_right_px)) : 0.0;
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
    const double r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), t0 = t(0);
    const double r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2), t1 = t(1);
    const double r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), t2 = t(2);
    const double fx = calibration_.left.fx;
    const double fy = calibration_.left.fy;
    const double cx = calibration_.left.cx;
    const double cy = calibration_.left.cy;
    const double cx_right = calibration_.right.cx;
    const double baseline = calibration_.baseline_m;
    FrameLanes& l = lanes;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        l.x[p] = r00 * f_[0][p] + r01 * f_[1][p] + r02 * f_[2][p] + t0;
        l.y[p] = r10 * f_[0][p] + r11 * f_[1][p] + r12 * f_[2][p] + t1;
        l.inv_z[p] = r20 * f_[0][p] + r21 * f_[1][p] + r22 * f_[2][p] + t2;
        l.robust[p] = 1.0;
    }
    for (std::size_t p = 0; p < lane_count_; ++p) {
        if (!(l.inv_z[p] >= kMinDepth_m)) {
            l.inv_z[p] = 1.0;
            l.robust[p] = 0.0;
        }
    }
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const double inv_z = 1.0 / l.inv_z[p];
        const double x = l.x[p] * inv_z;
        const double y = l.y[p] * inv_z;
        const double ahead = l.robust[p];
        const double w = ahead * l.weight[p];
        const double w_right = ahead * l.weight_right[p];
        const double r_u = w * (fx * x + cx - l.u[p]);
        const double r_v = w * (fy * y + cy - l.v[p]);
        const double r_right = w_right * (fx * (x - baseline * inv_z) + cx_right - l.u_right[p]);
        const double r2 = r_u * r_u + r_v * r_v + r_right * r_right + (1.0 - ahead) * l.behind_cost[p];
        l.x[p] = x;
        l.y[p] = y;
        l.inv_z[p] = inv_z;
        l.r[0][p] = r_u;
        l.r[1][p] = r_v;
        l.r[2][p] = r_right;
        l.r2[p] = r2;
        l.rho[p] = r2;
    }
}

// Huber; few lanes lie outside, and only those need a root.
double ObjectFeatures::robust_cost(FrameLanes& lanes) const {
    constexpr double k = kFeatureHuber;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const double r2 = lanes.r2[p];
        if (r2 < 0.0) {
            lanes.rho[p] = kFeatureCull * kFeatureCull;
        } else if (!(r2 <= k * k)) {
            const double r = std::sqrt(r2);
            lanes.rho[p] = 2.0 * k * r - k * k;
            lanes.robust[p] = k / r;
        }
    }
    return 0.5 * sum_lanes(lanes.rho, lane_count_);
}

void ObjectFeatures::add_frame(int k, NormalEquations& system) const {
    constexpr std::size_t kStride = kCouplingStride<Coupling::kPlanar>;
    const FrameLanes& lanes = frame_lanes_[static_cast<std::size_t>(k)];
    const FramePoints out = system.open_frame(k);
    FrameSums sums;
    const double turns = has_heading_ ? 1.0 : 0.0;
    const double cos = lanes.cos;
    const double sin = lanes.sin;
    for (std::size_t p = 0; p < lane_count_; p += kDouble2) {
        const Information i =
            information(calibration_, lanes.R_c_l,
                        {load2(&lanes.x[p]), load2(&lanes.y[p]), load2(&lanes.inv_z[p]), load2(&lanes.r[0][p]),
                         load2(&lanes.r[1][p]), load2(&lanes.r[2][p]), load2(&lanes.weight[p]),
                         load2(&lanes.weight_right[p]), load2(&lanes.robust[p])});
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
