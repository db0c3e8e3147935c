// Solution and inverse of a symmetric positive definite 6x6 system.
#ifndef SEMTRACK_MATH_CHOLESKY6_HPP
#define SEMTRACK_MATH_CHOLESKY6_HPP

#include "math/eigen.hpp"

namespace semtrack {

/// A x = b. false: not positive definite (pivots below 1e-13 of the diagonal); x is untouched.
[[nodiscard]] bool solve6(const Mat6& A, const Vec6& b, Vec6& x);
[[nodiscard]] bool inverse6(const Mat6& A, Mat6& out);

}  // namespace semtrack

#endif
