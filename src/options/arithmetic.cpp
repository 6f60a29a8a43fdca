#include "options/arithmetic.hpp"

#include <limits>

namespace rrcb {

std::uint64_t arithmetic_in_use() {
    // Volatile, so that it is computed when called and not when compiled.
    const volatile double one = 1;
    const volatile double tiny = std::numeric_limits<double>::epsilon() / 1024;
    const volatile double normal = std::numeric_limits<double>::min();
    const volatile double subnormal = std::numeric_limits<double>::denorm_min();
    const volatile double half = normal / 2;
    const bool found[] = {one + tiny > one, one - tiny < one, -one - tiny < -one, half == 0,
                          subnormal == 0};
    std::uint64_t bits = 0;
    for (const bool bit : found) bits = 2 * bits + (bit ? 1 : 0);
    return bits;
}

}  // namespace rrcb
