#include "estimate/object/object_features.hpp"

#include <cmath>

#include "estimate/object/object_weights.hpp"
#include "math/camera.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

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
        lanes.seen[p] = seen;
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

// J_x R_c_l has the rows (w f / z) (R_row - slope R_2): three rows, whose weighted squares make M.
void ObjectFeatures::information(const FrameLanes& lanes) {
    const Mat3& R = lanes.R_c_l;
    const double r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2);
    const double r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2);
    const double r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2);
    const double fx = calibration_.left.fx;
    const double fy = calibration_.left.fy;
    const double baseline = calibration_.baseline_m;
    const FrameLanes& l = lanes;
    Information& o = information_;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const double gx = l.weight[p] * fx * l.inv_z[p];
        const double gy = l.weight[p] * fy * l.inv_z[p];
        const double gr = l.weight_right[p] * fx * l.inv_z[p];
        const double x = l.x[p];
        const double y = l.y[p];
        const double x_right = x - baseline * l.inv_z[p];
        const double a0 = gx * (r00 - x * r20), a1 = gx * (r01 - x * r21), a2 = gx * (r02 - x * r22);
        const double b0 = gy * (r10 - y * r20), b1 = gy * (r11 - y * r21), b2 = gy * (r12 - y * r22);
        const double c0 = gr * (r00 - x_right * r20), c1 = gr * (r01 - x_right * r21), c2 = gr * (r02 - x_right * r22);
        const double s = l.robust[p];
        o.M[0][p] = s * (a0 * a0 + b0 * b0 + c0 * c0);
        o.M[1][p] = s * (a0 * a1 + b0 * b1 + c0 * c1);
        o.M[2][p] = s * (a0 * a2 + b0 * b2 + c0 * c2);
        o.M[3][p] = s * (a1 * a1 + b1 * b1 + c1 * c1);
        o.M[4][p] = s * (a1 * a2 + b1 * b2 + c1 * c2);
        o.M[5][p] = s * (a2 * a2 + b2 * b2 + c2 * c2);
        o.b[0][p] = s * (a0 * l.r[0][p] + b0 * l.r[1][p] + c0 * l.r[2][p]);
        o.b[1][p] = s * (a1 * l.r[0][p] + b1 * l.r[1][p] + c1 * l.r[2][p]);
        o.b[2][p] = s * (a2 * l.r[0][p] + b2 * l.r[1][p] + c2 * l.r[2][p]);
    }
}

// E^T = R_z^T M [I, g] and C = R_z^T M R_z: turns of two columns and two rows.
void ObjectFeatures::turn_to_object(const FrameLanes& lanes) {
    const double c = lanes.cos;
    const double s = lanes.sin;
    const double turns = has_heading_ ? 1.0 : 0.0;
    const std::array<Lane, 6>& M = information_.M;
    const std::array<Lane, 3>& b = information_.b;
    Information& o = information_;
    for (std::size_t p = 0; p < lane_count_; ++p) {
        const double m00 = M[0][p], m01 = M[1][p], m02 = M[2][p], m11 = M[3][p], m12 = M[4][p], m22 = M[5][p];
        const double g0 = -turns * (s * f_[0][p] + c * f_[1][p]);
        const double g1 = turns * (c * f_[0][p] - s * f_[1][p]);
        const double q0 = m00 * g0 + m01 * g1;
        const double q1 = m01 * g0 + m11 * g1;
        const double q2 = m02 * g0 + m12 * g1;
        o.theta[0][p] = q0;
        o.theta[1][p] = q1;
        o.theta[2][p] = q2;
        o.theta[3][p] = g0 * q0 + g1 * q1;
        o.theta[4][p] = g0 * b[0][p] + g1 * b[1][p];
        const double e00 = c * m00 + s * m01, e01 = c * m01 + s * m11, e02 = c * m02 + s * m12;
        const double e10 = c * m01 - s * m00, e11 = c * m11 - s * m01, e12 = c * m12 - s * m02;
        out_.Et[0][p] = e00;
        out_.Et[1][p] = e01;
        out_.Et[2][p] = e02;
        out_.Et[3][p] = c * q0 + s * q1;
        out_.Et[4][p] = e10;
        out_.Et[5][p] = e11;
        out_.Et[6][p] = e12;
        out_.Et[7][p] = c * q1 - s * q0;
        out_.Et[8][p] = m02;
        out_.Et[9][p] = m12;
        out_.Et[10][p] = m22;
        out_.Et[11][p] = q2;
        out_.C[0][p] = c * e00 + s * e01;
        out_.C[1][p] = c * e01 - s * e00;
        out_.C[2][p] = e02;
        out_.C[3][p] = c * e11 - s * e10;
        out_.C[4][p] = e12;
        out_.C[5][p] = m22;
        out_.w[0][p] = c * b[0][p] + s * b[1][p];
        out_.w[1][p] = c * b[1][p] - s * b[0][p];
        out_.w[2][p] = b[2][p];
    }
}

void ObjectFeatures::add_frame_sums(int k, NormalEquations& system) const {
    const Information& o = information_;
    Mat6 H = Mat6::Zero();
    Vec6 g = Vec6::Zero();
    std::size_t at = 0;
    for (int r = 0; r < 3; ++r) {
        for (int c = r; c < 3; ++c) {
            H(r, c) = sum_lanes(o.M[at++], lane_count_);
        }
        H(r, 3) = sum_lanes(o.theta[static_cast<std::size_t>(r)], lane_count_);
        g(r) = sum_lanes(o.b[static_cast<std::size_t>(r)], lane_count_);
    }
    H(3, 3) = sum_lanes(o.theta[3], lane_count_);
    g(3) = sum_lanes(o.theta[4], lane_count_);
    system.add_frame(k, H, g);
}

void ObjectFeatures::add_to(NormalEquations& system) {
    for (int k = 0; k < frames_; ++k) {
        const FrameLanes& lanes = frame_lanes_[static_cast<std::size_t>(k)];
        if (!lanes.seen_any) {
            continue;
        }
        information(lanes);
        turn_to_object(lanes);
        out_.seen = lanes.seen;
        add_frame_sums(k, system);
        system.add_points(k, 0, points_, out_);
    }
}

}  // namespace semtrack
