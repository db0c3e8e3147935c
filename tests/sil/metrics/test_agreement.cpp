#include "sil/metrics/agreement.hpp"

#include <gtest/gtest.h>

namespace semtrack::sil {
namespace {

// 1 m a frame ahead, with an error along x in every step: +e, -e, +e, ...; each in an own rhythm, so that no two agree.
Trajectory path(double error, int rhythm) {
    Trajectory out;
    double x = 0.0;
    for (int n = 0; n < 65; ++n) {
        out[n] = {Mat3::Identity(), Vec3(x, 0.0, n)};
        x += (n / rhythm) % 2 == 0 ? error : -error;
    }
    return out;
}

TEST(Agreement, ThreeTrajectoriesTellEachOnesOwnError) {
    const Trajectory a = path(0.003, 1);
    const Trajectory b = path(0.01, 2);
    const Trajectory c = path(0.004, 4);
    EXPECT_NEAR(*compare_with_others(a, {b, c}).own_error_rms_m, 0.003, 1e-12);
    EXPECT_NEAR(*compare_with_others(b, {c, a}).own_error_rms_m, 0.01, 1e-12);
    EXPECT_NEAR(*compare_with_others(c, {a, b}).own_error_rms_m, 0.004, 1e-12);
}

TEST(Agreement, DifferencesAreThoseOfAComparisonWithATruth) {
    const Agreement agreement = compare_with_others(path(0.0, 1), {path(0.02, 1)});
    ASSERT_EQ(agreement.with.size(), 1U);
    EXPECT_NEAR(*agreement.with[0].rpe_trans_mean_m, 0.02, 1e-12);
    EXPECT_NEAR(*agreement.with[0].rpe_trans_rms_m, 0.02, 1e-12);
    EXPECT_FALSE(agreement.own_error_rms_m.has_value());
}

TEST(Agreement, ErrorsThatAreNotIndependentMayLeaveNothingToSay) {
    const Trajectory middle = path(0.0, 1);  // halfway between two that err against each other
    EXPECT_FALSE(compare_with_others(middle, {path(0.01, 1), path(-0.01, 1)}).own_error_rms_m.has_value());
    EXPECT_FALSE(compare_with_others(middle, {}).own_error_rms_m.has_value());
    EXPECT_FALSE(compare_with_others(middle, {path(0.01, 1), {}}).own_error_rms_m.has_value());
}

}  // namespace
}  // namespace semtrack::sil
