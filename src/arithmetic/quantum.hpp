#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

/// Returns the power of two to whose multiples weights are rounded, so that doubles represent sums
/// up to about `weight` exactly.
inline double quantum_for(double weight) {
    // Keeps two more binary digits in reserve than a sum of `weight` needs, for nodes that weigh a
    // little more.
    constexpr int digits = std::numeric_limits<double>::digits - 3;
    constexpr int smallest =
        std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
    if (!(weight > 0)) return 0;
    return std::ldexp(1.0, std::max(std::ilogb(weight) - digits, smallest));
}

/// Returns `value` rounded to a multiple of the quantum.
inline double rounded_to(double quantum, double value) {
    return quantum > 0 ? std::nearbyint(value / quantum) * quantum : value;
}

}  // namespace rrcb
