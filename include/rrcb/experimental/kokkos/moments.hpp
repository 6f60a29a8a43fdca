#pragma once

#include <rrcb/detail/moments.hpp>
#include <rrcb/detail/support_mesh.hpp>
#include <rrcb/experimental/kokkos/points.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rrcb::detail {

/// A layer of a mesh along an axis, in scaled lengths.
struct Layer {
    double middle;
    double side;
};

inline Layer layer_of(const SupportMesh& mesh, const Box& cell, std::size_t axis) {
    const double lower = cell.lower[axis] * mesh.scale[axis];
    const double upper = cell.upper[axis] * mesh.scale[axis];
    return {lower / 2 + upper / 2, upper - lower};
}

/// The layers of a mesh along an axis, for a kernel, in scaled lengths.
struct Layers {
    double scale;
    double lower;  ///< lower end of the frame
    double per_length;
    std::int32_t number;
    const Layer* first;  ///< here `side` is the reciprocal of the side

    /// Returns the layer of a coordinate, and writes its offset from the middle in units of the
    /// side.
    KOKKOS_INLINE_FUNCTION std::int32_t find(double coordinate, double& offset) const {
        const double value = coordinate * scale;
        const double place = (value - lower) * per_length;
        std::int32_t layer = number - 1;
        if (place < number) layer = static_cast<std::int32_t>(place > 0 ? place : 0);
        offset = (value - first[layer].middle) * first[layer].side;
        offset = offset > -0.5 ? offset : -0.5;
        offset = offset < 0.5 ? offset : 0.5;
        return layer;
    }
};

/// Sums over the points in the cells of a mesh: for each of some axes, the first and second moments
/// about the middle of the cell; after those of the last axis, the number of points, and their
/// weight if they have weights.
template <class Positions, class W, bool Weighs>
struct AddMoments {
    static constexpr int dimension = Positions::static_dimension;
    static constexpr int tail = Weighs ? 2 : 1;
    static constexpr int fields = 2 * dimension + tail;

    Positions x;
    Weights<W> weights;
    Layers layers[max_dimension];
    int num_fields;  ///< number of sums of a cell
    int first_axis;
    int end_axis;

    KOKKOS_INLINE_FUNCTION Row<fields> operator()(std::int64_t i) const {
        double offset[dimension];
        std::int64_t cell = 0;
        for (int a = dimension; a-- > 0;)
            cell = cell * layers[a].number + layers[a].find(x(i, a), offset[a]);
        Row<fields> row{cell * num_fields - 2 * first_axis, {}};
        const double weight = Weighs ? weights.relative(i) : 1.0;
        for (int a = 0; a < dimension; ++a) {
            if (a < first_axis || a >= end_axis) continue;
            const double first = weight * offset[a];
            row.values[2 * a] = to_units(first, weight_bits);
            row.values[2 * a + 1] = to_units(first * offset[a], square_bits);
        }
        if (end_axis < dimension) return row;
        row.values[2 * dimension] = 1;
        if (Weighs) row.values[fields - 1] = to_units(weight, weight_bits);
        return row;
    }
};

/// Returns the layers of all axes, one axis after the other, and describes them for a kernel. The
/// caller must copy them to the device.
inline std::vector<Layer> layers_of(const SupportMesh& mesh, Layers (&layers)[max_dimension]) {
    std::vector<Layer> all;
    LocalIndex stride = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
        layers[a] = {mesh.scale[a], mesh.frame.lower[a] * mesh.scale[a], mesh.cells_per_length[a],
                     static_cast<std::int32_t>(mesh.cells[a]), nullptr};
        for (int k = 0; k < mesh.cells[a]; ++k) {
            Layer layer = layer_of(mesh, cell_box(mesh, static_cast<LocalIndex>(k) * stride), a);
            layer.side = layer.side > 0 ? std::min(1 / layer.side, DBL_MAX) : 0;
            all.push_back(layer);
        }
        stride *= static_cast<LocalIndex>(mesh.cells[a]);
    }
    return all;
}

/// Returns the number of cells whose sums a team can add up in one reading of the points.
template <class Execution>
std::int64_t cells_in_scratch(const Execution& exec, int dimension, bool weighs) {
    return bins_in_scratch(exec) / (2 * dimension + (weighs ? 2 : 1));
}

/// Returns the moments of every cell that has weight, as cell_moments(). Mean and deviation are
/// accurate to 1e-6 of the sides of a cell, unless its points are lighter than a millionth of the
/// heaviest. They are bit-identical for any order of the points. Adds up as many axes at once as
/// fit in the scratch memory of a team; if not even one fits, all at once. Ends with a fence.
template <bool Weighs, class Device, class Positions, class W>
std::vector<CellMoments> moments_on(Device& device, const Positions& x, const Weights<W>& weights,
                                    const SupportMesh& mesh) {
    using Body = AddMoments<Positions, W, Weighs>;
    const std::size_t num_cells = rrcb::num_cells(mesh);
    Body body{x, weights, {}, 0, 0, 0};
    const std::vector<Layer> layers = layers_of(mesh, body.layers);
    const auto on_device = device.copy_in(layers);
    const Layer* first = on_device.data();
    for (int a = 0; a < mesh.dimension; first += body.layers[a++].number)
        body.layers[a].first = first;
    const auto bins = static_cast<std::size_t>(bins_in_scratch(device.exec()));
    const int fitting = (static_cast<int>(bins / num_cells) - Body::tail) / 2;
    const int num_axes = fitting < 1 ? mesh.dimension : std::min(fitting, mesh.dimension);
    body.num_fields = 2 * num_axes + Body::tail;
    std::vector<Body> bodies;
    for (; body.end_axis < mesh.dimension; body.first_axis = body.end_axis) {
        body.end_axis = std::min(body.first_axis + num_axes, mesh.dimension);
        bodies.push_back(body);
    }
    const std::size_t num_bins = num_cells * static_cast<std::size_t>(body.num_fields);
    const std::vector<double> sums =
        sum_in_bins(device, x.count, static_cast<std::int64_t>(num_bins), bodies);
    const int of_last = mesh.dimension - bodies.back().first_axis;
    std::vector<CellMoments> cells;
    for (std::size_t cell = 0; cell < num_cells; ++cell) {
        const double* sum = &sums[cell * static_cast<std::size_t>(body.num_fields)];
        const double* tail = sum + num_bins * (bodies.size() - 1) + 2 * of_last;
        const double units = Weighs ? tail[1] : std::ldexp(tail[0], weight_bits);
        if (!(units > 0)) continue;
        CellMoments of{cell, cell_box(mesh, cell), {}};
        of.moments.count = static_cast<GlobalCount>(tail[0]);
        of.moments.weight = Weighs ? weights.from_units(units) : tail[0];
        for (int axis = 0; axis < mesh.dimension; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Layer layer = layer_of(mesh, of.box, a);
            const double* of_axis = sum + axis / num_axes * num_bins + axis % num_axes * 2;
            const double mean = of_axis[0] / units;
            const double square = std::ldexp(of_axis[1], weight_bits - square_bits) / units;
            of.moments.mean[a] = std::clamp((layer.middle + mean * layer.side) / mesh.scale[a],
                                            of.box.lower[a], of.box.upper[a]);
            of.moments.deviation[a] =
                std::sqrt(std::max(0.0, square - mean * mean)) * layer.side / mesh.scale[a];
        }
        cells.push_back(of);
    }
    return cells;
}

}  // namespace rrcb::detail
