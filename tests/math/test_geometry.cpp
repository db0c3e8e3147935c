// Rotations, poses, the camera, and the 6x6 system.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/camera.hpp"
#include "math/cholesky6.hpp"
#include "math/pose.hpp"
#include "math/rng.hpp"
#include "math/so3.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

Vec3 random3(Rng& rng, double size) {
    return {size * (2.0 * rng.uniform() - 1.0), size * (2.0 * rng.uniform() - 1.0), size * (2.0 * rng.uniform() - 1.0)};
}

TEST(So3, LogarithmUndoesTheExponentialUpToPi) {
    Rng rng(1);
    for (int k = 0; k < 2000; ++k) {
        Vec3 w = random3(rng, 1.0);
        const double length = w.norm();
        for (const double angle : {1e-12, 1e-7, 1e-3, 0.5, 2.0, 3.1, kPi - 1e-6}) {
            const Vec3 v = w * (angle / length);
            EXPECT_LT((so3_log(so3_exp(v)) - v).norm(), 1e-8 * (1.0 + angle)) << angle;
        }
    }
}

TEST(So3, ExponentialIsARotation) {
    Rng rng(2);
    for (int k = 0; k < 1000; ++k) {
        const Mat3 R = so3_exp(random3(rng, 2.0));
        EXPECT_LT((R * R.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
    }
}

TEST(So3, HalfTurnsHaveALogarithm) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0.0, -0.8)}) {
        const Vec3 w = so3_log(so3_exp(axis * kPi));
        EXPECT_NEAR(w.norm(), kPi, 1e-7);
        EXPECT_NEAR(std::fabs(w.dot(axis)), kPi, 1e-7);
    }
}

TEST(So3, DriftedRotationIsMadeOneAgain) {
    Rng rng(3);
    for (int k = 0; k < 200; ++k) {
        const Mat3 R = so3_exp(random3(rng, 2.0));
        Mat3 off;
        off.col(0) = random3(rng, 1e-3);
        off.col(1) = random3(rng, 1e-3);
        off.col(2) = random3(rng, 1e-3);
        const Mat3 Q = orthonormalised(R + off);
        EXPECT_LT((Q * Q.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-9);
        EXPECT_LT((Q - R).cwiseAbs().maxCoeff(), 5e-3);
    }
}

TEST(Pose, ComposesLikeDominoesAndInverts) {
    Rng rng(4);
    for (int k = 0; k < 200; ++k) {
        const Pose T_a_b{so3_exp(random3(rng, 2.0)), random3(rng, 50.0)};
        const Pose T_b_c{so3_exp(random3(rng, 2.0)), random3(rng, 50.0)};
        const Vec3 x_c = random3(rng, 20.0);
        EXPECT_LT(((T_a_b * T_b_c) * x_c - T_a_b * (T_b_c * x_c)).norm(), 1e-12);
        EXPECT_LT((T_a_b.inverse() * (T_a_b * x_c) - x_c).norm(), 1e-12);
        const Pose back = to_pose(to_rigid_transform(T_a_b));
        EXPECT_EQ(back.R, T_a_b.R);
        EXPECT_EQ(back.t, T_a_b.t);
    }
}

TEST(Pose, NotFiniteIsSeen) {
    Pose T;
    EXPECT_TRUE(is_finite(T));
    T.R(1, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_finite(T));
    T = Pose{};
    T.t(0) = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(is_finite(T));
}

TEST(Camera, BearingTimesDepthProjectsBack) {
    const PinholeCamera camera{721.5, 719.0, 609.5, 172.8};
    for (const double u : {0.0, 300.25, 1241.0}) {
        for (const double z : {0.2, 5.0, 100.0}) {
            const Vec2 p = project(camera, bearing(camera, u, 77.0) * z);
            EXPECT_NEAR(p(0), u, 1e-10);
            EXPECT_NEAR(p(1), 77.0, 1e-10);
        }
    }
}

TEST(Camera, DisparityHonoursTheDifferenceOfThePrincipalPoints) {
    Calibration c;
    c.left = {700.0, 700.0, 600.0, 170.0};
    c.right = {700.0, 700.0, 590.0, 173.0};
    c.baseline_m = 0.5;
    c.row_offset = {-0.4, 0.001, 0.004};
    const double u_right = right_column(c, 640.0, 20.0);
    EXPECT_NEAR(u_right, 640.0 - 10.0 - 17.5, 1e-12);
    EXPECT_NEAR(depth_from_disparity(c, disparity(c, 640.0, u_right)), 20.0, 1e-12);
    EXPECT_NEAR(right_row(c, 270.0, 17.5), 270.0 + 3.0 - 0.4 + 0.1 + 0.07, 1e-12);
}

TEST(Cholesky6, SolvesAndInvertsRandomPositiveDefiniteSystems) {
    Rng rng(5);
    for (int k = 0; k < 500; ++k) {
        Mat6 J;
        Vec6 x;
        for (int i = 0; i < 6; ++i) {
            x(i) = rng.uniform() - 0.5;
            for (int j = 0; j < 6; ++j) {
                J(i, j) = rng.uniform() - 0.5;
            }
        }
        const Mat6 A = J.transpose() * J + 0.01 * Mat6::Identity();
        Vec6 solved;
        ASSERT_TRUE(solve6(A, A * x, solved));
        EXPECT_LT((solved - x).norm(), 1e-9);
        Mat6 inverse;
        ASSERT_TRUE(inverse6(A, inverse));
        EXPECT_LT((A * inverse - Mat6::Identity()).cwiseAbs().maxCoeff(), 1e-9);
    }
}

TEST(Cholesky6, SingularAndIndefiniteSystemsAreRefusedAndTheOutputStays) {
    Mat6 singular = Mat6::Identity();
    singular(3, 3) = 0.0;
    Mat6 indefinite = Mat6::Identity();
    indefinite(5, 5) = -1.0;
    Mat6 nan = Mat6::Identity();
    nan(0, 0) = std::numeric_limits<double>::quiet_NaN();
    for (const Mat6& A : {singular, indefinite, nan}) {
        Vec6 x = Vec6::Constant(7.0);
        EXPECT_FALSE(solve6(A, Vec6::Ones(), x));
        EXPECT_EQ(x(0), 7.0);
        Mat6 inverse;
        EXPECT_FALSE(inverse6(A, inverse));
    }
}

TEST(Rng, NeverStopsAndFillsItsRange) {
    for (const std::uint32_t seed : {0U, 1U, 0xFFFFFFFFU, 1597334677U}) {
        Rng rng(seed);
        double sum = 0.0;
        std::array<int, 7> hits{};
        for (int k = 0; k < 70000; ++k) {
            const double x = rng.uniform();
            ASSERT_TRUE(x >= 0.0 && x < 1.0);
            sum += x;
            ++hits[static_cast<std::size_t>(rng.below(7))];
        }
        EXPECT_NEAR(sum / 70000.0, 0.5, 0.01);
        for (const int h : hits) {
            EXPECT_NEAR(h, 10000, 600);
        }
    }
}

TEST(Rng, SameSeedSameNumbers) {
    Rng a(42);
    Rng b(42);
    Rng c(43);
    int equal = 0;
    for (int k = 0; k < 100; ++k) {
        const std::uint32_t x = a.next();
        EXPECT_EQ(x, b.next());
        equal += x == c.next() ? 1 : 0;
    }
    EXPECT_LT(equal, 3);
}

}  // namespace
}  // namespace semtrack
