// The one closed set of results of this library.
#ifndef SEMTRACK_STATUS_HPP
#define SEMTRACK_STATUS_HPP

#include <cstdint>

namespace semtrack {

/// No call in this library can end in any other state.
enum class [[nodiscard]] Status : std::uint8_t {
    kOk = 0,
    kInvalidArgument,  ///< contract broken by the caller; outputs untouched
    kCapacity,         ///< a bound of capacity.hpp was reached; the item was dropped and counted
    kBehindCamera,     ///< a depth is below kMinDepth_m
    kNotObservable,    ///< too few valid measurements, or the normal matrix is not positive definite
    kNotConverged      ///< the solver used its iterations; the best state so far is returned
};

}  // namespace semtrack

#endif
