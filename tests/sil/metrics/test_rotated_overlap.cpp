#include "sil/metrics/rotated_overlap.hpp"

#include <gtest/gtest.h>

#include "math/rng.hpp"
#include "math/trig.hpp"
#include "rows.hpp"

namespace semtrack::sil {
namespace {

using test::car;

const Vec3 kPlace(3.0, 1.6, 20.0);

TEST(RotatedOverlap, ABoxOverlapsItselfWhollyAtEveryAngle) {
    for (int i = 0; i < 20000; ++i) {
        const double angle = i % 2 == 0 ? (i % 16) * kPi / 4.0 + (i % 5 - 2) * 1e-13 : -4.0 + 0.0004 * i;
        const ObjectRow a = car(0, 1, 0.0, Vec3(0.01 * i - 100.0, 1.6, 5.0 + 0.003 * i), angle);
        EXPECT_NEAR(birdseye_overlap(a, a), 1.0, 1e-12) << angle;
        EXPECT_NEAR(box3d_overlap(a, a), 1.0, 1e-12) << angle;
        ObjectRow turned = a;
        turned.rotation_y += kPi;
        EXPECT_NEAR(birdseye_overlap(a, turned), 1.0, 1e-12) << angle;
    }
}

TEST(RotatedOverlap, HalfALengthAlongAndAQuarterTurnBothLeaveAThird) {
    for (const double angle : {0.0, 0.3, kPi / 4.0, kPi / 2.0, -kPi, 3.1}) {
        const ObjectRow a = car(0, 1, 0.0, kPlace, angle);
        const SinCos s = sin_cos(angle);
        const ObjectRow moved = car(0, 1, 0.0, kPlace + 2.0 * Vec3(s.cos, 0.0, -s.sin), angle);
        const ObjectRow turned = car(0, 1, 0.0, kPlace, angle + kPi / 2.0);
        EXPECT_NEAR(birdseye_overlap(a, moved), 1.0 / 3.0, 1e-12) << angle;
        EXPECT_NEAR(birdseye_overlap(a, turned), 1.0 / 3.0, 1e-12) << angle;
        EXPECT_NEAR(box3d_overlap(moved, a), 1.0 / 3.0, 1e-12) << angle;
    }
}

TEST(RotatedOverlap, AnEighthTurnOfASquareLeavesItsOctagon) {
    ObjectRow a = car(0, 1, 0.0, kPlace);
    a.size_m = Vec3(2.0, 2.0, 1.0);
    ObjectRow b = a;
    b.rotation_y = kPi / 4.0;
    const double octagon = 8.0 * (1.4142135623730951 - 1.0);  // of a square of side 2
    EXPECT_NEAR(birdseye_overlap(a, b), octagon / (8.0 - octagon), 1e-12);
}

TEST(RotatedOverlap, BoxesThatTouchOrLieApartDoNotOverlap) {
    for (const double angle : {0.0, kPi / 4.0, 1.0}) {
        const SinCos s = sin_cos(angle);
        const ObjectRow a = car(0, 1, 0.0, kPlace, angle);
        EXPECT_NEAR(birdseye_overlap(a, car(0, 1, 0.0, kPlace + 4.0 * Vec3(s.cos, 0.0, -s.sin), angle)), 0.0, 1e-12);
        EXPECT_EQ(birdseye_overlap(a, car(0, 1, 0.0, kPlace + 30.0 * Vec3(s.cos, 0.0, -s.sin), angle)), 0.0);
    }
}

TEST(RotatedOverlap, ANanometreChangesNothing) {
    const ObjectRow a = car(0, 1, 0.0, kPlace, kPi / 4.0);
    EXPECT_NEAR(birdseye_overlap(a, car(0, 1, 0.0, kPlace + Vec3(1e-9, 0, 1e-9), kPi / 4.0)), 1.0, 1e-8);
}

TEST(RotatedOverlap, In3DTheCommonHeightCounts) {
    const ObjectRow a = car(0, 1, 0.0, kPlace);
    EXPECT_NEAR(box3d_overlap(a, car(0, 1, 0.0, kPlace + Vec3(0, 0.75, 0))), 1.0 / 3.0, 1e-12);
    EXPECT_EQ(box3d_overlap(a, car(0, 1, 0.0, kPlace + Vec3(0, 1.5, 0))), 0.0);
}

TEST(RotatedOverlap, AgreesWithCountedPointsOnRandomPairs) {
    Rng rng(5U);
    const auto uniform = [&rng](double from, double to) { return from + (to - from) * rng.uniform(); };
    for (int k = 0; k < 40; ++k) {
        ObjectRow a = car(0, 1, 0.0, kPlace, uniform(-3.0, 3.0));
        ObjectRow b = car(0, 1, 0.0, kPlace + Vec3(uniform(-2, 2), 0, uniform(-2, 2)), uniform(-3.0, 3.0));
        b.size_m = Vec3(uniform(1, 5), uniform(1, 3), 1.5);
        const Pose to_a = pose_of(a).inverse();
        const Pose to_b = pose_of(b).inverse();
        const auto inside = [](const ObjectRow& o, const Vec3& p) {
            return p(0) * p(0) <= 0.25 * o.size_m(0) * o.size_m(0) && p(2) * p(2) <= 0.25 * o.size_m(1) * o.size_m(1);
        };
        int both = 0;
        int either = 0;
        for (int i = 0; i < 40000; ++i) {
            const Vec3 p = kPlace + Vec3(-5.0 + 0.05 * (i % 200), 0.0, -5.0 + 0.05 * (i / 200));
            const bool in_a = inside(a, to_a * p);
            const bool in_b = inside(b, to_b * p);
            both += in_a && in_b ? 1 : 0;
            either += in_a || in_b ? 1 : 0;
        }
        EXPECT_NEAR(birdseye_overlap(a, b), static_cast<double>(both) / either, 0.02) << k;
        EXPECT_NEAR(birdseye_overlap(a, b), birdseye_overlap(b, a), 1e-12);
    }
}

}  // namespace
}  // namespace semtrack::sil
