#pragma once

#include <limits>
#include <numeric>
#include <span>

namespace rrcb {

inline double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Returns the weight of a part over its intended weight, the share `ideal` of `total`; 0 without
/// weight, infinite if the part should be empty.
inline double over_ideal(double weight, double total, double ideal) {
    if (!(weight > 0)) return 0;
    // Shares, because the intended weight of a tiny part may underflow.
    return ideal > 0 ? weight / total / ideal : std::numeric_limits<double>::infinity();
}

}  // namespace rrcb
