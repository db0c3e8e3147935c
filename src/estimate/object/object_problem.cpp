#include "estimate/object/object_problem.hpp"

#include <cmath>

#include "estimate/factor/face_view.hpp"
#include "estimate/factor/stereo_point.hpp"
#include "estimate/object/object_weights.hpp"
#include "math/robust.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr int kPlane = 2;           // x and y of L
constexpr double kMinSize_m = 0.2;  // a step must not turn a box inside out

double time_step_s(const ObjectFrame& before, const ObjectFrame& after) {
    return 1e-6 * static_cast<double>(after.time_us - before.time_us);
}

StereoPointMeasurement measurement(const FeatureObservation& o) {
    StereoPointMeasurement z;
    z.u = static_cast<double>(o.u);
    z.v = static_cast<double>(o.v);
    z.u_right = static_cast<double>(o.u_right);
    z.stereo = o.stereo;
    z.sigma_px = kFeatureSigmaScale * static_cast<double>(o.sigma_px);
    z.sigma_right_px = kFeatureSigmaScale * static_cast<double>(o.sigma_right_px);
    return z;
}

// One residual of weight w that depends on the state of frame k and on the size.
void add_row(int k, double w, double r, const Vec6& J, const Vec3& J_size, NormalEquations& system) {
    system.add_frame(k, w * (J * J.transpose()), w * r * J);
    system.add_shared(w * (J_size * J_size.transpose()), w * r * J_size);
    system.add_frame_shared(k, w * (J * J_size.transpose()));
}

}  // namespace

void ObjectProblem::begin(const ObjectWindow& window, const Calibration& calibration,
                          const ObjectProblemOptions& options) {
    window_ = &window;
    calibration_ = &calibration;
    options_ = options;
    const ClassPrior& prior = class_prior(window.object_class);
    has_heading_ = prior.has_heading;
    motion_.model = prior.motion;
    motion_.standing = options.standing;
    motion_.wheelbase_m = prior.wheelbase_ratio * prior.size_m(0);
    motion_.noise = options.standing                           ? kStandingNoise
                    : prior.motion == MotionModel::kPedestrian ? kPedestrianNoise
                                                               : kVehicleNoise;
    size_prior_ = {window.prior_size_m, window.prior_size_covariance, window.prior_size_covariance.inverse()};
    frames_ = window.frames.size();
    const Vec3 t_d_c(calibration.t_d_c[0], calibration.t_d_c[1], calibration.t_d_c[2]);
    for (int k = 0; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        current_.state[i] = window.frames[k].state;
        const Pose& T_c_l = window.frames[k].T_c_l;
        views_[i] = {calibration.detection, {T_c_l.R, T_c_l.t + t_d_c}, calibration.width};
    }
    held_theta_ = window.newest().state.theta;
    current_.size_m = window.size_m;
    for (std::size_t slot = 0; slot < current_.f_o.size(); ++slot) {
        current_.f_o[slot] = window.landmarks[slot].f_o;
    }
    features_.begin(window, calibration, options.cues.features);
    features_current_ = false;
    choose_outlines();
}

void ObjectProblem::choose_outlines() {
    for (int k = 0; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (!window_->frames[k].box.valid) {
            continue;
        }
        const ObjectState& x = current_.state[i];
        const Pose T_l_o{rot_z(box_heading(x, window_->object_class, views_[i])), x.p};
        outlines_[i] = box_outline(views_[i].camera, views_[i].width, views_[i].T_d_l * T_l_o, current_.size_m);
    }
}

Mat3 ObjectProblem::feature_rotation(const ObjectState& x) const {
    return has_heading_ ? rot_z(x.theta) : Mat3(Mat3::Identity());
}

double ObjectProblem::linearise(NormalEquations& system) {
    choose_outlines();
    if (!features_current_) {
        features_cost_ = features_.evaluate(current_);
        features_current_ = true;
    }
    const double cost = evaluate(current_, &system) + features_cost_;
    features_.add_to(system);
    return cost;
}

double ObjectProblem::try_step(const SolverStep& step) {
    candidate_ = current_;
    for (int k = 0; k < frames_; ++k) {
        const auto i = static_cast<std::size_t>(k);
        ObjectState& x = candidate_.state[i];
        const Vec6& d = step.frame[i];
        x.p += d.head<3>();
        x.theta = wrap_angle(x.theta + d(3));
        x.v += d(4);
        x.delta += d(5);
    }
    candidate_.size_m += step.shared;
    for (int p = 0; p < features_.points(); ++p) {
        const std::size_t slot = features_.slot(p);
        candidate_.f_o[slot] += step.point[static_cast<std::size_t>(p)];
    }
    if (!(candidate_.size_m.minCoeff() > kMinSize_m)) {
        return 1e301;
    }
    features_current_ = false;
    features_cost_ = features_.evaluate(candidate_);
    return evaluate(candidate_, nullptr) + features_cost_;
}

