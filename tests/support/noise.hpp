// Seeded noise for tests: the same numbers everywhere.
#ifndef SEMTRACK_TESTS_SUPPORT_NOISE_HPP
#define SEMTRACK_TESTS_SUPPORT_NOISE_HPP

#include "math/rng.hpp"

namespace semtrack {

/// Nearly normal, mean 0, sigma 1 (sum of twelve uniform numbers).
inline double normal(Rng& rng) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
        sum += rng.uniform();
    }
    return sum;
}

/// Uniform between two values.
inline double between(Rng& rng, double low, double high) {
    return low + (high - low) * rng.uniform();
}

}  // namespace semtrack

#endif
