#pragma once

#include <rrcb/detail/moments.hpp>
#include <rrcb/detail/support_mesh.hpp>
#include <rrcb/experimental/kokkos/points.hpp>
#include <rrcb/experimental/kokkos/sums.hpp>

namespace rrcb::detail {

/// Adds up the weights of all points in one bin.
template <class W>
struct AddWeights {
    static constexpr int fields = 1;

    Weights<W> weights;

    KOKKOS_INLINE_FUNCTION Row<fields> operator()(std::int64_t i) const {
        return {0, {weights.units(i)}};
    }
};

/// A layer of a mesh along an axis, in scaled lengths.
struct Layer {
    double middle;
    double per_length;  ///< reciprocal of the side
};

/// The layers of a mesh along an axis, for a kernel, in scaled lengths.
struct Layers {
    double scale;
    double lower;  ///< lower end of the frame
    double per_length;
    std::int32_t number;
    const Layer* first;

    /// Returns the layer of a coordinate, and writes its offset from the middle in units of the
    /// side.
    KOKKOS_INLINE_FUNCTION std::int32_t find(double coordinate, double& offset) const {
        const double value = coordinate * scale;
        const double place = (value - lower) * per_length;
        std::int32_t layer = number - 1;
        if (place < number) layer = static_cast<std::int32_t>(place > 0 ? place : 0);
        offset = (value - first[layer].middle) * first[layer].per_length;
        offset = offset > -0.5 ? offset : -0.5;
        offset = offset < 0.5 ? offset : 0.5;
        return layer;
    }
};

/// Returns the number of sums of a cell.
constexpr int fields_of_cell(int dimension, bool weighs) {
    return 2 * dimension + (weighs ? 2 : 1);
}

/// Sums over the points in the cells of a mesh: for each axis, the first and second moments about
/// the middle of the cell; then the number of points, and their weight if they have weights.
template <class Positions, class W, bool Weighs>
struct AddMoments {
    static constexpr int dimension = Positions::dimension;
    static constexpr int fields = fields_of_cell(dimension, Weighs);

    Positions x;
    Weights<W> weights;
    Layers layers[max_dimension];

    KOKKOS_INLINE_FUNCTION Row<fields> operator()(std::int64_t i) const {
        double offset[dimension];
        std::int64_t cell = 0;
        for (int a = dimension; a-- > 0;)
            cell = cell * layers[a].number + layers[a].find(x(i, a), offset[a]);
        Row<fields> row{cell * fields, {}};
        const double weight = Weighs ? weights.relative(i) : 1.0;
        for (int a = 0; a < dimension; ++a) {
            const double first = weight * offset[a];
            row.values[2 * a] = to_units(first, weight_bits);
            row.values[2 * a + 1] = to_units(first * offset[a], square_bits);
        }
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
            const Box cell = cell_box(mesh, static_cast<LocalIndex>(k) * stride);
            const double lower = cell.lower[a] * mesh.scale[a];
            const double upper = cell.upper[a] * mesh.scale[a];
            all.push_back({lower / 2 + upper / 2,
                           upper > lower ? std::min(1 / (upper - lower), DBL_MAX) : 0});
        }
        stride *= static_cast<LocalIndex>(mesh.cells[a]);
    }
    return all;
}

/// Returns the moments of every cell that has weight, as cell_moments(). Mean and deviation are
/// accurate to 1e-6 of the sides of a cell, unless its points are lighter than a millionth of the
/// heaviest. They are bit-identical for any order of the points. Ends with a fence.
template <bool Weighs, class Device, class Positions, class W>
std::vector<CellMoments> moments_on(Device& device, const Positions& x, const Weights<W>& weights,
                                    const SupportMesh& mesh) {
    using Rows = AddMoments<Positions, W, Weighs>;
    Rows rows{x, weights, {}};
    const std::vector<Layer> layers = layers_of(mesh, rows.layers);
    const auto on_device = device.copy_in(layers);
    const Layer* first = on_device.data();
    for (int a = 0; a < mesh.dimension; first += rows.layers[a++].number)
        rows.layers[a].first = first;
    const auto num_bins = static_cast<std::int64_t>(num_cells(mesh)) * Rows::fields;
    const std::vector<double> sums = sum_in_bins(device, x.count, num_bins, rows);
    std::vector<CellMoments> cells;
    for (auto sum = sums.begin(); sum != sums.end(); sum += Rows::fields) {
        const double count = sum[2 * Rows::dimension];
        const double units = Weighs ? sum[Rows::fields - 1] : std::ldexp(count, weight_bits);
        if (!(units > 0)) continue;
        const auto cell = static_cast<LocalIndex>((sum - sums.begin()) / Rows::fields);
        CellMoments of{cell, cell_box(mesh, cell), {}};
        of.moments.count = static_cast<GlobalCount>(count);
        of.moments.weight = Weighs ? weights.from_units(units) : count;
        for (std::size_t a = 0; a < Rows::dimension; ++a) {
            const double lower = of.box.lower[a];
            const double upper = of.box.upper[a];
            const double half = upper / 2 - lower / 2;
            const double mean = sum[2 * a] / units;
            const double square = std::ldexp(sum[2 * a + 1], weight_bits - square_bits) / units;
            of.moments.mean[a] = std::clamp(lower / 2 + upper / 2 + 2 * mean * half, lower, upper);
            of.moments.deviation[a] = 2 * std::sqrt(std::max(0.0, square - mean * mean)) * half;
        }
        cells.push_back(of);
    }
    return cells;
}

}  // namespace rrcb::detail
