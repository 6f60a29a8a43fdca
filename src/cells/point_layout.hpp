#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Points of a dimension and stride known to the compiler, for the loops that touch every point.
template <int Dimension, std::size_t Stride>
struct PointLayout {
    static constexpr int dimension = Dimension;
    std::array<const double*, Dimension> axes;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i * Stride]; }
};

/// Points of any stride, such as members of structs.
template <int Dimension>
struct StridedLayout {
    static constexpr int dimension = Dimension;
    std::array<const double*, Dimension> axes;
    std::size_t stride;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i * stride]; }
};

template <int Dimension, class Visit>
decltype(auto) visit_layout_of(const Points& points, Visit&& visit) {
    std::array<const double*, Dimension> axes;
    for (std::size_t a = 0; a < Dimension; ++a) axes[a] = points.axes[a].data();
    if (points.stride == 1) return visit(PointLayout<Dimension, 1>{axes});
    if (points.stride == Dimension) return visit(PointLayout<Dimension, Dimension>{axes});
    return visit(StridedLayout<Dimension>{axes, points.stride});
}

/// Calls `visit(layout)` with the layout of `points`: stride 1 (columns), dimension (interleaved)
/// or any other.
template <class Visit>
decltype(auto) visit_layout(const Points& points, Visit&& visit) {
    if (points.dimension == 1) return visit_layout_of<1>(points, visit);
    if (points.dimension == 2) return visit_layout_of<2>(points, visit);
    return visit_layout_of<3>(points, visit);
}

}  // namespace rrcb
