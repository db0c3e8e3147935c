// Repeatable pseudo-random numbers: the same seed, the same samples, on every target.
#ifndef SEMTRACK_MATH_RNG_HPP
#define SEMTRACK_MATH_RNG_HPP

#include <cstdint>

namespace semtrack {

/// xorshift32; never 0.
class Rng {
public:
    explicit Rng(std::uint32_t seed) : s_{seed * 2654435761U + 1U} {
        if (s_ == 0U) { s_ = 1U; }
    }
    std::uint32_t next() {
        s_ ^= s_ << 13U;
        s_ ^= s_ >> 17U;
        s_ ^= s_ << 5U;
        return s_;
    }
    /// 0..n-1, n > 0.
    int below(int n) { return static_cast<int>(next() % static_cast<std::uint32_t>(n)); }
    /// [0, 1), 24 bits.
    double uniform() { return static_cast<double>(next() >> 8U) / 16777216.0; }
    /// Nearly standard normal, cut at 6 sigma: the sum of twelve uniforms, so the same bits everywhere.
    double normal() {
        double sum = -6.0;
        for (int k = 0; k < 12; ++k) {
            sum += uniform();
        }
        return sum;
    }

private:
    std::uint32_t s_;
};

}  // namespace semtrack

#endif
