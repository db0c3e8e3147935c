#include "estimate/factor/stereo_point.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "support/jacobian_check.hpp"

namespace semtrack {
namespace {

Calibration pair_with_different_centres() {
    Calibration c;
    c.width = 1242;
    c.height = 375;
    c.left = {721.5, 721.5, 609.6, 172.9};
    c.right = {721.5, 721.5, 612.1, 172.9};
    c.baseline_m = 0.54;
    return c;
}

StereoPointMeasurement measured(const Calibration& c, const Vec3& x_c, bool stereo) {
    const Vec2 left = project(c.left, x_c);
    StereoPointMeasurement z;
    z.u = left(0) + 0.7;
    z.v = left(1) - 0.4;
    z.u_right = right_column(c, left(0), x_c(2)) + 0.3;
    z.sigma_px = 0.25;
    z.sigma_right_px = 0.35;
    z.stereo = stereo;
    return z;
}

TEST(StereoPoint, ResidualIsProjectionMinusMeasurementInSigmas) {
    const Calibration c = pair_with_different_centres();
    const Vec3 x_c(1.0, -0.5, 10.0);
    StereoPointResidual out;
    ASSERT_EQ(stereo_point_residual(c, x_c, measured(c, x_c, true), true, out), Status::kOk);
    EXPECT_NEAR(out.r(0), -0.7 / 0.25, 1e-9);
    EXPECT_NEAR(out.r(1), 0.4 / 0.25, 1e-9);
    EXPECT_NEAR(out.r(2), -0.3 / 0.35, 1e-9);
}

TEST(StereoPoint, ThePrincipalPointsDifferenceGoesIntoTheRightColumn) {
    const Calibration c = pair_with_different_centres();
    StereoPointMeasurement z;
    z.stereo = true;
    StereoPointResidual out;
    ASSERT_EQ(stereo_point_residual(c, Vec3(0.54, 0.0, 20.0), z, false, out), Status::kOk);
    EXPECT_NEAR(out.r(2), 612.1, 1e-9) << "straight ahead of the right camera";
}

TEST(StereoPoint, WithoutTheRightImageTheThirdRowSaysNothing) {
    const Calibration c = pair_with_different_centres();
    StereoPointMeasurement z = measured(c, Vec3(1.0, 0.0, 8.0), false);
    z.u_right = 0.0;
    StereoPointResidual out;
    ASSERT_EQ(stereo_point_residual(c, Vec3(1.0, 0.0, 8.0), z, true, out), Status::kOk);
    EXPECT_EQ(out.r(2), 0.0);
    EXPECT_EQ(out.J.row(2).cwiseAbs().maxCoeff(), 0.0);
}

TEST(StereoPoint, BehindTheCameraLeavesTheOutputUntouched) {
    const Calibration c = pair_with_different_centres();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const double depth : {kMinDepth_m - 1e-9, 0.0, -5.0, kNan}) {
        StereoPointResidual out;
        out.r.setConstant(7.0);
        out.J.setConstant(8.0);
        EXPECT_EQ(stereo_point_residual(c, Vec3(0.0, 0.0, depth), StereoPointMeasurement{}, true, out),
                  Status::kBehindCamera);
        EXPECT_EQ(out.r, Vec3(Vec3::Constant(7.0)));
        EXPECT_EQ(out.J, Mat3(Mat3::Constant(8.0)));
    }
    StereoPointResidual out;
    EXPECT_EQ(stereo_point_residual(c, Vec3(0.0, 0.0, kMinDepth_m), StereoPointMeasurement{}, true, out), Status::kOk);
}

TEST(StereoPoint, JacobiansMatchCentralDifferencesAcrossTheFrustum) {
    const Calibration c = pair_with_different_centres();
    const Pose T_c_w{so3_exp(Vec3(0.3, -2.9, 0.4)), Vec3(4.0, -1.0, 30.0)};
    const Pose T_w_c = T_c_w.inverse();
    int checked = 0;
    for (const double depth : {0.12, 1.0, 4.0, 20.0, 80.0, 400.0}) {
        for (const double u : {0.0, 620.0, 1241.0}) {
            for (const double v : {0.0, 170.0, 374.0}) {
                for (const bool stereo : {true, false}) {
                    const Vec3 x_c = bearing(c.left, u, v) * depth;
                    const Vec3 x_w = T_w_c * x_c;
                    const StereoPointMeasurement z = measured(c, x_c, stereo);
                    const auto at = [&](const Vec3& x) -> std::optional<Vec3> {
                        StereoPointResidual out;
                        return stereo_point_residual(c, x, z, false, out) == Status::kOk ? std::optional<Vec3>(out.r)
                                                                                         : std::nullopt;
                    };
                    StereoPointResidual out;
                    ASSERT_EQ(stereo_point_residual(c, x_c, z, true, out), Status::kOk);
                    const double step = 1e-6 * depth;
                    checked += test::expect_jacobian<3, 3>(
                                   out.J, [&](const Vec3& xi) { return at(x_c + xi); }, step)
                                   ? 1
                                   : 0;
                    checked += test::expect_jacobian<3, 3>(
                                   Mat3(out.J * T_c_w.R), [&](const Vec3& xi) { return at(T_c_w * (x_w + xi)); }, step)
                                   ? 1
                                   : 0;
                    checked += test::expect_jacobian<3, 6>(
                                   pose_jacobian(out.J, x_c),
                                   [&](const Vec6& xi) { return at(perturbed_left(T_c_w, xi) * x_w); }, step)
                                   ? 1
                                   : 0;
                }
            }
        }
    }
    EXPECT_EQ(checked, 6 * 3 * 3 * 2 * 3);
}

TEST(StereoPoint, JacobiansByAnObjectsStateAndPointMatchCentralDifferencesAcrossTheFrustum) {
    const Calibration c = pair_with_different_centres();
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    const Pose T_c_l{so3_exp(Vec3(0.02, -0.03, 0.01)) * R_c_l, Vec3(0.4, 1.6, -0.3)};
    const Vec3 f(1.9, -0.8, 0.6);
    using Vec7 = Eigen::Matrix<double, 7, 1>;  // p, theta, f
    int checked = 0;
    for (const double depth : {2.0, 5.0, 20.0, 60.0, 120.0}) {
        for (const double u : {0.0, 620.0, 1241.0}) {
            for (const double v : {0.0, 170.0, 374.0}) {
                for (const double theta : {-kPi, -1.6, 0.0, 0.7, kPi}) {
                    const Vec3 x_c = bearing(c.left, u, v) * depth;
                    const StereoPointMeasurement z = measured(c, x_c, true);
                    const Vec3 p = T_c_l.inverse() * x_c - rot_z(theta) * f;
                    const auto at = [&](const Vec7& d) -> std::optional<Vec3> {
                        StereoPointResidual out;
                        const Vec3 moved =
                            T_c_l * (p + d.head<3>() + rot_z(wrap_angle(theta + d(3))) * Vec3(f + d.tail<3>()));
                        return stereo_point_residual(c, moved, z, false, out) == Status::kOk
                                   ? std::optional<Vec3>(out.r)
                                   : std::nullopt;
                    };
                    StereoPointResidual out;
                    ASSERT_EQ(stereo_point_residual(c, x_c, z, true, out), Status::kOk);
                    Eigen::Matrix<double, 3, 7> J;
                    J.leftCols<3>() = out.J * T_c_l.R;
                    J.col(3) = out.J * (T_c_l.R * (rot_z(theta) * Vec3(-f(1), f(0), 0.0)));
                    J.rightCols<3>() = out.J * T_c_l.R * rot_z(theta);
                    checked += test::expect_jacobian<3, 7>(J, at, 1e-6 * depth) ? 1 : 0;
                }
            }
        }
    }
    EXPECT_EQ(checked, 5 * 3 * 3 * 5);
}

}  // namespace
}  // namespace semtrack
