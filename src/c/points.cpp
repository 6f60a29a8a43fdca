#include "c/balancer.hpp"
#include "options/rejection.hpp"

#include <rrcb/points.hpp>

#include <algorithm>

namespace rrcb::c {

Points points_of(const rrcb_points* from) {
    require(from, "points");
    Points points;
    points.dimension = from->dimension;
    points.count = from->count;
    if (points.count == 0 || points.dimension < 1 || points.dimension > max_dimension)
        return points;
    if (from->type != RRCB_DOUBLE || from->stride % sizeof(double) != 0)
        reject("coordinates have the type RRCB_DOUBLE, and a stride of a whole number of them");
    points.stride = from->stride / sizeof(double);
    for (int axis = 0; axis < points.dimension; ++axis) {
        require(from->axes[axis], "coordinates");
        points.axes[axis] = {static_cast<const double*>(from->axes[axis]),
                             (points.count - 1) * points.stride + 1};
    }
    points.weights = view(from->weights, points.count);
    return points;
}

}  // namespace rrcb::c

rrcb_points rrcb_interleaved_points(int dimension, size_t count, const double* coordinates,
                                    const double* weights) {
    rrcb_points points{dimension, RRCB_DOUBLE, count, 0, {}, weights};
    points.stride = static_cast<std::size_t>(std::max(dimension, 0)) * sizeof(double);
    if (coordinates == nullptr) return points;
    for (int axis = 0; axis < std::min(dimension, rrcb::max_dimension); ++axis)
        points.axes[axis] = coordinates + axis;
    return points;
}

rrcb_points rrcb_column_points(int dimension, size_t count, const double* const* columns,
                               const double* weights) {
    rrcb_points points{dimension, RRCB_DOUBLE, count, sizeof(double), {}, weights};
    if (columns == nullptr) return points;
    for (int axis = 0; axis < std::min(dimension, rrcb::max_dimension); ++axis)
        points.axes[axis] = columns[axis];
    return points;
}

int rrcb_bounding_box(const rrcb_points* points, double* lower, double* upper) {
    return rrcb::c::guarded([&] {
        rrcb::c::require(lower, "lower");
        rrcb::c::require(upper, "upper");
        const rrcb::Box box = rrcb::bounding_box(rrcb::c::points_of(points));
        std::ranges::copy(box.lower, lower);
        std::ranges::copy(box.upper, upper);
    });
}
