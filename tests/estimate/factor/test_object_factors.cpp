// Terms of the object's cost: every Jacobian against central differences, hand-computed values, and the edges.
#include <gtest/gtest.h>

#include <cmath>

#include "estimate/factor/box_edges.hpp"
#include "estimate/factor/face_view.hpp"
#include "estimate/factor/ground.hpp"
#include "estimate/factor/motion.hpp"
#include "estimate/factor/size_prior.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/bicycle.hpp"
#include "model/class_prior.hpp"
#include "support/jacobian_check.hpp"
#include "support/noise.hpp"

namespace semtrack {
namespace {

const Vec3 kSize(3.9, 1.6, 1.5);

ObjectState plus(const ObjectState& x, const Vec6& d) {
    ObjectState y = x;
    y.p += d.head<3>();
    y.theta = wrap_angle(y.theta + d(3));
    y.v += d(4);
    y.delta += d(5);
    return y;
}

constexpr int kImageWidth = 1242;

DetectionView view_from(const Vec3& camera_l, double turn_rad) {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    const Mat3 R = R_c_l * rot_z(turn_rad) * so3_exp(Vec3(0.01, -0.02, 0.0));
    return {{720.0, 715.0, 610.0, 173.0}, {R, -(R * camera_l)}, kImageWidth};
}

BoxMeasurement box_of(double sigma_px) {
    BoxMeasurement box;
    box.valid = true;
    box.box = {400.0, 150.0, 700.0, 300.0};
    box.sigma_px = {sigma_px, sigma_px, 2.0 * sigma_px, sigma_px};
    return box;
}

TEST(BoxEdges, JacobiansMatchCentralDifferencesAtEveryHeadingAndDistanceAndWhereTheBorderCutsTheBox) {
    int checked = 0;
    int cut = 0;
    for (const double x : {4.0, 12.0, 60.0}) {
        for (const double y : {-4.0, 0.5, 5.0}) {
            for (int k = 0; k < 24; ++k) {
                const ObjectState state{Vec3(x + 3.0, y, -0.8), -kPi + k * kPi / 12.0, 5.0, 0.1};
                const DetectionView view = view_from(Vec3(1.0, 0.2, 0.1), 0.05);
                const BoxOutline outline =
                    box_outline(view.camera, view.width, view.T_d_l * Pose{rot_z(state.theta), state.p}, kSize);
                const BoxMeasurement box = box_of(1.7);
                EdgeResiduals out;
                box_edge_residuals(state, ObjectClass::kCar, kSize, view, outline, box, true, out);
                for (int e = 0; e < kBoxEdges; ++e) {
                    const auto i = static_cast<std::size_t>(e);
                    if (!out[i].valid) {
                        continue;
                    }
                    cut += outline[i].cut ? 1 : 0;
                    using Row6 = Eigen::Matrix<double, 1, 6>;
                    using Row3 = Eigen::Matrix<double, 1, 3>;
                    using One = Eigen::Matrix<double, 1, 1>;
                    const auto at = [&](const ObjectState& s, const Vec3& size) {
                        EdgeResiduals r;
                        box_edge_residuals(s, ObjectClass::kCar, size, view, outline, box, false, r);
                        return r[i].valid ? std::optional<One>(One(r[i].r)) : std::nullopt;
                    };
                    checked += test::expect_jacobian<1, 6>(Row6(out[i].J_state.transpose()),
                                                           [&](const Vec6& d) { return at(plus(state, d), kSize); })
                                   ? 1
                                   : 0;
                    checked += test::expect_jacobian<1, 3>(Row3(out[i].J_size.transpose()),
                                                           [&](const Vec3& d) { return at(state, kSize + d); })
                                   ? 1
                                   : 0;
                }
            }
        }
    }
    EXPECT_GE(checked, 3 * 3 * 24 * 8 * 8 / 10);
    EXPECT_GE(cut, 40);
}

TEST(BoxEdges, ResidualIsTheProjectionMinusTheEdgeInSigmas) {
    const ObjectState state{Vec3(20.0, 0.0, 0.0), 0.0, 0.0, 0.0};
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    const DetectionView view{{700.0, 700.0, 600.0, 170.0}, {R_c_l, Vec3::Zero()}, kImageWidth};
    const BoxOutline outline = box_outline(view.camera, view.width, {R_c_l, Vec3(0.0, 0.0, 20.0)}, Vec3(4.0, 2.0, 1.0));
    BoxMeasurement box = box_of(2.0);
    box.box.left = 600.0 - 700.0 / 18.0 - 4.0;  // the rear's left edge, at 18 m, is 4 px off
    EdgeResiduals out;
    box_edge_residuals(state, ObjectClass::kCar, Vec3(4.0, 2.0, 1.0), view, outline, box, false, out);
    ASSERT_TRUE(out[kLeft].valid);
    EXPECT_NEAR(out[kLeft].r, 2.0, 1e-12);
}

TEST(BoxEdges, BorderEdgesAndVerticesBehindTheCameraSayNothing) {
    const DetectionView view = view_from(Vec3::Zero(), 0.0);
    BoxMeasurement box = box_of(1.0);
    box.sigma_px[kRight] = 0.0;
    EdgeResiduals out;
    const ObjectState ahead{Vec3(15.0, 0.0, -0.8), 0.0, 0.0, 0.0};
    const BoxOutline outline =
        box_outline(view.camera, view.width, view.T_d_l * Pose{rot_z(ahead.theta), ahead.p}, kSize);
    box_edge_residuals(ahead, ObjectClass::kCar, kSize, view, outline, box, true, out);
    EXPECT_TRUE(out[kLeft].valid);
    EXPECT_FALSE(out[kRight].valid);
    box_edge_residuals({Vec3(-15.0, 0.0, -0.8), 0.0, 0.0, 0.0}, ObjectClass::kCar, kSize, view, outline, box, true,
                       out);
    for (const EdgeResidual& r : out) {
        EXPECT_FALSE(r.valid);
    }
}

TEST(Motion, JacobiansMatchCentralDifferencesForEveryModel) {
    Rng rng(11);
    int checked = 0;
    for (int k = 0; k < 200; ++k) {
        MotionModelSpec spec;
        spec.model = k % 3 == 0 ? MotionModel::kPedestrian : MotionModel::kVehicle;
        spec.standing = k % 5 == 0;
        const double dt_s = k % 2 == 0 ? 0.1 : 0.4;
        const ObjectState before{Vec3(between(rng, -20, 60), between(rng, -10, 10), between(rng, -2, 1)),
                                 between(rng, -kPi, kPi), between(rng, -8, 30), between(rng, -0.6, 0.6)};
        Vec6 off;
        off << between(rng, -1, 1), between(rng, -1, 1), 0.1, between(rng, -0.3, 0.3), between(rng, -2, 2), 0.05;
        const ObjectState after = plus(predicted_state(before, ObjectClass::kCar, kSize, dt_s), off);
        Vec6 r;
        Mat6 J_before;
        Mat6 J_after;
        motion_residual(before, after, dt_s, spec, true, r, J_before, J_after);
        const auto at = [&](const ObjectState& a, const ObjectState& b) {
            Vec6 out;
            Mat6 unused_a;
            Mat6 unused_b;
            motion_residual(a, b, dt_s, spec, false, out, unused_a, unused_b);
            return std::optional<Vec6>(out);
        };
        checked +=
            test::expect_jacobian<6, 6>(J_before, [&](const Vec6& d) { return at(plus(before, d), after); }) ? 1 : 0;
        checked +=
            test::expect_jacobian<6, 6>(J_after, [&](const Vec6& d) { return at(before, plus(after, d)); }) ? 1 : 0;
    }
    EXPECT_EQ(checked, 400);
}

TEST(Motion, JacobiansMatchAtTheEdgesOfEveryKindOfMotion) {
    int checked = 0;
    for (const double theta : {-kPi, -0.5 * kPi, 0.0, 0.5 * kPi, kPi}) {
        for (const double v : {-6.0, 0.0, 1e-3, 15.0, 40.0}) {
            for (const double delta : {-0.65, 0.0, 0.65}) {
                for (const bool standing : {false, true}) {
                    for (const MotionModel model : {MotionModel::kVehicle, MotionModel::kPedestrian}) {
                        MotionModelSpec spec;
                        spec.model = model;
                        spec.standing = standing;
                        const ObjectState before{Vec3(20.0, -3.0, -0.9), theta, v, delta};
                        Vec6 off;
                        off << 0.2, -0.1, 0.05, 0.04, -0.3, 0.02;
                        const ObjectState after = plus(bicycle_step(before, spec.wheelbase_m, 0.1), off);
                        Vec6 r;
                        Mat6 J_before;
                        Mat6 J_after;
                        motion_residual(before, after, 0.1, spec, true, r, J_before, J_after);
                        EXPECT_EQ(Mat6(J_after.diagonal().asDiagonal()), J_after) << "the solver relies on it";
                        const auto at = [&](const Vec6& d) {
                            Vec6 out;
                            Mat6 unused_a;
                            Mat6 unused_b;
                            motion_residual(plus(before, d), after, 0.1, spec, false, out, unused_a, unused_b);
                            return std::optional<Vec6>(out);
                        };
                        checked += test::expect_jacobian<6, 6>(J_before, at) ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_EQ(checked, 5 * 5 * 3 * 2 * 2);
}

TEST(Motion, ExactStepHasNoResidualAndHeadingsMeetAcrossPi) {
    MotionModelSpec spec;
    const ObjectState before{Vec3(10.0, 0.0, 0.0), kPi - 0.01, 8.0, 0.2};
    const ObjectState after = bicycle_step(before, spec.wheelbase_m, 0.1);
    EXPECT_LT(wrap_angle(after.theta), 0.0) << "the case crosses pi";
    Vec6 r;
    Mat6 unused_a;
    Mat6 unused_b;
    motion_residual(before, plus(after, Vec6::Zero()), 0.1, spec, false, r, unused_a, unused_b);
    EXPECT_LT(r.norm(), 1e-9);
}

TEST(Motion, ResidualIsInSigmasOfTheStep) {
    MotionModelSpec spec;
    const ObjectState before{Vec3(10.0, 0.0, 0.0), 0.0, 5.0, 0.0};
    ObjectState after = bicycle_step(before, spec.wheelbase_m, 0.4);
    after.v += 2.0 * spec.noise.speed * std::sqrt(0.4);
    Vec6 r;
    Mat6 unused_a;
    Mat6 unused_b;
    motion_residual(before, after, 0.4, spec, false, r, unused_a, unused_b);
    EXPECT_NEAR(r(4), 2.0, 1e-12);
}

TEST(SizePrior, CostIsZeroAtTheMeanAndItsGradientIsThatOfTheContract) {
    for (int c = 0; c < kObjectClasses; ++c) {
        const SizePrior prior = size_prior(static_cast<ObjectClass>(c));
        EXPECT_EQ(size_prior_cost(prior, prior.mean_m), 0.0);
        EXPECT_EQ(prior.mean_m, class_prior(static_cast<ObjectClass>(c)).size_m);
        const Vec3 d = prior.mean_m + Vec3(0.3, -0.1, 0.2);
        const Vec3 gradient = 2.0 * (prior.information * (d - prior.mean_m));
        for (int i = 0; i < 3; ++i) {
            Vec3 h = Vec3::Zero();
            h(i) = 1e-6;
            EXPECT_NEAR((size_prior_cost(prior, d + h) - size_prior_cost(prior, d - h)) / 2e-6, gradient(i),
                        1e-5 * (1.0 + std::fabs(gradient(i))));
        }
    }
}

TEST(SizePrior, LongAndWideTogetherIsLikelierThanLongAndNarrow) {
    const SizePrior prior = size_prior(ObjectClass::kCar);
    EXPECT_LT(size_prior_cost(prior, prior.mean_m + Vec3(0.35, 0.12, 0.0)),
              size_prior_cost(prior, prior.mean_m + Vec3(0.35, -0.12, 0.0)));
}

TEST(FaceView, ASideThatTheClassNamesIsMissedByItsAngleAndOneThatIsSeenCostsNothing) {
    // Heading away from the camera and 1 m to its left: the camera is 0.2 m outside the right side's plane.
    const ObjectState x{Vec3(20.0, 1.0, 0.0), 0.0, 0.0, 0.0};
    const Vec3 camera = Vec3::Zero();
    EXPECT_EQ(face_view_residual(x, 1.6, camera, 7, 0.05).r, 0.0);
    const double range = std::sqrt(401.0);
    EXPECT_NEAR(face_view_residual(x, 1.6, camera, 5, 0.05).r, 1.8 / (range * 0.05), 1e-12);
    for (const int whole_face : {-1, 0, 2, 4, 6}) {
        EXPECT_EQ(face_view_residual(x, 1.6, camera, whole_face, 0.05).r, 0.0);
    }
    EXPECT_EQ(face_view_residual(x, 1.6, x.p, 5, 0.05).r, 0.0);  // inside the car
}

TEST(FaceView, JacobiansMatchCentralDifferencesAtEveryHeading) {
    const Vec3 camera(1.0, 0.2, 0.1);
    constexpr double kStep = 1e-6;
    int checked = 0;
    for (int k = 0; k < 24; ++k) {
        for (const int view : {1, 3, 5, 7}) {
            const ObjectState x{Vec3(15.0, -3.0, -0.8), -kPi + 0.01 + k * kPi / 12.0, 0.0, 0.0};
            const auto r = [&](const ObjectState& y, double width) {
                return face_view_residual(y, width, camera, view, 0.05).r;
            };
            const FaceViewResidual at = face_view_residual(x, 1.6, camera, view, 0.05);
            if (!(at.r > 0.0)) {
                continue;
            }
            ++checked;
            for (int i = 0; i < 4; ++i) {
                Vec6 d = Vec6::Zero();
                d(i) = kStep;
                const double numeric = (r(plus(x, d), 1.6) - r(plus(x, -d), 1.6)) / (2.0 * kStep);
                EXPECT_NEAR(i < 3 ? at.J_p(i) : at.J_theta, numeric, 1e-6) << "heading " << x.theta << ", " << i;
            }
            EXPECT_NEAR(at.J_width, (r(x, 1.6 + kStep) - r(x, 1.6 - kStep)) / (2.0 * kStep), 1e-6);
        }
    }
    EXPECT_GT(checked, 40);
}

TEST(Ground, DerivativesMatchCentralDifferencesAndSigmaGrowsWithDistance) {
    const GroundPlane prior{true, 1.65, 0.02, -0.01, Mat3(Vec3(0.001, 1e-4, 1e-3).asDiagonal())};
    const DetectionView view = view_from(Vec3(2.0, -1.0, 0.3), 0.1);
    double last_weight = 1e9;
    for (const double x : {5.0, 20.0, 80.0}) {
        const ObjectState state{Vec3(x, 3.0, -0.6), 0.3, 0.0, 0.0};
        const GroundResidual g = ground_residual(state, 1.5, view.T_d_l, prior);
        ObjectState up = state;
        ObjectState down = state;
        up.p(2) += 1e-6;
        down.p(2) -= 1e-6;
        EXPECT_NEAR(
            (ground_residual(up, 1.5, view.T_d_l, prior).r - ground_residual(down, 1.5, view.T_d_l, prior).r) / 2e-6,
            g.J_p(2), 1e-6);
        EXPECT_NEAR((ground_residual(state, 1.5 + 1e-6, view.T_d_l, prior).r -
                     ground_residual(state, 1.5 - 1e-6, view.T_d_l, prior).r) /
                        2e-6,
                    g.J_height, 1e-6);
        EXPECT_LT(g.J_p(2), last_weight);
        last_weight = g.J_p(2);
    }
}

TEST(Ground, BoxThatStandsOnTheRoadHasNoResidual) {
    const GroundPlane prior{true, 1.65, 0.0, 0.0, Mat3(Mat3::Zero())};
    const DetectionView view = view_from(Vec3(0.0, 0.0, 0.4), 0.0);
    const ObjectState state{Vec3(20.0, 0.0, 0.4 - 1.65 + 0.75), 0.0, 0.0, 0.0};
    EXPECT_NEAR(ground_residual(state, 1.5, view.T_d_l, prior).r, 0.0, 1e-9);
}

}  // namespace
}  // namespace semtrack
