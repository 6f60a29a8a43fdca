#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Returns the box of points in their arrays, as bounding_box() does: NaN along an axis with a
/// coordinate that is not finite. May raise floating-point exceptions.
Box box_of(const Points& points);

}  // namespace rrcb
