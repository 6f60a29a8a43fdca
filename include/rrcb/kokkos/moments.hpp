#pragma once

#include <rrcb/kokkos/points.hpp>
#include <rrcb/kokkos/sums.hpp>
#include <rrcb/method/moments.hpp>
#include <rrcb/method/support_mesh.hpp>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <span>
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
/// then for each axis the first and second moment about the middle of the cell.
template <class T, class W>
struct AddMoments {
    Positions<T> x;
    Weights<W> weights;
    Layers layers[max_dimension];
    std::int64_t num_cells;
    int begin;  ///< first field that is added
    int end;    ///< behind the last one

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        double offset[max_dimension] = {};
        std::int64_t cell = 0;
        for (int a = max_dimension; a-- > 0;)
            if (a < x.dimension)
                cell = cell * layers[a].number + layers[a].find(x(i, a), offset[a]);
        const double weight = weights.values == nullptr ? 1 : weights.relative(i);
        int field = 0;
        add(bins, field++, cell, 1);
        if (weights.values != nullptr) add(bins, field++, cell, to_units(weight, weight_bits));
        for (int a = 0; a < max_dimension; ++a) {
            if (a >= x.dimension) break;
            const double first = weight * offset[a];
            add(bins, field++, cell, to_units(first, weight_bits));
            add(bins, field++, cell, to_units(first * offset[a], square_bits));
        }
    }
    template <class Bins>
    KOKKOS_INLINE_FUNCTION void add(const Bins& bins, int field, std::int64_t cell,
                                    std::int64_t value) const {
        if (field >= begin && field < end) bins.add((field - begin) * num_cells + cell, value);
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

/// Returns the sums of fields, [field][cell]: as many fields at once as a team has scratch for, all
/// at once if it is too small for an axis. A fence.
template <class Device, class T, class W>
std::vector<double> sums_of_cells(Device& device, AddMoments<T, W> body) {
    const int fields = (body.weights.values == nullptr ? 1 : 2) + 2 * body.x.dimension;
    const auto all = static_cast<std::size_t>(fields * body.num_cells);
    const auto sums = device.template lend_zeros<Word>(2 * all);
    const auto fitting = static_cast<int>(
        std::min<std::int64_t>(fields, bins_in_scratch(device.exec()) / body.num_cells));
    const int step = fitting < 3 ? fields : fitting;
    for (body.begin = 0; body.begin < fields; body.begin = body.end) {
        body.end = std::min(body.begin + step, fields);
        add_in_bins(device, body.x.count, (body.end - body.begin) * body.num_cells,
                    sums.data() + 2 * body.begin * body.num_cells, body);
    }
    return totals_of_bins(device, sums);
}

/// Returns the moments of every cell that holds weight, as cell_moments(): mean and deviation to
/// within 1e-6 of the sides of a cell unless its points are lighter than a millionth of the
/// heaviest; the same bits in any order of the points. A fence.
template <class Device, class T, class W>
std::vector<CellMoments> moments_on(Device& device, const Positions<T>& x,
                                    const Weights<W>& weights, const SupportMesh& mesh) {
    const std::size_t num_cells = rrcb::num_cells(mesh);
    AddMoments<T, W> body{x, weights, {}, static_cast<std::int64_t>(num_cells), 0, 0};
    const std::vector<Layer> layers = layers_of(mesh, body.layers);
    const auto on_device = device.copy_in(layers);
    const Layer* first = on_device.data();
    for (int a = 0; a < mesh.dimension; first += body.layers[a++].number)
        body.layers[a].first = first;
    const std::vector<double> sums = sums_of_cells(device, body);
    const bool weighs = weights.values != nullptr;
    std::vector<CellMoments> cells;
    for (std::size_t cell = 0; cell < num_cells; ++cell) {
        const auto sum = [&](std::size_t field) { return sums[field * num_cells + cell]; };
        const double units = weighs ? sum(1) : std::ldexp(sum(0), weight_bits);
        if (!(units > 0)) continue;
        CellMoments of{cell, cell_box(mesh, cell), {}};
        of.moments.count = static_cast<GlobalCount>(sum(0));
        of.moments.weight = weighs ? weights.from_units(units) : sum(0);
        for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
            const Layer layer = layer_of(mesh, of.box, a);
            const std::size_t field = 2 * a + (weighs ? 2 : 1);
            const double mean = sum(field) / units;
            const double square = std::ldexp(sum(field + 1), weight_bits - square_bits) / units;
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