void ObjectProblem::store(ObjectWindow& window) const {
    for (int k = 0; k < frames_; ++k) {
        window.frames[k].state = current_.state[static_cast<std::size_t>(k)];
    }
    window.size_m = current_.size_m;
    for (int p = 0; p < features_.points(); ++p) {
        const std::size_t slot = features_.slot(p);
        window.landmarks[slot].f_o = current_.f_o[slot];
    }
}

double ObjectProblem::evaluate(const ObjectVariables& x, NormalEquations* system) {
    if (system != nullptr) {
        system->clear(frames_, features_.points(), true, Coupling::kPlanar);
    }
    double cost = add_priors(x, system) + add_held_heading(x, system);
    for (int k = 0; k < frames_; ++k) {
        cost += add_boxes(x, k, system);
        cost += add_view(x, k, system);
        cost += add_ground(x, k, system);
        if (k > 0) {
            cost += add_motion(x, k, system);
        }
    }
    return cost;
}

double ObjectProblem::add_boxes(const ObjectVariables& x, int k, NormalEquations* system) {
    const auto i = static_cast<std::size_t>(k);
    if (!window_->frames[k].box.valid) {
        return 0.0;
    }
    box_edge_residuals(x.state[i], window_->object_class, x.size_m, views_[i], outlines_[i], window_->frames[k].box,
                       system != nullptr, edges_);
    // An edge sees p, theta and the size: only that part of the frame's block is summed.
    constexpr int kSeen = static_cast<int>(Coupling::kPlanar);
    double cost = 0.0;
    Mat6 H = Mat6::Zero();
    Vec6 g = Vec6::Zero();
    Mat6x3 H_size = Mat6x3::Zero();
    Mat3 H_shared = Mat3::Zero();
    Vec3 g_shared = Vec3::Zero();
    for (const EdgeResidual& e : edges_) {
        if (!e.valid) {
            continue;
        }
        const Robust huber_edge = huber(e.r * e.r, kEdgeHuber);
        cost += 0.5 * huber_edge.rho;
        for (int r = 0; system != nullptr && r < kSeen; ++r) {
            const double wJ = huber_edge.weight * e.J_state(r);
            for (int c = r; c < kSeen; ++c) {
                H(r, c) += wJ * e.J_state(c);
            }
            for (int c = 0; c < kSharedBlock; ++c) {
                H_size(r, c) += wJ * e.J_size(c);
            }
            g(r) += wJ * e.r;
        }
        for (int r = 0; system != nullptr && r < kSharedBlock; ++r) {
            const double wJ = huber_edge.weight * e.J_size(r);
            for (int c = r; c < kSharedBlock; ++c) {
                H_shared(r, c) += wJ * e.J_size(c);
            }
            g_shared(r) += wJ * e.r;
        }
    }
    if (system != nullptr) {
        system->add_frame(k, H, g);
        system->add_frame_shared(k, H_size);
        system->add_shared(H_shared, g_shared);
    }
    return cost;
}

// Far off, the class is wrong. What it says hardly changes within a window, so all frames count once.
double ObjectProblem::add_view(const ObjectVariables& x, int k, NormalEquations* system) const {
    const ObjectFrame& frame = window_->frames[k];
    if (!has_heading_ || !frame.box.valid) {
        return 0.0;
    }
    const auto i = static_cast<std::size_t>(k);
    const Vec3 camera_l = -(views_[i].T_d_l.R.transpose() * views_[i].T_d_l.t);
    const FaceViewResidual view =
        face_view_residual(x.state[i], x.size_m(1), camera_l, frame.box.viewpoint.horizontal, kViewSigma_rad);
    const double share = 1.0 / static_cast<double>(frames_);
    const Robust rho = cauchy(view.r * view.r, kViewCauchy);
    if (system != nullptr) {
        const double w = share * rho.weight;
        Vec6 J = Vec6::Zero();
        J.head<3>() = view.J_p;
        J(3) = view.J_theta;
        add_row(k, w, view.r, J, Vec3(0.0, view.J_width, 0.0), *system);
    }
    return 0.5 * share * rho.rho;
}

double ObjectProblem::add_ground(const ObjectVariables& x, int k, NormalEquations* system) {
    const ObjectFrame& frame = window_->frames[k];
    if (!options_.cues.ground || !frame.ground.valid) {
        return 0.0;
    }
    const auto i = static_cast<std::size_t>(k);
    const GroundResidual g = ground_residual(x.state[i], x.size_m(2), frame.T_c_l, frame.ground);
    // Errors of the road under one object hardly change within a window: all frames together count once.
    const double share = 1.0 / static_cast<double>(frames_);
    const Robust rho = huber(g.r * g.r, kEdgeHuber);
    if (system != nullptr) {
        const double w = share * rho.weight;
        Vec6 J = Vec6::Zero();
        J.head<3>() = g.J_p;
        add_row(k, w, g.r, J, Vec3(0.0, 0.0, g.J_height), *system);
    }
    return 0.5 * share * rho.rho;
}

