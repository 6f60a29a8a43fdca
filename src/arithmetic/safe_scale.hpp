#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rrcb {

/// Returns the power of two that scales `largest` (>= 0) to about 1. Returns 1 if `largest` is 0 or
/// its exponent is at most `harmless_exponent` in size.
inline double safe_scale(double largest, int harmless_exponent) {
    if (!(largest > 0)) return 1;
    const int exponent = std::ilogb(largest);
    if (std::abs(exponent) <= harmless_exponent) return 1;
    return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

}  // namespace rrcb
