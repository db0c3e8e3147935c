// The only place that includes Eigen. Fixed sizes, no vectorisation (bit-exact on every target), no heap, and a
// namespace of our own: a consumer that uses Eigen with other flags cannot replace our weak symbols by his.
#ifndef SEMTRACK_MATH_EIGEN_HPP
#define SEMTRACK_MATH_EIGEN_HPP

#ifdef __FAST_MATH__
#error "semtrack must not be compiled with -ffast-math: results would depend on the target"
#endif
#ifdef EIGEN_WORLD_VERSION
#error "include math/eigen.hpp instead of Eigen"
#endif

namespace semtrack::detail {
/// Stops the program: an index or a size broke its contract, or Eigen asked for the heap.
[[noreturn]] inline void eigen_assertion_failed() { __builtin_trap(); }
}  // namespace semtrack::detail

#define EIGEN_DONT_VECTORIZE
#define EIGEN_NO_MALLOC
#define EIGEN_NO_IO
#define EIGEN_MPL2_ONLY
#define eigen_assert(condition) ((condition) ? static_cast<void>(0) : ::semtrack::detail::eigen_assertion_failed())
#define Eigen semtrack_eigen

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif
#include <Eigen/Core>
#include <Eigen/LU>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace semtrack {

using Vec2 = Eigen::Matrix<double, 2, 1>;
using Vec3 = Eigen::Matrix<double, 3, 1>;
using Vec4 = Eigen::Matrix<double, 4, 1>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat2 = Eigen::Matrix<double, 2, 2>;
using Mat3 = Eigen::Matrix<double, 3, 3>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat2x3 = Eigen::Matrix<double, 2, 3>;
using Mat3x6 = Eigen::Matrix<double, 3, 6>;
using Mat6x3 = Eigen::Matrix<double, 6, 3>;

}  // namespace semtrack

#endif
