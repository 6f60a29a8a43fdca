#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Points one after another, for the loops that touch every point.
template <int Dimension>
struct InterleavedLayout {
    static constexpr int dimension = Dimension;
    const double* coordinates;

    double operator()(LocalIndex i, int axis) const { return coordinates[i * Dimension + axis]; }
};

/// Points in an array per axis.
template <int Dimension>
struct ColumnLayout {
    static constexpr int dimension = Dimension;
    std::array<const double*, Dimension> axes;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i]; }
};

/// Points of any stride, such as members of structs, or of floats.
template <int Dimension, class Scalar = double>
struct StridedLayout {
    static constexpr int dimension = Dimension;
    std::array<const Scalar*, Dimension> axes;
    std::size_t stride;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i * stride]; }
};

template <int Dimension, class Visit>
decltype(auto) visit_layout_of(const Points& points, Visit&& visit) {
    if (points.has_floats()) {
        StridedLayout<Dimension, float> floats{{}, points.stride};
        for (std::size_t a = 0; a < Dimension; ++a) floats.axes[a] = points.float_axes[a].data();
        return visit(floats);
    }
    std::array<const double*, Dimension> axes;
    bool is_interleaved = points.stride == Dimension;
    for (std::size_t a = 0; a < Dimension; ++a) {
        axes[a] = points.axes[a].data();
        is_interleaved = is_interleaved && axes[a] == axes[0] + a;
    }
    if (points.stride == 1) return visit(ColumnLayout<Dimension>{axes});
    if (is_interleaved) return visit(InterleavedLayout<Dimension>{axes[0]});
    return visit(StridedLayout<Dimension>{axes, points.stride});
}

/// Calls `visit(layout)` with the layout of `points`: columns, interleaved, or any other stride;
/// only the last if coordinates are floats.
template <class Visit>
decltype(auto) visit_layout(const Points& points, Visit&& visit) {
    if (points.dimension == 1) return visit_layout_of<1>(points, visit);
    if (points.dimension == 2) return visit_layout_of<2>(points, visit);
    return visit_layout_of<3>(points, visit);
}

}  // namespace rrcb
