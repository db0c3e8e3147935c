#include "front/ransac/fundamental.hpp"

#include <cmath>

namespace semtrack {

namespace {

constexpr int kUnknowns = 9;
constexpr int kEquations = 7;
constexpr double kSingular = 1e-9;  // pivots, relative to equations of order 1
using Row = std::array<double, kUnknowns>;
using Equations = std::array<Row, kEquations>;
using Symmetric = std::array<Row, kUnknowns>;

constexpr std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

Row equation(const ImagePairs& pairs, int i) {
    const auto px = static_cast<double>(pairs.px[at(i)]);
    const auto py = static_cast<double>(pairs.py[at(i)]);
    const auto qx = static_cast<double>(pairs.qx[at(i)]);
    const auto qy = static_cast<double>(pairs.qy[at(i)]);
    return {qx * px, qx * py, qx, qy * px, qy * py, qy, px, py, 1.0};
}

bool normalise(Fundamental& f) {
    double sum = 0;
    for (const double x : f) {
        sum += x * x;
    }
    if (!(sum > 1e-300) || !std::isfinite(sum)) {
        return false;
    }
    const double scale = 1.0 / std::sqrt(sum);
    for (double& x : f) {
        x *= scale;
    }
    return true;
}

// Gauss-Jordan with full pivoting: afterwards column[k] of equation k is 1 and 0 in all others.
bool eliminate(Equations& a, std::array<int, kUnknowns>& column) {
    for (int c = 0; c < kUnknowns; ++c) {
        column[at(c)] = c;
    }
    for (int k = 0; k < kEquations; ++k) {
        int best_row = k;
        int best_col = k;
        double best = -1;
        for (int r = k; r < kEquations; ++r) {
            for (int c = k; c < kUnknowns; ++c) {
                const double size = std::fabs(a[at(r)][at(column[at(c)])]);
                if (size > best) {
                    best = size;
                    best_row = r;
                    best_col = c;
                }
            }
        }
        if (!(best > kSingular)) {
            return false;
        }
        const Row swapped = a[at(k)];
        a[at(k)] = a[at(best_row)];
        a[at(best_row)] = swapped;
        const int swapped_column = column[at(k)];
        column[at(k)] = column[at(best_col)];
        column[at(best_col)] = swapped_column;
        Row& pivot = a[at(k)];
        const double inverse = 1.0 / pivot[at(column[at(k)])];
        for (double& x : pivot) {
            x *= inverse;
        }
        for (int r = 0; r < kEquations; ++r) {
            const double factor = a[at(r)][at(column[at(k)])];
            if (r != k) {
                for (std::size_t c = 0; c < kUnknowns; ++c) {
                    a[at(r)][c] -= factor * pivot[c];
                }
            }
        }
    }
    return true;
}

double determinant(const Fundamental& a, const Fundamental& b, const Fundamental& c) {  // rows 0, 1, 2 of each
    return a[0] * (b[4] * c[8] - b[5] * c[7]) - a[1] * (b[3] * c[8] - b[5] * c[6]) + a[2] * (b[3] * c[7] - b[4] * c[6]);
}

// c[0] + c[1] x + c[2] x^2 + c[3] x^3; roots only from + - * / sqrt.
int solve_cubic(const std::array<double, 4>& c, std::array<double, 3>& root) {
    double largest = 0;
    for (const double x : c) {
        largest = std::fabs(x) > largest ? std::fabs(x) : largest;
    }
    if (!(largest > 0) || !std::isfinite(largest)) {
        return 0;
    }
    int count = 0;
    double a = c[3];  // of the quadratic a x^2 + b x + d that is left
    double b = c[2];
    double d = c[1];
    if (std::fabs(c[3]) > 1e-12 * largest) {
        double low = -(1.0 + largest / std::fabs(c[3]));  // Cauchy's bound: the sign differs at both ends
        double high = -low;
        for (int k = 0; k < 64; ++k) {
            const double x = 0.5 * (low + high);
            const double y = ((c[3] * x + c[2]) * x + c[1]) * x + c[0];
            const bool beyond = (y > 0) == (c[3] > 0);
            low = beyond ? low : x;
            high = beyond ? x : high;
        }
        const double x = 0.5 * (low + high);
        root[at(count++)] = x;
        b = c[2] + a * x;  // deflated
        d = c[1] + b * x;
    } else {
        a = c[2];
        b = c[1];
        d = c[0];
    }
    const double discriminant = b * b - 4 * a * d;
    if (discriminant < 0 || std::fabs(a) <= 1e-12 * largest) {
        if (count == 0 && std::fabs(b) > 1e-12 * largest) {
            root[at(count++)] = -d / b;
        }
        return count;
    }
    const double s = std::sqrt(discriminant);
    const double q = -0.5 * (b >= 0 ? b + s : b - s);
    root[at(count++)] = q / a;
    if (std::fabs(q) > 0) {
        root[at(count++)] = d / q;
    }
    return count;
}

// Takes out the part of F along its weakest right singular vector: the largest column of adj(F^T F) points along it.
bool make_rank_two(Fundamental& f) {
    std::array<double, 9> m{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            m[3 * i + j] = f[i] * f[j] + f[3 + i] * f[3 + j] + f[6 + i] * f[6 + j];
        }
    }
    const std::array<std::array<double, 3>, 3> adjugate{
        {{m[4] * m[8] - m[5] * m[7], m[5] * m[6] - m[3] * m[8], m[3] * m[7] - m[4] * m[6]},
         {m[2] * m[7] - m[1] * m[8], m[0] * m[8] - m[2] * m[6], m[1] * m[6] - m[0] * m[7]},
         {m[1] * m[5] - m[2] * m[4], m[2] * m[3] - m[0] * m[5], m[0] * m[4] - m[1] * m[3]}}};
    std::size_t best = 0;
    double best_norm = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& w = adjugate[k];
        const double norm = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
        if (norm > best_norm) {
            best_norm = norm;
            best = k;
        }
    }
    if (!(best_norm > 1e-300)) {
        return false;
    }
    const auto& w = adjugate[best];
    for (std::size_t i = 0; i < 3; ++i) {
        const double along = (f[3 * i] * w[0] + f[3 * i + 1] * w[1] + f[3 * i + 2] * w[2]) / best_norm;
        for (std::size_t j = 0; j < 3; ++j) {
            f[3 * i + j] -= along * w[j];
        }
    }
    return normalise(f);
}

