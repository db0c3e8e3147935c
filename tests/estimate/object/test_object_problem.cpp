// The object's normal equations against the stacked Jacobians of its factors: what is computed in lanes and by
// structure must be J^T J and J^T r of the factors' own definitions, in a dense long double system.
#include "estimate/object/object_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "estimate/factor/face_view.hpp"
#include "estimate/factor/stereo_point.hpp"
#include "estimate/object/object_scene.hpp"
#include "estimate/object/object_weights.hpp"
#include "math/robust.hpp"
#include "support/dense_system.hpp"

namespace semtrack {
namespace {

using test::DenseSystem;

/// Dense order as the step's: frames, size, points.
class Stacked {
public:
    Stacked(const ObjectWindow& window, const Calibration& calibration, const std::vector<int>& slots)
        : window_(window), calibration_(calibration), slots_(slots), dense_(at_point(static_cast<int>(slots.size()))) {
        add_features();
        add_boxes();
        add_motion_and_priors();
    }
    DenseSystem& dense() { return dense_; }
    [[nodiscard]] double cost() const { return cost_; }
    [[nodiscard]] int at_size() const { return 6 * window_.frames.size(); }
    [[nodiscard]] int at_point(int p) const { return at_size() + 3 + 3 * p; }
    int outliers{0};
    int behind{0};
    int edges{0};

private:
    using Block = std::pair<int, std::vector<double>>;  // first column, one row of J

