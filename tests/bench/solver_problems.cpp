#include "bench/solver_problems.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "estimate/ego/ego_problem.hpp"
#include "estimate/object/object_estimator.hpp"
#include "estimate/object/object_problem.hpp"
#include "estimate/object/object_weights.hpp"
#include "estimate/solver/levenberg_marquardt.hpp"
#include "math/robust.hpp"
#include "math/so3.hpp"
#include "sil/heap/counting_malloc.hpp"
#include "tests/estimate/ego/drive_scene.hpp"
#include "tests/estimate/object/object_scene.hpp"

namespace semtrack::bench {

namespace {

constexpr int kRuns = 5;
constexpr int kCarFrames = 24;  // the window then has ten
constexpr int kEgoFramesDriven = 14;

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

struct Workspace {
    NormalEquations system;
    SolverStep step;
};
Workspace& workspace() {
    static const auto owner = std::make_unique<Workspace>();
    return *owner;
}

/// Solves from the same start five times; the shortest counts.
template <class Problem, class Begin>
SolveOutcome shortest_of_five(Problem& problem, Begin begin, const SolveLimits& limits) {
    LmOptions options;
    options.iterations = limits.iterations;
    options.relative_decrease = limits.tolerance;
    SolveOutcome out;
    out.ms = out.begin_ms = 1e9;
    Workspace& w = workspace();
    for (int run = 0; run < kRuns; ++run) {
        const AllocationCounter counter;
        const Clock::time_point start = Clock::now();
        begin(problem);
        const Clock::time_point begun = Clock::now();
        const LmReport report = levenberg_marquardt(problem, options, w.system, w.step);
        const Clock::time_point end = Clock::now();
        out.begin_ms = std::min(out.begin_ms, Milliseconds(begun - start).count());
        out.ms = std::min(out.ms, Milliseconds(end - begun).count());
        out.iterations = report.iterations;
        out.allocations = counter.count();
        out.cost_start = report.initial_cost;
    }
    return out;
}

StereoCamera stereo_camera(const Calibration& c) {
    return {c.left.fx, c.left.fy, c.left.cx, c.left.cy, c.right.cx, c.baseline_m};
}
Pose12 flat(const Pose& T) {
    Pose12 out{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            out[static_cast<std::size_t>(3 * r + c)] = T.R(r, c);
        }
        out[static_cast<std::size_t>(9 + r)] = T.t(r);
    }
    return out;
}
Pose pose(const double* x) {
    Pose T;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            T.R(r, c) = x[3 * r + c];
        }
        T.t(r) = x[9 + r];
    }
    return T;
}
Point3 flat(const Vec3& x) {
    return {x(0), x(1), x(2)};
}
ObjectState state(const double* x) {
    return {Vec3(x[0], x[1], x[2]), x[3], x[4], x[5]};
}
template <class Matrix>
void copy_rows(const Matrix& m, double* out) {
    for (int r = 0; out != nullptr && r < m.rows(); ++r) {
        for (int c = 0; c < m.cols(); ++c) {
            out[m.cols() * r + c] = m(r, c);
        }
    }
}

/// Away from where the last solve ended, so that every iteration has something to do.
void disturb(ObjectWindow& window, std::uint32_t seed) {
    Rng rng(1000U + seed);
    for (ObjectFrame& frame : window.frames) {
        frame.state.p += 0.3 * Vec3(normal(rng), normal(rng), 0.3 * normal(rng));
        frame.state.theta += 0.05 * normal(rng);
        frame.state.v += 0.5 * normal(rng);
        frame.state.delta += 0.02 * normal(rng);
    }
    window.size_m += Vec3(0.2 * normal(rng), 0.05 * normal(rng), 0.05 * normal(rng));
    for (ObjectLandmark& landmark : window.landmarks) {
        landmark.f_o += 0.1 * Vec3(normal(rng), normal(rng), normal(rng));
    }
}

}  // namespace

struct ObjectProblemData::Inner {
    std::unique_ptr<ObjectScene> scene;
    ObjectProblemOptions options;
    std::unique_ptr<ObjectProblem> problem = std::make_unique<ObjectProblem>();
    MotionModelSpec motion;
    SizePrior prior;
    Mat3 prior_root;
    std::vector<BoxOutline> outlines;
    std::vector<DetectionView> views;
    std::vector<std::size_t> slots;
};

ObjectProblemData::~ObjectProblemData() = default;

