// One road user before a moving camera: what detector and matcher would say of it, and its true states.
#ifndef SEMTRACK_TESTS_ESTIMATE_OBJECT_OBJECT_SCENE_HPP
#define SEMTRACK_TESTS_ESTIMATE_OBJECT_OBJECT_SCENE_HPP

#include <cmath>
#include <memory>
#include <vector>

#include "math/so3.hpp"
#include "model/bicycle.hpp"
#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"
#include "model/object_window.hpp"
#include "support/noise.hpp"

namespace semtrack {

struct ObjectSceneOptions {
    ObjectClass object_class{ObjectClass::kCar};
    ObjectState start{Vec3(20.0, 3.0, -0.9), 0.0, 0.0, 0.0};
    Vec3 size_m{4.1, 1.65, 1.48};
    double ego_step_m{0.5};
    double edge_noise_px{1.0};
    double feature_noise_px{0.25};
    int features{40};
    int outliers{0};          ///< of the features: on the wall behind
    bool transparent{false};  ///< faces that look away are seen too
    std::uint32_t seed{1};
};

/// L is the world: x forward, y left, z up, the camera's first place is its origin.
class ObjectScene {
public:
    static constexpr double kDt_s = 0.1;

    explicit ObjectScene(const ObjectSceneOptions& options)
        : options_(options), rng_(options.seed), truth_(options.start), window_(std::make_unique<ObjectWindow>()) {
        calibration_.width = 1242;
        calibration_.height = 375;
        calibration_.left = {720.0, 720.0, 610.0, 173.0};
        calibration_.right = calibration_.left;
        calibration_.detection = calibration_.left;
        calibration_.baseline_m = 0.54;
        window_->object_class = options.object_class;
        const ClassPrior& prior = class_prior(options.object_class);
        window_->size_m = prior.size_m;
        window_->prior_size_m = prior.size_m;
        window_->size_covariance = prior.size_sigma_m.cwiseProduct(prior.size_sigma_m).asDiagonal();
        window_->prior_size_covariance = window_->size_covariance;
        for (int i = 0; i < options.features; ++i) {
            points_o_.push_back(surface_point());
        }
    }

    [[nodiscard]] const Calibration& calibration() const { return calibration_; }
    [[nodiscard]] ObjectWindow& window() { return *window_; }
    [[nodiscard]] const ObjectWindow& window() const { return *window_; }
    [[nodiscard]] const ObjectState& truth() const { return truth_; }
    void drive_on(double speed) { truth_.v = speed; }

    /// A new frame in the window: a prediction (the start is off by a metre and a fifth of a radian) and measurements.
    void next() {
        ObjectFrame frame;
        frame.frame = ++number_;
        frame.time_us = 100000 * static_cast<std::int64_t>(number_);
        if (number_ == 1) {
            frame.state = truth_;
            frame.state.p += Vec3(1.0, 0.3, 0.0);
            frame.state.theta += 0.2;
            frame.state.v = frame.state.delta = 0.0;
        } else {
            const double wheelbase = class_prior(options_.object_class).wheelbase_ratio * options_.size_m(0);
            truth_ = options_.object_class == ObjectClass::kPedestrian
                         ? predicted_state(truth_, options_.object_class, options_.size_m, kDt_s)
                         : bicycle_step(truth_, wheelbase, kDt_s);
            frame.state = predicted_state(window_->newest().state, options_.object_class, window_->size_m, kDt_s);
            camera_l_ += Vec3(options_.ego_step_m, 0.0, 0.0);
        }
        Mat3 R_c_l;
        R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
        frame.T_c_l = {R_c_l, -(R_c_l * camera_l_)};
        measure_box(frame);
        measure_features(frame);
        thin_out(*window_);
        (void)window_->frames.try_push_back(frame);
    }

private:
    [[nodiscard]] bool has_heading() const { return class_prior(options_.object_class).has_heading; }
    [[nodiscard]] Pose T_l_o() const {
        return {has_heading() ? rot_z(truth_.theta) : Mat3(Mat3::Identity()), truth_.p};
    }

    Vec3 surface_point() {
        const Vec3 half = 0.5 * options_.size_m;
        Vec3 x;  // one draw a statement: the order of arguments is the compiler's
        x(2) = between(rng_, -0.8, 0.8);
        x(1) = between(rng_, -1.0, 1.0);
        x(0) = between(rng_, -1.0, 1.0);
        const int face = rng_.below(4);
        x(face / 2) = face % 2 == 0 ? 1.0 : -1.0;
        return x.cwiseProduct(half);
    }

    void measure_box(ObjectFrame& frame) {
        Box2d box;
        if (projected_box(calibration_.left, frame.T_c_l * T_l_o(), options_.size_m, box) != Status::kOk) {
            return;
        }
        const double sigma = 2.0 * options_.edge_noise_px;
        frame.box.valid = true;
        frame.box.box = {
            box.left + options_.edge_noise_px * normal(rng_), box.top + options_.edge_noise_px * normal(rng_),
            box.right + options_.edge_noise_px * normal(rng_), box.bottom + options_.edge_noise_px * normal(rng_)};
        frame.box.sigma_px = {sigma, sigma, sigma, sigma};
        frame.box.score = 0.9;
        if (has_heading()) {
            frame.box.viewpoint = visible_faces(frame.T_c_l * T_l_o(), options_.size_m);
        }
    }

    /// Points of the faces that look at the camera.
    void measure_features(ObjectFrame& frame) {
        const Pose T_c_o = frame.T_c_l * T_l_o();
        const Vec3 camera_o = T_c_o.inverse().t;
        for (int i = 0; i < options_.features; ++i) {
            const auto slot = static_cast<std::size_t>(i);
            window_->landmarks[slot].id = static_cast<std::uint32_t>(i) + 1U;
            const Vec3& x_o = points_o_[slot];
            const bool outlier = i < options_.outliers;
            const Vec3 half = 0.5 * options_.size_m;
            bool facing = outlier || options_.transparent;
            for (int axis = 0; axis < 2; ++axis) {
                facing = facing || (std::fabs(x_o(axis)) > half(axis) - 1e-9 && x_o(axis) * camera_o(axis) > 0.0 &&
                                    std::fabs(camera_o(axis)) > half(axis));
            }
            if (!facing) {
                continue;
            }
            // An outlier stands still in the world, some metres behind the object's first place.
            const Vec3 x_c = outlier ? Vec3(frame.T_c_l * Vec3(options_.start.p + Vec3(6.0, 0.4 * i - 1.0, 0.3)))
                                     : Vec3(T_c_o * x_o);
            if (x_c(2) < 1.0) {
                continue;
            }
            const Vec2 p = project(calibration_.left, x_c);
            const double n = options_.feature_noise_px;
            FeatureObservation& o = frame.features[slot];
            o.valid = true;
            o.stereo = true;
            o.u = static_cast<float>(p(0) + n * normal(rng_));
            o.v = static_cast<float>(p(1) + n * normal(rng_));
            o.u_right = static_cast<float>(right_column(calibration_, p(0), x_c(2)) + n * normal(rng_));
            o.sigma_px = 0.25F;
            o.sigma_right_px = 0.35F;
        }
    }

    ObjectSceneOptions options_;
    Rng rng_;
    ObjectState truth_;
    Calibration calibration_{};
    std::unique_ptr<ObjectWindow> window_;
    std::vector<Vec3> points_o_;
    Vec3 camera_l_{Vec3::Zero()};
    std::uint32_t number_{0};
};

}  // namespace semtrack

#endif
