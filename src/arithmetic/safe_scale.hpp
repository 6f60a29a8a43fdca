#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rrcb {

/// Returns the power of two that brings `largest` (>= 0) near 1; 1 if its exponent is harmless, or
/// for 0.
inline double safe_scale(double largest, int harmless_exponent) {
    if (!(largest > 0)) return 1;
    const int exponent = std::ilogb(largest);
    if (std::abs(exponent) <= harmless_exponent) return 1;
    return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

}  // namespace rrcb