ObjectProblemData::ObjectProblemData(int seed) : inner_(std::make_unique<Inner>()) {
    ObjectSceneOptions options;
    options.features = 100;
    options.transparent = true;
    options.start.v = 4.0 + 0.02 * seed;
    options.start.p = Vec3(12.0 + 0.05 * seed, -4.0 + 0.04 * seed, -0.9);
    options.seed = static_cast<std::uint32_t>(seed);
    inner_->scene = std::make_unique<ObjectScene>(options);
    ObjectScene& scene = *inner_->scene;
    Config config;
    config.cues.ground = false;
    const auto estimator = std::make_unique<ObjectEstimator>();
    estimator->init(scene.calibration(), config);
    for (int k = 0; k < kCarFrames; ++k) {
        scene.next();
        (void)estimator->solve(scene.window(), workspace().system, workspace().step);
    }
    scene.next();
    disturb(scene.window(), options.seed);
    inner_->options.cues = config.cues;

    const ObjectWindow& window = scene.window();
    const Calibration& calibration = scene.calibration();
    const ClassPrior& prior = class_prior(window.object_class);
    inner_->motion = {prior.motion, false, prior.wheelbase_ratio * prior.size_m(0), kVehicleNoise};
    inner_->prior = semtrack::size_prior(window.object_class);
    // Upper triangular U with U^T U = information.
    Mat3& U = inner_->prior_root;
    const Mat3& A = inner_->prior.information;
    U.setZero();
    for (int r = 0; r < 3; ++r) {
        double d = A(r, r);
        for (int k = 0; k < r; ++k) {
            d -= U(k, r) * U(k, r);
        }
        U(r, r) = std::sqrt(d);
        for (int c = r + 1; c < 3; ++c) {
            double s = A(r, c);
            for (int k = 0; k < r; ++k) {
                s -= U(k, r) * U(k, c);
            }
            U(r, c) = s / U(r, r);
        }
    }
    camera = stereo_camera(calibration);
    feature_huber = kFeatureHuber;
    edge_huber = kEdgeHuber;
    size = flat(window.size_m);
    std::vector<int> point_of_slot(kMaxObjectFeatures, -1);
    for (std::size_t s = 0; s < window.landmarks.size(); ++s) {
        int seen = 0;
        for (const ObjectFrame& frame : window.frames) {
            seen += frame.features[s].valid ? 1 : 0;
        }
        if (window.landmarks[s].valid && seen >= 2) {
            point_of_slot[s] = static_cast<int>(points.size());
            points.push_back(flat(window.landmarks[s].f_o));
            inner_->slots.push_back(s);
        }
    }
    for (int k = 0; k < window.frames.size(); ++k) {
        const ObjectFrame& frame = window.frames[k];
        const ObjectState& x = frame.state;
        states.push_back({x.p(0), x.p(1), x.p(2), x.theta, x.v, x.delta});
        T_c_l.push_back(flat(frame.T_c_l));
        const DetectionView view{calibration.detection, frame.T_c_l, calibration.width};
        inner_->outlines.push_back(
            box_outline(view.camera, view.width, view.T_d_l * Pose{rot_z(x.theta), x.p}, window.size_m));
        inner_->views.push_back(view);
        for (std::size_t s = 0; s < frame.features.size(); ++s) {
            const FeatureObservation& o = frame.features[s];
            if (o.valid && point_of_slot[s] >= 0) {
                observations.push_back(
                    {k, point_of_slot[s], static_cast<double>(o.u), static_cast<double>(o.v),
                     static_cast<double>(o.u_right), 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_px)),
                     o.stereo ? 1.0 / (kFeatureSigmaScale * static_cast<double>(o.sigma_right_px)) : 0.0});
            }
        }
    }
}

SolveOutcome ObjectProblemData::solve(const SolveLimits& limits) {
    SolveOutcome out = shortest_of_five(
        *inner_->problem,
        [&](ObjectProblem& p) { p.begin(inner_->scene->window(), inner_->scene->calibration(), inner_->options); },
        limits);
    out.cost = inner_->problem->linearise(workspace().system);
    return out;
}

void ObjectProblemData::motion(int k, const double* before, const double* after, double* r, double* J_before,
                               double* J_after) const {
    const auto& frames = inner_->scene->window().frames;
    const double dt_s = 1e-6 * static_cast<double>(frames[k].time_us - frames[k - 1].time_us);
    Vec6 residual;
    Mat6 before_J;
    Mat6 after_J;
    MotionModelSpec motion = inner_->motion;
    set_ego_step(frames[k - 1].T_c_l, frames[k].T_c_l, motion);
    motion_residual(state(before), state(after), dt_s, motion, J_before != nullptr || J_after != nullptr, residual,
                    before_J, after_J);
    copy_rows(residual, r);
    copy_rows(before_J, J_before);
    copy_rows(after_J, J_after);
}

bool ObjectProblemData::edge(int k, int e, const double* x, const double* d, double* r, double* J_state,
                             double* J_size) const {
    const auto i = static_cast<std::size_t>(k);
    if (!inner_->scene->window().frames[k].box.valid) {
        return false;
    }
    EdgeResiduals edges;
    box_edge_residuals(state(x), ObjectClass::kCar, Vec3(d[0], d[1], d[2]), inner_->views[i], inner_->outlines[i],
                       inner_->scene->window().frames[k].box, J_state != nullptr || J_size != nullptr, edges);
    const EdgeResidual& residual = edges[static_cast<std::size_t>(e)];
    *r = residual.r;
    copy_rows(residual.J_state, J_state);
    copy_rows(residual.J_size, J_size);
    return residual.valid;
}

void ObjectProblemData::size_prior(const double* d, double* r, double* J) const {
    copy_rows(Vec3(inner_->prior_root * (Vec3(d[0], d[1], d[2]) - inner_->prior.mean_m)), r);
    copy_rows(inner_->prior_root, J);
}

