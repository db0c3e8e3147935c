// Where a box stands, from exact projections.
#include "model/stand_point.hpp"

#include <gtest/gtest.h>

#include "math/so3.hpp"
#include "math/trig.hpp"

namespace semtrack {
namespace {

const PinholeCamera kCamera{700.0, 700.0, 620.0, 180.0};
const Vec3 kCar(3.9, 1.6, 1.5);
constexpr std::array<double, 4> kSigmas{2.0, 2.0, 1.5, 1.5};

Pose car_at(const Vec3& p, double theta) {
    Mat3 R_c_l;
    R_c_l << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return {R_c_l * rot_z(theta), p};
}

TEST(StandPoint, ExactBoxesGiveTheMiddleOfTheBottomFaceAtEveryHeading) {
    int checked = 0;
    for (int k = 0; k < 36; ++k) {
        for (const double z : {9.0, 20.0, 60.0}) {
            const Pose T = car_at(Vec3(0.1 * z, 0.9, z), -kPi + k * kPi / 18.0);
            Box2d box;
            ASSERT_EQ(projected_box(kCamera, T, kCar, box), Status::kOk);
            StandPoint out;
            ASSERT_EQ(stand_point(kCamera, box, kSigmas, T, kCar, 0.13, out), Status::kOk);
            EXPECT_NEAR((out.p_d - (T.t + Vec3(0.0, 0.75, 0.0))).norm(), 0.0, 1e-9 * z);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 108);
}

TEST(StandPoint, AnotherSizeMovesItAlongTheRayByAsMuchAsItsSigmaSays) {
    const Pose T = car_at(Vec3(1.0, 0.9, 20.0), 0.0);
    Box2d box;
    ASSERT_EQ(projected_box(kCamera, T, kCar, box), Status::kOk);
    StandPoint exact;
    StandPoint other;
    constexpr double kHeightSigma = 0.13;
    constexpr std::array<double, 4> kExact{1e-6, 1e-6, 1e-6, 1e-6};
    ASSERT_EQ(stand_point(kCamera, box, kExact, T, kCar, kHeightSigma, exact), Status::kOk);
    ASSERT_EQ(stand_point(kCamera, box, kExact, T, kCar + Vec3(0.0, 0.0, kHeightSigma), kHeightSigma, other),
              Status::kOk);
    EXPECT_NEAR(other.p_d(1) - exact.p_d(1), exact.sigma_m, 0.15 * exact.sigma_m);
}

TEST(StandPoint, ACutBoxStandsNowhere) {
    const Pose T = car_at(Vec3(1.0, 0.9, 20.0), 0.0);
    Box2d box;
    ASSERT_EQ(projected_box(kCamera, T, kCar, box), Status::kOk);
    for (std::size_t e = 0; e < 4; ++e) {
        std::array<double, 4> sigmas = kSigmas;
        sigmas[e] = 0.0;
        StandPoint out;
        EXPECT_EQ(stand_point(kCamera, box, sigmas, T, kCar, 0.13, out), Status::kNotObservable) << e;
    }
}

}  // namespace
}  // namespace semtrack