double ObjectProblem::add_motion(const ObjectVariables& x, int k, NormalEquations* system) {
    const double dt_s = time_step_s(window_->frames[k - 1], window_->frames[k]);
    MotionModelSpec spec = motion_;
    set_ego_step(window_->frames[k - 1].T_c_l, window_->frames[k].T_c_l, spec);
    if (!options_.cues.motion) {
        // Without M the frames stay connected by next to nothing, so that one of them without a box has a solution.
        spec.standing = false;
        spec.noise = {30.0, 5.0, 3.0, 30.0, 1.0, 0.0};
    }
    Vec6 r;
    Mat6 J_before;
    Mat6 J_after;
    motion_residual(x.state[static_cast<std::size_t>(k - 1)], x.state[static_cast<std::size_t>(k)], dt_s, spec,
                    system != nullptr, r, J_before, J_after);
    if (system != nullptr) {
        // J_after: the roots of the weights, diagonal but for the plane, which is turned to the ego's step.
        Mat6 H = Mat6::Zero();
        Mat6 H_pair;
        Vec6 g;
        for (int c = 0; c < kFrameBlock; ++c) {
            const int first = c < kPlane ? 0 : c;
            const int end = c < kPlane ? kPlane : c + 1;
            H_pair.col(c).setZero();
            g(c) = 0.0;
            for (int i = first; i < end; ++i) {
                const double w = J_after(i, c);
                g(c) += w * r(i);
                for (int other = first; other < end; ++other) {
                    H(other, c) += J_after(i, other) * w;
                }
                for (int row = 0; row < kFrameBlock; ++row) {
                    H_pair(row, c) += J_before(i, row) * w;
                }
            }
        }
        system->add_frame(k - 1, J_before.transpose() * J_before, J_before.transpose() * r);
        system->add_frame(k, H, g);
        system->add_frame_pair(k - 1, k, H_pair);
    }
    return 0.5 * r.dot(r);
}

double ObjectProblem::add_held_heading(const ObjectVariables& x, NormalEquations* system) const {
    if (!options_.hold_heading || !has_heading_) {
        return 0.0;
    }
    const double w = window_->heading_information;
    const double off = wrap_angle(x.state[static_cast<std::size_t>(frames_ - 1)].theta - held_theta_);
    if (system != nullptr) {
        Mat6 H = Mat6::Zero();
        Vec6 g = Vec6::Zero();
        H(3, 3) = w;
        g(3) = w * off;
        system->add_frame(frames_ - 1, H, g);
    }
    return 0.5 * w * off * off;
}

double ObjectProblem::add_priors(const ObjectVariables& x, NormalEquations* system) {
    double cost = 0.5 * size_prior_cost(size_prior_, x.size_m);
    const ObjectState& oldest = x.state[0];
    const double speed_weight = 1.0 / (kSpeedSigma * kSpeedSigma);
    cost += 0.5 * speed_weight * oldest.v * oldest.v;
    const double steering_weight = 1.0 / (kSteeringSigma_rad * kSteeringSigma_rad);
    for (int k = 0; k < frames_; ++k) {
        const double delta = x.state[static_cast<std::size_t>(k)].delta;
        cost += 0.5 * steering_weight * delta * delta / static_cast<double>(frames_);
    }
    if (system == nullptr) {
        return cost;
    }
    system->add_shared(size_prior_.information, size_prior_.information * (x.size_m - size_prior_.mean_m));
    for (int k = 0; k < frames_; ++k) {
        Mat6 H = Mat6::Zero();
        Vec6 g = Vec6::Zero();
        const double w = steering_weight / static_cast<double>(frames_);
        H(5, 5) = w;
        g(5) = w * x.state[static_cast<std::size_t>(k)].delta;
        if (k == 0) {  // no residual: only damping about where the window stands
            H(0, 0) = H(1, 1) = H(2, 2) = 1.0 / (kAnchorPosition_m * kAnchorPosition_m);
            H(3, 3) = 1.0 / (kAnchorHeading_rad * kAnchorHeading_rad);
            H(4, 4) = speed_weight;
            g(4) = speed_weight * oldest.v;
        }
        system->add_frame(k, H, g);
    }
    return cost;
}

double ObjectProblem::feature_residual2(int frame, int slot) const {
    const ObjectFrame& f = window_->frames[frame];
    const FeatureObservation& o = f.features[static_cast<std::size_t>(slot)];
    const ObjectState& state = current_.state[static_cast<std::size_t>(frame)];
    if (!o.valid) {
        return -1.0;
    }
    const Vec3 x_c = f.T_c_l * (feature_rotation(state) * current_.f_o[static_cast<std::size_t>(slot)] + state.p);
    StereoPointResidual z;
    if (stereo_point_residual(*calibration_, x_c, measurement(o), false, z) != Status::kOk) {
        return -1.0;
    }
    return z.r.dot(z.r);
}

}  // namespace semtrack
