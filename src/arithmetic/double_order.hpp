#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace rrcb {

// // Maps doubles to integers in the same order: consecutive doubles differ by 1, and both zeros
// map to 0.

/// /// Returns the number of doubles between 0 and `value`; it is negative if `value` is below 0.
inline std::int64_t double_rank(double value) {
    if (value == 0) return 0;
    const auto bits = std::bit_cast<std::int64_t>(value);
    return bits > 0 ? bits : -(bits & std::numeric_limits<std::int64_t>::max());
}

inline double double_of_rank(std::int64_t rank) {
    return rank >= 0 ? std::bit_cast<double>(rank) : -std::bit_cast<double>(-rank);
}

}  // namespace rrcb
