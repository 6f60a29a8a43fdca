#pragma once

#include <limits>
#include <numeric>
#include <span>

namespace rrcb {

inline double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Weight of a part over what it should weigh, the share `ideal` of `total`; 0 without weight, and
/// infinite where nothing should lie.
inline double over_ideal(double weight, double total, double ideal) {
    if (!(weight > 0)) return 0;
    // Shares, since a part of a tiny weight may be no number that a double holds.
    return ideal > 0 ? weight / total / ideal : std::numeric_limits<double>::infinity();
}

}  // namespace rrcb
