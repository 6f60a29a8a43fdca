#pragma once

#include <rrcb/detail/passes.hpp>

namespace rrcb {

/// As summary_of(), but reads only the weights.
PointSummary summary_of_weights(const Points& points);

/// Returns the box of points, as bounding_box() does. It is NaN along an axis with a non-finite
/// coordinate. May raise floating-point exceptions.
Box box_of(const Points& points);

}  // namespace rrcb
