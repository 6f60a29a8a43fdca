#pragma once

#include <rrcb/passes.hpp>

namespace rrcb {

/// Reads the weights, once. Throws Error if the arrays do not fit together, or with the first
/// illegal weight and their number.
PointSummary summary_of_weights(const Points& points);

/// Reads coordinates and weights, once. Throws Error as summary_of_weights(), or with the first
/// illegal coordinate, NaN or infinite, and their number.
PointSummary summary_of(const Points& points);

/// Returns the box of points in their arrays, as bounding_box() does: NaN along an axis with a
/// non-finite coordinate. May raise floating-point exceptions.
Box box_of(const Points& points);

}  // namespace rrcb
