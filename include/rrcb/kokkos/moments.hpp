#pragma once

#include <rrcb/kokkos/points.hpp>
#include <rrcb/method/moments.hpp>
#include <rrcb/method/support_mesh.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rrcb::detail {

/// A layer of a mesh across an axis, in scaled lengths.
struct Layer {
    double middle;
    double side;
};

inline Layer layer_of(const SupportMesh& mesh, const Box& cell, std::size_t axis) {
    const double lower = cell.lower[axis] * mesh.scale[axis];
    const double upper = cell.upper[axis] * mesh.scale[axis];
    return {lower / 2 + upper / 2, upper - lower};
}

/// The layers of a mesh across an axis in a kernel, in scaled lengths.
struct Layers {
    double scale;
    double lower;  ///< of the frame
    double per_length;
    std::int32_t number;
    const Layer* first;  ///< with the reciprocal of each side in its place

    /// Returns the layer of a coordinate, and its offset from the middle in sides.
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

/// Adds up fields of points in the cells of a mesh: their number, their weight if they have any,
/// then for each of some axes the first and second moment about the middle of the cell.
template <class T, class W>
struct AddMoments {
    Positions<T> x;
    Weights<W> weights;
    Layers layers[max_dimension];
    int num_fields;
    int first_axis;
    int end_axis;

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        double offset[max_dimension] = {};
        std::int64_t bin = 0;
        for (int a = max_dimension; a-- > 0;)
            if (a < x.dimension) bin = bin * layers[a].number + layers[a].find(x(i, a), offset[a]);
        bin *= num_fields;
        bins.add(bin++, 1);
        const double weight = weights.relative(i);
        if (weights.values != nullptr) bins.add(bin++, to_units(weight, weight_bits));
        for (int a = 0; a < max_dimension; ++a) {
            if (a < first_axis || a >= end_axis) continue;
            const double first = weight * offset[a];
            bins.add(bin++, to_units(first, weight_bits));
            bins.add(bin++, to_units(first * offset[a], square_bits));
        }
    }
};

/// Returns the layers of all axes, one axis after the other, and describes them to a kernel, which
/// needs them on the device.
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

/// Returns the moments of every cell that holds weight, as cell_moments(): mean and deviation to
/// within 1e-6 of the sides of a cell unless its points are lighter than a millionth of the
/// heaviest; the same bits in any order of the points. Adds up as many axes at once as a team has
/// scratch for, all if it is too small for one. A fence.
template <class Device, class T, class W>
std::vector<CellMoments> moments_on(Device& device, const Positions<T>& x,
                                    const Weights<W>& weights, const SupportMesh& mesh) {
    const std::size_t num_cells = rrcb::num_cells(mesh);
    AddMoments<T, W> body{x, weights, {}, 0, 0, 0};
    const std::vector<Layer> layers = layers_of(mesh, body.layers);
    const auto on_device = device.copy_in(layers);
    const Layer* first = on_device.data();
    for (int a = 0; a < mesh.dimension; first += body.layers[a++].number)
        body.layers[a].first = first;
    const bool weighs = weights.values != nullptr;
    const int head = weighs ? 2 : 1;
    const auto bins = static_cast<std::size_t>(bins_in_scratch(device.exec()));
    const int fitting = (static_cast<int>(bins / num_cells) - head) / 2;
    const int num_axes = fitting < 1 ? mesh.dimension : std::min(fitting, mesh.dimension);
    body.num_fields = head + 2 * num_axes;
    std::vector<AddMoments<T, W>> bodies;
    for (; body.first_axis < mesh.dimension; body.first_axis = body.end_axis) {
        body.end_axis = std::min(body.first_axis + num_axes, mesh.dimension);
        bodies.push_back(body);
    }
    const std::size_t num_bins = num_cells * static_cast<std::size_t>(body.num_fields);
    const std::vector<double> sums =
        sum_in_bins(device, x.count, static_cast<std::int64_t>(num_bins), bodies);
    std::vector<CellMoments> cells;
    for (std::size_t cell = 0; cell < num_cells; ++cell) {
        const double* sum = &sums[cell * static_cast<std::size_t>(body.num_fields)];
        const double units = weighs ? sum[1] : std::ldexp(sum[0], weight_bits);
        if (!(units > 0)) continue;
        CellMoments of{cell, cell_box(mesh, cell), {}};
        of.moments.count = static_cast<GlobalCount>(sum[0]);
        of.moments.weight = weighs ? weights.from_units(units) : sum[0];
        for (int axis = 0; axis < mesh.dimension; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Layer layer = layer_of(mesh, of.box, a);
            const double* of_axis = sum + axis / num_axes * num_bins + head + axis % num_axes * 2;
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
