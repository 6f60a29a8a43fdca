#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Points whose coordinates are interleaved in one array.
template <int Dimension, class Scalar>
struct InterleavedLayout {
    static constexpr int dimension = Dimension;
    const Scalar* coordinates;

    double operator()(LocalIndex i, int axis) const { return coordinates[i * Dimension + axis]; }
};

/// Points with one array per axis.
template <int Dimension, class Scalar>
struct ColumnLayout {
    static constexpr int dimension = Dimension;
    std::array<const Scalar*, Dimension> axes;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i]; }
};

/// Points with any stride, for example members of structs.
template <int Dimension, class Scalar>
struct StridedLayout {
    static constexpr int dimension = Dimension;
    std::array<const Scalar*, Dimension> axes;
    std::size_t stride;

    double operator()(LocalIndex i, int axis) const { return axes[axis][i * stride]; }
};

template <int Dimension, class Scalar, class Visit>
decltype(auto) visit_layout_of(const Points& points, Visit&& visit) {
    const std::size_t stride = points.stride / sizeof(Scalar);
    std::array<const Scalar*, Dimension> axes;
    bool is_interleaved = stride == Dimension;
    for (std::size_t a = 0; a < Dimension; ++a) {
        axes[a] = static_cast<const Scalar*>(points.axes[a]);
        is_interleaved = is_interleaved && axes[a] == axes[0] + a;
    }
    if (stride == 1) return visit(ColumnLayout<Dimension, Scalar>{axes});
    if (is_interleaved) return visit(InterleavedLayout<Dimension, Scalar>{axes[0]});
    return visit(StridedLayout<Dimension, Scalar>{axes, stride});
}

template <int Dimension, class Visit>
decltype(auto) visit_layout_of(const Points& points, Visit&& visit) {
    if (points.type == ScalarType::float32) return visit_layout_of<Dimension, float>(points, visit);
    return visit_layout_of<Dimension, double>(points, visit);
}

/// Calls visit(layout) with the layout of `points`: columns, interleaved, or any other stride.
template <class Visit>
decltype(auto) visit_layout(const Points& points, Visit&& visit) {
    if (points.dimension == 1) return visit_layout_of<1>(points, visit);
    if (points.dimension == 2) return visit_layout_of<2>(points, visit);
    return visit_layout_of<3>(points, visit);
}

}  // namespace rrcb
