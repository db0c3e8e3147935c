// Planted violations for the import gate: heap, exception, libm, and a weak function in Eigen's namespace.
#include <cmath>
#include <cstdio>

namespace Eigen {
template <class T>
[[gnu::noinline]] T planted(T x) {
    return x * x;
}
template double planted<double>(double);
}  // namespace Eigen

double planted(double x) {
    double* volatile p = new double(x);
    if (*p > 10.0) { throw 1; }
    std::printf("%f", *p);
    const double y = std::sin(*p);
    delete p;
    return y;
}
