// Integer lanes of the target: `lanes` is one of three implementations of the same functions (lanes_plain.hpp says what
// they mean). Compilers do not find the sum of absolute differences, or the tests of the FAST circle, in plain loops:
// with lanes the front end takes a third of the time. Integers only, so the choice never changes a bit.
#ifndef SEMTRACK_MATH_LANES_HPP
#define SEMTRACK_MATH_LANES_HPP

#if defined(__SSE2__)
#include "math/lanes_sse2.hpp"
namespace semtrack {
namespace lanes = lanes_sse2;
}
#elif defined(__ARM_NEON)
#include "math/lanes_neon.hpp"
namespace semtrack {
namespace lanes = lanes_neon;
}
#else
#include "math/lanes_plain.hpp"
namespace semtrack {
namespace lanes = lanes_plain;
}
#endif

#endif
