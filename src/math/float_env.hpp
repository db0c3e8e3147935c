// The floating-point environment that the library's bits rest on: round to nearest, no flush to zero, no traps. A
// customer's program (or a library it loads) may have set another one.
#ifndef SEMTRACK_MATH_FLOAT_ENV_HPP
#define SEMTRACK_MATH_FLOAT_ENV_HPP

#include <cstdint>

namespace semtrack {

namespace detail {

#if defined(__x86_64__)
using FloatControl = std::uint32_t;                     // MXCSR
inline constexpr FloatControl kFloatControl = 0x1F80U;  // all traps masked, to nearest, FTZ and DAZ off
inline FloatControl read_float_control() {
    return __builtin_ia32_stmxcsr();
}
inline void write_float_control(FloatControl value) {
    __builtin_ia32_ldmxcsr(value);
}
#elif defined(__aarch64__)
using FloatControl = std::uint64_t;                // FPCR
inline constexpr FloatControl kFloatControl = 0U;  // no traps, to nearest, FZ and DN off
inline FloatControl read_float_control() {
    FloatControl value = 0U;
    // MISRA deviation D-03 (C++:2023 10.4.1): the control register has no name in C++.
    __asm__ volatile("mrs %0, fpcr" : "=r"(value));
    return value;
}
inline void write_float_control(FloatControl value) {
    __asm__ volatile("msr fpcr, %0" : : "r"(value) : "memory");
}
#elif defined(__arm__) && defined(__ARM_FP)
using FloatControl = std::uint32_t;                // FPSCR
inline constexpr FloatControl kFloatControl = 0U;  // no traps, to nearest, FZ and DN off, no vector mode
inline FloatControl read_float_control() {
    FloatControl value = 0U;
    __asm__ volatile("vmrs %0, fpscr" : "=r"(value));
    return value;
}
inline void write_float_control(FloatControl value) {
    __asm__ volatile("vmsr fpscr, %0" : : "r"(value) : "memory");
}
#else
using FloatControl = std::uint32_t;  // arithmetic in software: there is nothing to set
inline constexpr FloatControl kFloatControl = 0U;
inline FloatControl read_float_control() {
    return kFloatControl;
}
inline void write_float_control(FloatControl) {}
#endif

}  // namespace detail

/// Sets the environment for its life time and gives the caller's back. Calls between must not be inlined into the
/// function that holds it (the compiler may move arithmetic across).
class FloatEnvironment {
public:
    FloatEnvironment() : saved_(detail::read_float_control()) { detail::write_float_control(detail::kFloatControl); }
    ~FloatEnvironment() { detail::write_float_control(saved_); }
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
    detail::FloatControl saved_;
};

}  // namespace semtrack

#endif