    /// One row of the stack: residual r with weight w.
    void add_row(const std::vector<Block>& blocks, double r, double w) {
        for (const Block& a : blocks) {
            for (std::size_t i = 0; i < a.second.size(); ++i) {
                const int row = a.first + static_cast<int>(i);
                dense_.b(row) += static_cast<long double>(w) * static_cast<long double>(a.second[i] * r);
                for (const Block& b : blocks) {
                    for (std::size_t k = 0; k < b.second.size(); ++k) {
                        dense_.A(row, b.first + static_cast<int>(k)) += static_cast<long double>(w) *
                                                                        static_cast<long double>(a.second[i]) *
                                                                        static_cast<long double>(b.second[k]);
                    }
                }
            }
        }
    }
    void add_features() {
        const bool has_heading = class_prior(window_.object_class).has_heading;
        for (int k = 0; k < window_.frames.size(); ++k) {
            const ObjectFrame& frame = window_.frames[k];
            const Mat3 R_l_o = has_heading ? rot_z(frame.state.theta) : Mat3(Mat3::Identity());
            for (std::size_t p = 0; p < slots_.size(); ++p) {
                const auto slot = static_cast<std::size_t>(slots_[p]);
                const FeatureObservation& o = frame.features[slot];
                if (!o.valid) {
                    continue;
                }
                const Vec3& f = window_.landmarks[slot].f_o;
                StereoPointMeasurement z{static_cast<double>(o.u), static_cast<double>(o.v),
                                         static_cast<double>(o.u_right)};
                z.stereo = o.stereo;
                z.sigma_px = kFeatureSigmaScale * static_cast<double>(o.sigma_px);
                z.sigma_right_px = kFeatureSigmaScale * static_cast<double>(o.sigma_right_px);
                StereoPointResidual r;
                if (stereo_point_residual(calibration_, frame.T_c_l * (R_l_o * f + frame.state.p), z, true, r) !=
                    Status::kOk) {
                    cost_ += 0.5 * kFeatureCull * kFeatureCull;
                    ++behind;
                    continue;
                }
                const Robust rho = huber(r.r.dot(r.r), kFeatureHuber);
                cost_ += 0.5 * rho.rho;
                outliers += rho.weight < 1.0 ? 1 : 0;
                const Mat3 J_p = r.J * frame.T_c_l.R;
                const Mat3 J_f = J_p * R_l_o;
                const Vec3 J_theta = has_heading ? Vec3(J_p * (R_l_o * Vec3(-f(1), f(0), 0.0))) : Vec3(Vec3::Zero());
                for (int row = 0; row < 3; ++row) {
                    add_row({{6 * k, {J_p(row, 0), J_p(row, 1), J_p(row, 2), J_theta(row)}},
                             {at_point(static_cast<int>(p)), {J_f(row, 0), J_f(row, 1), J_f(row, 2)}}},
                            r.r(row), rho.weight);
                }
            }
        }
    }
    void add_boxes() {
        for (int k = 0; k < window_.frames.size(); ++k) {
            const ObjectFrame& frame = window_.frames[k];
            const DetectionView view{calibration_.detection, frame.T_c_l, calibration_.width};
            const Pose T_l_o{rot_z(box_heading(frame.state, window_.object_class, view)), frame.state.p};
            if (!frame.box.valid) {
                continue;
            }
            const BoxOutline outline = box_outline(view.camera, view.width, view.T_d_l * T_l_o, window_.size_m);
            EdgeResiduals residuals;
            box_edge_residuals(frame.state, window_.object_class, window_.size_m, view, outline, frame.box, true,
                               residuals);
            add_view(k);
            for (const EdgeResidual& e : residuals) {
                if (!e.valid) {
                    continue;
                }
                ++edges;
                const Robust rho = huber(e.r * e.r, kEdgeHuber);
                cost_ += 0.5 * rho.rho;
                add_row({{6 * k, {e.J_state(0), e.J_state(1), e.J_state(2), e.J_state(3)}},
                         {at_size(), {e.J_size(0), e.J_size(1), e.J_size(2)}}},
                        e.r, rho.weight);
            }
        }
    }
    void add_view(int k) {
        if (!class_prior(window_.object_class).has_heading) {
            return;
        }
        const ObjectFrame& frame = window_.frames[k];
        const Vec3 camera_l = -(frame.T_c_l.R.transpose() * frame.T_c_l.t);
        const FaceViewResidual v = face_view_residual(frame.state, window_.size_m(1), camera_l,
                                                      frame.box.viewpoint.horizontal, kViewSigma_rad);
        const Robust rho = cauchy(v.r * v.r, kViewCauchy);
        const double share = 1.0 / window_.frames.size();
        cost_ += 0.5 * share * rho.rho;
        add_row({{6 * k, {v.J_p(0), v.J_p(1), v.J_p(2), v.J_theta}}, {at_size(), {0.0, v.J_width, 0.0}}}, v.r,
                share * rho.weight);
    }
    void add_motion_and_priors() {
        const ClassPrior& prior = class_prior(window_.object_class);
        const int frames = window_.frames.size();
        MotionModelSpec spec{prior.motion, false, prior.wheelbase_ratio * prior.size_m(0),
                             prior.motion == MotionModel::kPedestrian ? kPedestrianNoise : kVehicleNoise};
        for (int k = 0; k < frames; ++k) {
            const ObjectState& x = window_.frames[k].state;
            const double steering = 1.0 / (kSteeringSigma_rad * kSteeringSigma_rad * frames);
            cost_ += 0.5 * steering * x.delta * x.delta;
            add_row({{6 * k + 5, {1.0}}}, x.delta, steering);
            if (k == 0) {
                for (int c = 0; c < 3; ++c) {
                    add_row({{c, {1.0}}}, 0.0, 1.0 / (kAnchorPosition_m * kAnchorPosition_m));
                }
                add_row({{3, {1.0}}}, 0.0, 1.0 / (kAnchorHeading_rad * kAnchorHeading_rad));
                cost_ += 0.5 * x.v * x.v / (kSpeedSigma * kSpeedSigma);
                add_row({{4, {1.0}}}, x.v, 1.0 / (kSpeedSigma * kSpeedSigma));
                continue;
            }
            Vec6 r;
            Mat6 Ja;
            Mat6 Jb;
            const double dt_s = 1e-6 * static_cast<double>(window_.frames[k].time_us - window_.frames[k - 1].time_us);
            set_ego_step(window_.frames[k - 1].T_c_l, window_.frames[k].T_c_l, spec);
            motion_residual(window_.frames[k - 1].state, x, dt_s, spec, true, r, Ja, Jb);
            cost_ += 0.5 * r.dot(r);
            for (int row = 0; row < 6; ++row) {
                std::vector<double> a;
                std::vector<double> b;
                for (int c = 0; c < 6; ++c) {
                    a.push_back(Ja(row, c));
                    b.push_back(Jb(row, c));
                }
                add_row({{6 * (k - 1), a}, {6 * k, b}}, r(row), 1.0);
            }
        }
        const SizePrior size{window_.prior_size_m, window_.prior_size_covariance,
                             window_.prior_size_covariance.inverse()};
        const Vec3 off = window_.size_m - size.mean_m;
        cost_ += 0.5 * size_prior_cost(size, window_.size_m);
        const Vec3 gradient = size.information * off;
        for (int r = 0; r < 3; ++r) {
            dense_.b(at_size() + r) += static_cast<long double>(gradient(r));
            for (int c = 0; c < 3; ++c) {
                dense_.A(at_size() + r, at_size() + c) += static_cast<long double>(size.information(r, c));
            }
        }
    }

