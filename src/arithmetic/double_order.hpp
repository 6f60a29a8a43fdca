#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace rrcb {

// Doubles in ascending order as whole numbers: neighbours differ by 1, both zeros are equal.

/// Returns the number of doubles from 0 to `value`, negative below 0.
inline std::int64_t double_rank(double value) {
    if (value == 0) return 0;
    const auto bits = std::bit_cast<std::int64_t>(value);
    return bits > 0 ? bits : -(bits & std::numeric_limits<std::int64_t>::max());
}

inline double double_of_rank(std::int64_t rank) {
    return rank >= 0 ? std::bit_cast<double>(rank) : -std::bit_cast<double>(-rank);
}

}  // namespace rrcb
