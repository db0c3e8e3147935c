#include "math/cholesky6.hpp"

#include <cmath>

namespace semtrack {

namespace {

/// Lower factor L with A = L L^T.
bool factor(const Mat6& A, Mat6& L) {
    L.setZero();
    for (int c = 0; c < 6; ++c) {
        double d = A(c, c);
        for (int k = 0; k < c; ++k) {
            d -= L(c, k) * L(c, k);
        }
        if (!(d > 1e-13 * std::fabs(A(c, c)))) {
            return false;
        }
        L(c, c) = std::sqrt(d);
        for (int r = c + 1; r < 6; ++r) {
            double s = A(r, c);
            for (int k = 0; k < c; ++k) {
                s -= L(r, k) * L(c, k);
            }
            L(r, c) = s / L(c, c);
        }
    }
    return true;
}

Vec6 substitute(const Mat6& L, const Vec6& b) {
    Vec6 x = b;
    for (int r = 0; r < 6; ++r) {
        for (int k = 0; k < r; ++k) {
            x(r) -= L(r, k) * x(k);
        }
        x(r) /= L(r, r);
    }
    for (int r = 5; r >= 0; --r) {
        for (int k = r + 1; k < 6; ++k) {
            x(r) -= L(k, r) * x(k);
        }
        x(r) /= L(r, r);
    }
    return x;
}

}  // namespace

bool solve6(const Mat6& A, const Vec6& b, Vec6& x) {
    Mat6 L;
    if (!factor(A, L)) {
        return false;
    }
    x = substitute(L, b);
    return true;
}

bool inverse6(const Mat6& A, Mat6& out) {
    Mat6 L;
    if (!factor(A, L)) {
        return false;
    }
    for (int c = 0; c < 6; ++c) {
        out.col(c) = substitute(L, Vec6(Mat6::Identity().col(c)));
    }
    return true;
}

}  // namespace semtrack