    const ObjectWindow& window_;
    const Calibration& calibration_;
    std::vector<int> slots_;
    DenseSystem dense_;
    double cost_{0};
};

struct Case {
    ObjectClass object_class;
    int frames;
    int features;
    double theta;
    double v;
    double depth_m;
};

/// Windows with mono features, outliers, features that come and go, and states away from the optimum.
std::unique_ptr<ObjectScene> scene_of(const Case& c, std::uint32_t seed) {
    ObjectSceneOptions options;
    options.object_class = c.object_class;
    options.features = c.features;
    options.transparent = true;
    options.ego_step_m = 0.1;
    options.start = {Vec3(c.depth_m, 0.1 * c.depth_m, -0.9), c.theta, c.v, 0.02};
    options.seed = seed;
    auto scene = std::make_unique<ObjectScene>(options);
    Rng rng(77U + seed);
    for (int k = 0; k < c.frames; ++k) {
        scene->next();
    }
    ObjectWindow& window = scene->window();
    for (std::size_t s = 0; s < static_cast<std::size_t>(c.features); ++s) {
        window.landmarks[s].valid = true;
        window.landmarks[s].f_o = Vec3(between(rng, -2.0, 2.0), between(rng, -0.8, 0.8), between(rng, -0.7, 0.7));
    }
    for (ObjectFrame& frame : window.frames) {
        frame.state.p += 0.05 * Vec3(normal(rng), normal(rng), normal(rng));
        for (std::size_t s = 0; s < static_cast<std::size_t>(c.features); ++s) {
            FeatureObservation& o = frame.features[s];
            o.stereo = o.stereo && rng.below(4) != 0;
            o.valid = o.valid && rng.below(3) != 0;
        }
    }
    return scene;
}

std::vector<int> points_of(const ObjectWindow& window) {
    std::vector<int> slots;
    for (std::size_t s = 0; s < window.landmarks.size(); ++s) {
        const auto seen = std::count_if(window.frames.begin(), window.frames.end(),
                                        [&](const ObjectFrame& f) { return f.features[s].valid; });
        if (window.landmarks[s].valid && seen >= 2) {
            slots.push_back(static_cast<int>(s));
        }
    }
    return slots;
}

double difference(const SolverStep& step, int frames, const std::vector<long double>& x) {
    std::vector<double> mine;
    for (int k = 0; k < frames; ++k) {
        for (int r = 0; r < 6; ++r) {
            mine.push_back(step.frame[static_cast<std::size_t>(k)](r));
        }
    }
    for (int r = 0; r < 3; ++r) {
        mine.push_back(step.shared(r));
    }
    for (std::size_t p = 0; mine.size() < x.size(); ++p) {
        for (int r = 0; r < 3; ++r) {
            mine.push_back(step.point[p](r));
        }
    }
    long double worst = 0.0L;
    long double largest = 0.0L;
    for (std::size_t i = 0; i < x.size(); ++i) {
        worst = std::max(worst, std::fabs(static_cast<long double>(mine[i]) - x[i]));
        largest = std::max(largest, std::fabs(x[i]));
    }
    return static_cast<double>(worst / largest);
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all{{ObjectClass::kCar, 6, 12, 0.3, 8.0, 15.0},
                                       {ObjectClass::kCar, 1, 0, 0.3, 8.0, 15.0},
                                       {ObjectClass::kCar, 4, 1, kPi, -2.0, 10.0},
                                       {ObjectClass::kCar, 8, 21, -kPi, -3.0, 12.0},
                                       {ObjectClass::kCar, 5, 10, 1.5, 0.0, 60.0},
                                       {ObjectClass::kCar, 3, 9, -1.5, 12.0, 118.0},
                                       {ObjectClass::kPedestrian, 6, 11, 0.8, 1.2, 9.0},
                                       {ObjectClass::kCyclist, 7, 14, 2.0, 4.0, 20.0},
                                       {ObjectClass::kCar, 5, kMaxObjectFeatures, 0.1, 5.0, 14.0},
                                       {ObjectClass::kCar, 30, 20, 0.0, 1.0, 6.0}};
    return all;
}

TEST(ObjectProblem, StepAndCostAreThoseOfTheStackedJacobians) {
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto problem = std::make_unique<ObjectProblem>();
    int checked = 0;
    int outliers = 0;
    int edges = 0;
    for (const Case& c : cases()) {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            const auto scene = scene_of(c, seed);
            ObjectProblemOptions options;
            options.cues.ground = false;
            problem->begin(scene->window(), scene->calibration(), options);
            const std::vector<int> slots = points_of(scene->window());
            ASSERT_EQ(problem->landmarks(), static_cast<int>(slots.size()));
            Stacked stacked(scene->window(), scene->calibration(), slots);
            EXPECT_NEAR(problem->linearise(*system) / stacked.cost(), 1.0, 1e-12);
            constexpr double kLambda = 1e-3;
            ASSERT_EQ(system->solve(kLambda, *step), Status::kOk);
            const std::vector<long double> x = stacked.dense().solve(static_cast<long double>(kLambda));
            ASSERT_FALSE(x.empty());
            EXPECT_LT(difference(*step, scene->window().frames.size(), x), 1e-9) << c.depth_m << " " << seed;
            outliers += stacked.outliers;
            edges += stacked.edges;
            ++checked;
        }
    }
    EXPECT_EQ(checked, 30);
    EXPECT_GT(outliers, 100) << "the robust kernel has something to do";
    EXPECT_GT(edges, 300);
}

TEST(ObjectProblem, CovarianceOfTheNewestStateIsTheBlockOfTheDenseInverse) {
    const auto system = std::make_unique<NormalEquations>();
    const auto problem = std::make_unique<ObjectProblem>();
    const auto scene = scene_of({ObjectClass::kCar, 6, 16, 0.4, 6.0, 14.0}, 5);
    ObjectWindow& window = scene->window();
    for (ObjectFrame& frame : window.frames) {
        for (FeatureObservation& o : frame.features) {
            o.stereo = o.valid;  // no point is singular by itself
        }
    }
    ObjectProblemOptions options;
    options.cues.ground = false;
    problem->begin(window, scene->calibration(), options);
    (void)problem->linearise(*system);
    Stacked stacked(window, scene->calibration(), points_of(window));
    const int last = window.frames.size() - 1;
    Mat6 covariance;
    ASSERT_EQ(system->covariance(last, covariance), Status::kOk);
    int checked = 0;
    for (int c = 0; c < 6; ++c) {
        const std::vector<long double> x = stacked.dense().inverse_column(6 * last + c);
        ASSERT_FALSE(x.empty());
        for (int r = 0; r < 6; ++r) {
            const double scale = std::sqrt(covariance(r, r) * covariance(c, c));
            EXPECT_NEAR(covariance(r, c) / scale,
                        static_cast<double>(x[static_cast<std::size_t>(6 * last + r)]) / scale, 1e-8);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 36);
}

TEST(ObjectProblem, PointsBehindTheCameraCostWhatACulledOneCostsAndPullAtNothing) {
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto problem = std::make_unique<ObjectProblem>();
    const auto scene = scene_of({ObjectClass::kCar, 4, 8, 0.2, 3.0, 12.0}, 2);
    ObjectWindow& window = scene->window();
    for (ObjectFrame& frame : window.frames) {
        frame.features[3].valid = true;
    }
    window.landmarks[3].f_o = Vec3(-60.0, 0.0, 0.0);
    ObjectProblemOptions options;
    options.cues.ground = false;
    problem->begin(window, scene->calibration(), options);
    const std::vector<int> slots = points_of(window);
    Stacked stacked(window, scene->calibration(), slots);
    ASSERT_EQ(stacked.behind, window.frames.size());
    EXPECT_NEAR(problem->linearise(*system) / stacked.cost(), 1.0, 1e-12);
    ASSERT_EQ(system->solve(1e-3, *step), Status::kOk);
    const auto at = std::find(slots.begin(), slots.end(), 3) - slots.begin();
    EXPECT_EQ(step->point[static_cast<std::size_t>(at)], Vec3(Vec3::Zero()));
}

TEST(ObjectProblem, ARefusedCandidateLeavesTheSystemOfTheCurrentState) {
    const auto system = std::make_unique<NormalEquations>();
    const auto step = std::make_unique<SolverStep>();
    const auto again = std::make_unique<SolverStep>();
    const auto problem = std::make_unique<ObjectProblem>();
    const auto scene = scene_of({ObjectClass::kCar, 6, 16, 0.4, 6.0, 14.0}, 6);
    ObjectProblemOptions options;
    options.cues.ground = false;
    problem->begin(scene->window(), scene->calibration(), options);
    const double cost = problem->linearise(*system);
    ASSERT_EQ(system->solve(1e-3, *step), Status::kOk);
    (void)problem->try_step(*step);  // not accepted
    EXPECT_EQ(problem->linearise(*system), cost);
    ASSERT_EQ(system->solve(1e-3, *again), Status::kOk);
    EXPECT_EQ(step->frame[5], again->frame[5]);
    // Accepted, the lanes of the candidate serve: the same as evaluating anew.
    const double candidate = problem->try_step(*step);
    problem->accept();
    const double kept = problem->linearise(*system);
    problem->set(ObjectVariables(problem->variables()));
    EXPECT_EQ(problem->linearise(*system), kept);
    EXPECT_NE(candidate, cost);
}

}  // namespace
}  // namespace semtrack