// 1 / (gradient of q^T F p)^2 with unit-free scaling: turns the algebraic into the Sampson error.
double sampson_weight(const Fundamental& f, const Row& e) {
    const double px = e[6];
    const double py = e[7];
    const double qx = e[2];
    const double qy = e[5];
    const double a = f[0] * px + f[1] * py + f[2];
    const double b = f[3] * px + f[4] * py + f[5];
    const double c = f[0] * qx + f[3] * qy + f[6];
    const double d = f[1] * qx + f[4] * qy + f[7];
    return 1.0 / (a * a + b * b + c * c + d * d + 1e-6);
}

// Cholesky factor in the lower triangle; false: not positive definite.
bool factorise(Symmetric& a) {
    for (std::size_t j = 0; j < kUnknowns; ++j) {
        for (std::size_t i = j; i < kUnknowns; ++i) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) {
                sum -= a[i][k] * a[j][k];
            }
            if (i == j) {
                if (!(sum > 0)) {
                    return false;
                }
                a[j][j] = std::sqrt(sum);
            } else {
                a[i][j] = sum / a[j][j];
            }
        }
    }
    return true;
}

void solve(const Symmetric& l, Fundamental& x) {
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            x[i] -= l[i][k] * x[k];
        }
        x[i] /= l[i][i];
    }
    for (std::size_t n = kUnknowns; n > 0; --n) {
        const std::size_t i = n - 1;
        for (std::size_t k = i + 1; k < kUnknowns; ++k) {
            x[i] -= l[k][i] * x[k];
        }
        x[i] /= l[i][i];
    }
}

}  // namespace

