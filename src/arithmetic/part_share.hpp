#pragma once

#include <limits>
#include <numeric>
#include <span>

namespace rrcb {

inline double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Returns the weight of a part divided by its intended weight, which is the share `ideal` of
/// `total`. Returns 0 if the part has no weight, and infinity if it should be empty but has weight.
inline double over_ideal(double weight, double total, double ideal) {
    if (!(weight > 0)) return 0;
    // Divides shares instead of weights, because the intended weight of a tiny part may underflow.
    return ideal > 0 ? weight / total / ideal : std::numeric_limits<double>::infinity();
}

}  // namespace rrcb
