// Monotonic time for the age of an image at sending. Never read by the estimator.
#ifndef SEMTRACK_HAL_CLOCK_HPP
#define SEMTRACK_HAL_CLOCK_HPP

#include <cstdint>

namespace semtrack {

class Clock {
public:
    /// Same time base as the images' stamps.
    [[nodiscard]] virtual std::int64_t now_us() noexcept = 0;

protected:
    ~Clock() = default;
};

}  // namespace semtrack

#endif
