#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Points of a dimension and stride known to the compiler, for the loops that touch every point.
template <int Dimension, std::size_t Stride>
struct PointLayout {
    static constexpr int dimension = Dimension;
    std::array<const double*, Dimension> axes;

    double operator()(LocalIndex i, int axis) const {
        return axes[static_cast<std::size_t>(axis)][i * Stride];
    }
};

template <int Dimension, std::size_t Stride>
PointLayout<Dimension, Stride> layout_of(const Points& points) {
    PointLayout<Dimension, Stride> layout;
    for (std::size_t a = 0; a < Dimension; ++a) layout.axes[a] = points.axes[a].data();
    return layout;
}

/// Calls `visit(layout)` with the layout of `points`: stride 1 (columns) or dimension
/// (interleaved).
template <class Visit>
decltype(auto) visit_layout(const Points& points, Visit&& visit) {
    if (points.dimension == 1) return visit(layout_of<1, 1>(points));
    if (points.dimension == 2) {
        return points.stride == 1 ? visit(layout_of<2, 1>(points)) : visit(layout_of<2, 2>(points));
    }
    return points.stride == 1 ? visit(layout_of<3, 1>(points)) : visit(layout_of<3, 3>(points));
}

}  // namespace rrcb
