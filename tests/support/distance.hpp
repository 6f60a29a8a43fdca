#pragma once

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <cmath>

namespace rrcb::test {

/// Distance from a position to a closed box, in extended precision.
inline long double distance(const Vector& x, const Box& box, int dimension) {
    long double sum = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        const long double apart = std::max({0.0L, static_cast<long double>(box.lower[a]) - x[a],
                                            static_cast<long double>(x[a]) - box.upper[a]});
        sum += apart * apart;
    }
    return std::sqrt(sum);
}

}  // namespace rrcb::test
