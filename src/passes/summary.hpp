#pragma once

#include "passes/extent.hpp"

#include <limits>

namespace rrcb {

/// Box, ends and weights of one rank's points.
struct PointSummary {
    Box box{};        ///< of the positions
    Extent extent{};  ///< count, weight and ends of the positions
    double lightest = std::numeric_limits<double>::infinity();  ///< weight of one point
    double heaviest = 0;
};

/// Reads the weights, once. Throws Error if the arrays do not fit together, or with the first
/// illegal weight and their number.
PointSummary summary_of_weights(const Points& points);

/// Reads coordinates and weights, once. Throws Error as summary_of_weights(), or with the first
/// coordinate that is NaN or infinite and their number.
PointSummary summary_of(const Points& points);

}  // namespace rrcb
