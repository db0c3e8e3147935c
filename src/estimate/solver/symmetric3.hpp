// Inverse of a symmetric positive definite 3x3 matrix by cofactors: the block of one point.
#ifndef SEMTRACK_ESTIMATE_SOLVER_SYMMETRIC3_HPP
#define SEMTRACK_ESTIMATE_SOLVER_SYMMETRIC3_HPP

#include "math/eigen.hpp"

namespace semtrack {

/// false: not positive definite to rounding; out is untouched.
[[nodiscard]] inline bool inverse_symmetric3(const Mat3& A, Mat3& out) {
    const double a = A(1, 1) * A(2, 2) - A(1, 2) * A(1, 2);
    const double b = A(0, 2) * A(1, 2) - A(0, 1) * A(2, 2);
    const double c = A(0, 1) * A(1, 2) - A(0, 2) * A(1, 1);
    const double determinant = A(0, 0) * a + A(0, 1) * b + A(0, 2) * c;
    const double scale = A(0, 0) * A(1, 1) * A(2, 2);
    if (!(A(0, 0) > 0.0) || !(A(1, 1) > 0.0) || !(A(2, 2) > 0.0) || !(determinant > 1e-14 * scale)) {
        return false;
    }
    const double d = A(0, 0) * A(2, 2) - A(0, 2) * A(0, 2);
    const double e = A(0, 1) * A(0, 2) - A(0, 0) * A(1, 2);
    const double f = A(0, 0) * A(1, 1) - A(0, 1) * A(0, 1);
    const double s = 1.0 / determinant;
    out << s * a, s * b, s * c, s * b, s * d, s * e, s * c, s * e, s * f;
    return true;
}

}  // namespace semtrack

#endif
