// Two doubles at once: every operation is that of IEEE doubles, lane by lane, so the bits are those of a plain loop.
// What a target cannot do in one instruction its compiler does in two.
// MISRA deviation D-05: a vector type of the compilers; plain loops with many arrays are not vectorised by all of them.
#ifndef SEMTRACK_MATH_DOUBLE2_HPP
#define SEMTRACK_MATH_DOUBLE2_HPP

#include <cstring>

namespace semtrack {

/// Operators as for doubles; with a double, both lanes take it.
using Double2 = double __attribute__((vector_size(16)));
inline constexpr std::size_t kDouble2 = 2;

/// p: aligned to 16 bytes, here and below.
[[nodiscard]] inline Double2 load2(const double* p) {
    Double2 v;
    std::memcpy(&v, __builtin_assume_aligned(p, sizeof v), sizeof v);
    return v;
}
inline void store2(double* p, const Double2& v) {
    std::memcpy(__builtin_assume_aligned(p, sizeof v), &v, sizeof v);
}
inline void add2(double* p, const Double2& v) {
    store2(p, load2(p) + v);
}
[[nodiscard]] inline double sum2(const Double2& v) {
    return v[0] + v[1];
}

}  // namespace semtrack

#endif
