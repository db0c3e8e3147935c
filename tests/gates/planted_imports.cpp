// A planted violation for the import gate: heap, exception and libm.
#include <cmath>
#include <cstdio>

double planted(double x) {
    double* volatile p = new double(x);
    if (*p > 10.0) { throw 1; }
    std::printf("%f", *p);
    const double y = std::sin(*p);
    delete p;
    return y;
}
