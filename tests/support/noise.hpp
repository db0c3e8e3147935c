// Seeded noise for tests: the same numbers everywhere.
#ifndef SEMTRACK_TESTS_SUPPORT_NOISE_HPP
#define SEMTRACK_TESTS_SUPPORT_NOISE_HPP

#include "math/rng.hpp"

namespace semtrack {

inline double normal(Rng& rng) {
    return rng.normal();
}

/// Uniform between two values.
inline double between(Rng& rng, double low, double high) {
    return low + (high - low) * rng.uniform();
}

}  // namespace semtrack

#endif