void solve_seven_points(const ImagePairs& pairs, const std::array<int, 7>& sample, SevenPointSolutions& out) {
    out.count = 0;
    Equations a{};
    for (int k = 0; k < kEquations; ++k) {
        a[at(k)] = equation(pairs, sample[at(k)]);
    }
    std::array<int, kUnknowns> column{};
    if (!eliminate(a, column)) {
        return;
    }
    Fundamental f{};  // the null space: f + x g
    Fundamental g{};
    f[at(column[7])] = 1.0;
    g[at(column[8])] = 1.0;
    for (int k = 0; k < kEquations; ++k) {
        f[at(column[at(k)])] = -a[at(k)][at(column[7])];
        g[at(column[at(k)])] = -a[at(k)][at(column[8])];
    }
    const std::array<double, 4> cubic{
        determinant(f, f, f), determinant(g, f, f) + determinant(f, g, f) + determinant(f, f, g),
        determinant(f, g, g) + determinant(g, f, g) + determinant(g, g, f), determinant(g, g, g)};
    std::array<double, 3> root{};
    const int roots = solve_cubic(cubic, root);
    for (int r = 0; r < roots; ++r) {
        Fundamental& solution = out.f[at(out.count)];
        for (std::size_t k = 0; k < kUnknowns; ++k) {
            solution[k] = f[k] + root[at(r)] * g[k];
        }
        out.count += normalise(solution) ? 1 : 0;
    }
}

bool refit_fundamental(const ImagePairs& pairs, const PairFlags& use, Fundamental& f) {
    constexpr int kInverseIterations = 5;  // from a start that already fits
    Symmetric normal{};
    int used = 0;
    for (int i = 0; i < pairs.size; ++i) {
        if (use[at(i)] == 0) {
            continue;
        }
        const Row e = equation(pairs, i);
        const double weight = sampson_weight(f, e);
        for (std::size_t r = 0; r < kUnknowns; ++r) {
            for (std::size_t c = 0; c <= r; ++c) {
                normal[r][c] += weight * e[r] * e[c];
            }
        }
        ++used;
    }
    if (used < 8) {
        return false;
    }
    double trace = 0;
    for (std::size_t k = 0; k < kUnknowns; ++k) {
        trace += normal[k][k];
    }
    for (std::size_t k = 0; k < kUnknowns; ++k) {
        normal[k][k] += 1e-13 * trace;  // exact data: the smallest eigenvalue is zero
    }
    if (!std::isfinite(trace) || !factorise(normal)) {
        return false;
    }
    Fundamental x = f;
    for (int k = 0; k < kInverseIterations; ++k) {
        solve(normal, x);
        if (!normalise(x)) {
            return false;
        }
    }
    if (!make_rank_two(x)) {
        return false;
    }
    f = x;
    return true;
}

int test_fundamental(const ImagePairs& pairs, const Fundamental& f, double threshold_px, PairFlags& agrees) {
    std::array<float, 9> g{};
    for (std::size_t k = 0; k < 9; ++k) {
        g[k] = static_cast<float>(f[k]);
    }
    const auto threshold = static_cast<float>(threshold_px / static_cast<double>(pairs.px_per_unit));
    const float squared = threshold * threshold;
    int count = 0;
    for (std::size_t i = 0; i < at(pairs.size); ++i) {  // lanes are independent: vectorised without changing a bit
        const float px = pairs.px[i];
        const float py = pairs.py[i];
        const float qx = pairs.qx[i];
        const float qy = pairs.qy[i];
        const float a = g[0] * px + g[1] * py + g[2];
        const float b = g[3] * px + g[4] * py + g[5];
        const float c = g[6] * px + g[7] * py + g[8];
        const float d = g[0] * qx + g[3] * qy + g[6];
        const float e = g[1] * qx + g[4] * qy + g[7];
        const float error = qx * a + qy * b + c;
        const int inside = error * error < squared * (a * a + b * b + d * d + e * e) ? 1 : 0;
        agrees[i] = static_cast<std::uint8_t>(inside);
        count += inside;
    }
    return count;
}

}  // namespace semtrack
