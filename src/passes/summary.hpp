#pragma once

#include <rrcb/detail/passes.hpp>

namespace rrcb {

/// Reads the weights once. Throws Error if the arrays do not fit together, or if weights are
/// illegal; the text contains the first illegal weight and the number of such weights.
PointSummary summary_of_weights(const Points& points);

/// Reads coordinates and weights once. Throws Error as summary_of_weights(), or if coordinates are
/// NaN or infinite; the text contains the first of them and their number.
PointSummary summary_of(const Points& points);

/// Returns the box of points, as bounding_box() does. It is NaN along an axis with a non-finite
/// coordinate. May raise floating-point exceptions.
Box box_of(const Points& points);

}  // namespace rrcb
