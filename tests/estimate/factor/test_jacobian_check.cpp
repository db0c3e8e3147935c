// The checker of all Jacobians is checked itself: planted errors must fail.
#include "support/jacobian_check.hpp"

#include <gtest/gtest-spi.h>

#include "math/pose.hpp"
#include "math/so3.hpp"

namespace semtrack {
namespace {

std::optional<Vec3> turned(const Vec6& xi) {
    return perturbed_left(Pose{}, xi) * Vec3(1.0, 2.0, 3.0);
}

Mat3x6 right_jacobian() {
    Mat3x6 J;
    J.leftCols<3>() = Mat3::Identity();
    J.rightCols<3>() = -skew(Vec3(1.0, 2.0, 3.0));
    return J;
}

TEST(JacobianCheck, ARightJacobianPasses) {
    EXPECT_TRUE((test::expect_jacobian<3, 6>(right_jacobian(), turned)));
}

TEST(JacobianCheck, APlantedSignErrorFails) {
    EXPECT_NONFATAL_FAILURE(
        {
            Mat3x6 J = right_jacobian();
            J(0, 4) = -J(0, 4);
            EXPECT_FALSE((test::expect_jacobian<3, 6>(J, turned)));
        },
        "row 0 column 4");
}

TEST(JacobianCheck, AResidualThatIsNotDefinedIsNotCounted) {
    const auto nothing = [](const Vec6&) { return std::optional<Vec3>(); };
    EXPECT_FALSE((test::expect_jacobian<3, 6>(right_jacobian(), nothing)));
}

}  // namespace
}  // namespace semtrack
