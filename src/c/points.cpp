#include "c/sized.hpp"
#include "options/rejection.hpp"

#include <rrcb/points.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace rrcb::c {

namespace {

std::size_t bytes_of(int32_t type) {
    return type == RRCB_FLOAT ? sizeof(float) : sizeof(double);
}

// Values of `type` by which the Fortran module reports arrays that do not fit together. `stride` is
// then the extent that does not fit.
enum FortranFault { wrong_weights = 11, wrong_axis = 12, wrong_shape = 13, wrong_radii = 14 };

/// Throws Error if the points come from Fortran arrays that do not fit together.
void check_fortran(const rrcb_points& from) {
    const std::string count = std::to_string(from.count);
    const std::string extent = std::to_string(from.stride);
    switch (from.type) {
        case wrong_weights:
            reject("weights has " + extent + " entries for " + count +
                   " points; give one for each, or no weights");
        case wrong_axis:
            reject("x, y and z must have one length, not " + count + " and " + extent);
        case wrong_radii:
            reject("cutoffs has " + extent + " entries for " + count +
                   " points; give one for each, or none");
        case wrong_shape:
            reject("coordinates has the shape (" + extent + ", " + count +
                   "); give (dimension, points) with a dimension of 1, 2 or 3, or call "
                   "rrcb_column_points(x(:,1), x(:,2), x(:,3))");
        default:
            return;
    }
}

}  // namespace

Points points_of(const rrcb_points* given) {
    const rrcb_points from = copy_in(given, "points");
    check_fortran(from);
    Points points;
    points.dimension = from.dimension;
    points.count = from.count;
    if (points.count == 0 || points.dimension < 1 || points.dimension > max_dimension)
        return points;
    const std::size_t bytes = bytes_of(from.type);
    if (from.type != RRCB_DOUBLE && from.type != RRCB_FLOAT)
        reject("coordinates must have the type RRCB_DOUBLE or RRCB_FLOAT; set it to theirs");
    if (points.count > PTRDIFF_MAX / std::max(from.stride, bytes))
        reject("count and stride exceed the memory; count is the number of points of this rank");
    if (from.stride < bytes || from.stride % bytes != 0)
        reject("the stride must be in bytes, a multiple of the size of a coordinate");
    points.type = from.type == RRCB_FLOAT ? ScalarType::float32 : ScalarType::float64;
    points.stride = from.stride;
    for (int axis = 0; axis < points.dimension; ++axis) {
        require_array(points.count, from.axes[axis], "coordinates");
        points.axes[axis] = from.axes[axis];
    }
    points.weights = view(from.weights, points.count);
    return points;
}

}  // namespace rrcb::c

int rrcb_bounding_box(const rrcb_points* points, double* lower, double* upper) {
    return rrcb::c::guarded([&] {
        rrcb::c::require(lower, "lower");
        rrcb::c::require(upper, "upper");
        const rrcb::Box box = rrcb::bounding_box(rrcb::c::points_of(points));
        std::ranges::copy(box.lower, lower);
        std::ranges::copy(box.upper, upper);
    });
}