double ObjectProblemData::speed_weight() const {
    return 1.0 / kSpeedSigma;
}
double ObjectProblemData::steering_weight() const {
    return 1.0 / (kSteeringSigma_rad * std::sqrt(static_cast<double>(states.size())));
}

double ObjectProblemData::cost_at(const std::vector<State6>& x, const Point3& d, const std::vector<Point3>& f) const {
    ObjectProblem& problem = *inner_->problem;
    problem.begin(inner_->scene->window(), inner_->scene->calibration(), inner_->options);
    const auto variables = std::make_unique<ObjectVariables>(problem.variables());
    for (std::size_t k = 0; k < x.size(); ++k) {
        variables->state[k] = state(x[k].data());
    }
    variables->size_m = Vec3(d[0], d[1], d[2]);
    for (std::size_t p = 0; p < f.size(); ++p) {
        variables->f_o[inner_->slots[p]] = Vec3(f[p][0], f[p][1], f[p][2]);
    }
    problem.set(*variables);
    return problem.linearise(workspace().system);
}

struct EgoProblemData::Inner {
    Calibration calibration;
    EgoWindow window;
    std::vector<int> landmarks;
    EgoProblem problem;
};

EgoProblemData::~EgoProblemData() = default;

EgoProblemData::EgoProblemData(int seed) : inner_(std::make_unique<Inner>()) {
    DriveOptions options;
    options.features = 500;
    options.seed = static_cast<std::uint32_t>(seed);
    const auto scene = std::make_unique<DriveScene>(options);
    const auto features = std::make_unique<FrameFeatures>();
    EgoWindow& window = inner_->window;
    inner_->calibration = scene->calibration();
    window.clear();
    for (int k = 0; k < kEgoFramesDriven; ++k) {
        scene->next(*features);
        const int leaving = window.leaving();
        if (leaving >= 0) {
            window.drop(leaving);
        }
        window.push(static_cast<std::uint32_t>(k + 1), scene->T_w_c().inverse());
        window.take(*features, scene->calibration());
        window.give_birth(scene->calibration());
        window.frames.back().keyframe = true;
    }
    camera = stereo_camera(inner_->calibration);
    tukey = 4.0;
    const int frames = window.frames.size();
    const int first_free = frames - kFreeFrames;
    for (int k = 0; k < frames; ++k) {
        T_c_w.push_back(flat(window.frames[k].T_c_w));
        held.push_back(k < first_free);
    }
    for (const bool seen_now : {true, false}) {
        for (int l = 0; l < kEgoLandmarks && static_cast<int>(points.size()) < kSolverPoints; ++l) {
            const EgoLandmark& landmark = window.landmarks[static_cast<std::size_t>(l)];
            std::vector<Observation> seen;
            bool seen_free = false;
            for (int k = 0; k < frames; ++k) {
                const EgoObservation& o = window.seen(l, window.frames[k]);
                if (o.valid) {
                    seen.push_back({k, static_cast<int>(points.size()), static_cast<double>(o.u),
                                    static_cast<double>(o.v), static_cast<double>(o.u_right),
                                    1.0 / static_cast<double>(o.sigma_px),
                                    o.stereo ? 1.0 / static_cast<double>(o.sigma_right_px) : 0.0});
                    seen_free = seen_free || k >= first_free;
                }
            }
            if (landmark.valid && window.seen(l, window.frames.back()).valid == seen_now && seen.size() >= 2 &&
                seen_free) {
                inner_->landmarks.push_back(l);
                points.push_back(flat(landmark.x_w));
                observations.insert(observations.end(), seen.begin(), seen.end());
            }
        }
    }
}

SolveOutcome EgoProblemData::solve(const SolveLimits& limits) {
    SolveOutcome out = shortest_of_five(
        inner_->problem, [&](EgoProblem& p) { p.begin(inner_->window, inner_->calibration); }, limits);
    out.cost = inner_->problem.linearise(workspace().system);
    return out;
}

void EgoProblemData::perturb(const double* T, const double* xi, double* out) {
    Vec6 d;
    d << xi[0], xi[1], xi[2], xi[3], xi[4], xi[5];
    const Pose12 moved = flat(perturbed_left(pose(T), d));
    std::copy(moved.begin(), moved.end(), out);
}

double EgoProblemData::cost_at(const std::vector<Pose12>& T, const std::vector<Point3>& x) const {
    double cost = 0.0;
    for (const Observation& o : observations) {
        const Point3& f = x[static_cast<std::size_t>(o.point)];
        const Vec3 x_c = pose(T[static_cast<std::size_t>(o.frame)].data()) * Vec3(f[0], f[1], f[2]);
        const StereoPointMeasurement z{o.u, o.v, o.u_right, 1.0 / o.weight, 1.0 / o.weight_right, true};
        StereoPointResidual r;
        if (stereo_point_residual(inner_->calibration, x_c, z, false, r) != Status::kOk) {
            return 1e300;
        }
        cost += 0.5 * semtrack::tukey(r.r.dot(r.r), tukey).rho;
    }
    return cost;
}

}  // namespace semtrack::bench
