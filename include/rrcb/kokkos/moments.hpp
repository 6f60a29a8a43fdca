#pragma once

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

/// Layers of a mesh along an axis, in scaled lengths.
struct Layers {
    double scale;
    double lower;  ///< of the frame
    double per_length;
    double below_number;  ///< greatest double below the number of layers
    std::int32_t number;
    const double* middles;   ///< of each layer
    const double* per_side;  ///< reciprocal of its thickness
};

/// Adds up the moments of points about the middle of their cell, in units of its sides.
template <class T, class W>
struct MomentsBody {
    Positions<T> x;
    Weights<W> weights;
    Layers layers[max_dimension];
    std::int64_t num_cells;
    int first_axis;  ///< of the axes to sum; with axis 0 come counts, and weights if there are any
    int num_axes;

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        double offset[max_dimension] = {};
        std::int64_t bin = 0;
        for (int a = max_dimension; a-- > 0;)
            if (a < x.dimension) bin = bin * layers[a].number + find_layer(i, a, offset[a]);
        const double weight = weights.values == nullptr ? 1 : weights.relative(i);
        if (first_axis == 0) {
            bins.add(bin, 1);
            bin += num_cells;
            if (weights.values != nullptr) {
                bins.add(bin, to_units(weight, weight_bits));
                bin += num_cells;
            }
        }
        for (int a = 0; a < max_dimension; ++a) {
            if (a < first_axis || a >= first_axis + num_axes) continue;
            const double first = weight * offset[a];
            bins.add(bin, to_units(first, weight_bits));
            bins.add(bin + num_cells, to_units(first * offset[a], square_bits));
            bin += 2 * num_cells;
        }
    }

  private:
    /// Returns the layer of a point, and its offset from the middle.
    KOKKOS_INLINE_FUNCTION std::int32_t find_layer(std::int64_t i, int axis, double& offset) const {
        const Layers& of = layers[axis];
        const double value = x(i, axis) * of.scale;
        double place = (value - of.lower) * of.per_length;
        place = place < of.below_number ? place : of.below_number;
        const auto layer = static_cast<std::int32_t>(place > 0 ? place : 0);
        offset = (value - of.middles[layer]) * of.per_side[layer];
        offset = offset > -0.5 ? offset : -0.5;
        offset = offset < 0.5 ? offset : 0.5;
        return layer;
    }
};

/// Sums over the points of each cell, relative to its middle and its sides.
struct CellSums {
    std::vector<double> counts{};
    std::vector<double> weights{};                             ///< in units; empty: the counts
    std::array<std::vector<double>, max_dimension> firsts{};   ///< in units
    std::array<std::vector<double>, max_dimension> squares{};  ///< in units
};

/// Middles and sides of the layers of a mesh along each axis, in scaled lengths.
struct LayerTable {
    std::array<std::vector<double>, max_dimension> middles{};
    std::array<std::vector<double>, max_dimension> sides{};
    std::vector<double> packed{};  ///< for each axis the middles, then the reciprocals of the sides
};

inline LayerTable layers_of(const SupportMesh& mesh) {
    LayerTable table;
    LocalIndex stride = 1;
    for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
        std::vector<double> reciprocals;
        for (int k = 0; k < mesh.cells[a]; ++k) {
            const Box box = cell_box(mesh, static_cast<LocalIndex>(k) * stride);
            const double lower = box.lower[a] * mesh.scale[a];
            const double upper = box.upper[a] * mesh.scale[a];
            table.middles[a].push_back(lower / 2 + upper / 2);
            table.sides[a].push_back(upper - lower);
            reciprocals.push_back(upper > lower ? std::min(1 / (upper - lower), DBL_MAX) : 0);
        }
        stride *= static_cast<LocalIndex>(mesh.cells[a]);
        const auto& middles = table.middles[a];
        table.packed.insert(table.packed.end(), middles.begin(), middles.end());
        table.packed.insert(table.packed.end(), reciprocals.begin(), reciprocals.end());
    }
    return table;
}

/// Describes the layers to a kernel; `packed` is on the device.
inline void set_layers(const SupportMesh& mesh, const double* packed,
                       Layers (&layers)[max_dimension]) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
        const auto number = static_cast<std::int32_t>(mesh.cells[a]);
        layers[a] = {mesh.scale[a],
                     mesh.frame.lower[a] * mesh.scale[a],
                     mesh.cells_per_length[a],
                     std::nextafter(mesh.cells[a], 0),
                     number,
                     packed,
                     packed + number};
        packed += 2 * number;
    }
}

/// Adds up all axes at once if a team has scratch for so many sums, else one after the other. A
/// fence each time.
template <class Memory, class Execution, class T, class W>
CellSums sums_of_cells(const Execution& exec, MomentsBody<T, W> body) {
    CellSums sums;
    const int dimension = body.x.dimension;
    const bool weighs = body.weights.values != nullptr;
    const std::int64_t head = weighs ? 2 : 1;
    const bool at_once = fits_scratch(exec, (head + 2 * dimension) * body.num_cells) ||
                         !fits_scratch(exec, (head + 2) * body.num_cells);
    body.num_axes = at_once ? dimension : 1;
    for (body.first_axis = 0; body.first_axis < dimension; body.first_axis += body.num_axes) {
        const std::int64_t fields = (body.first_axis == 0 ? head : 0) + 2 * body.num_axes;
        const std::vector<double> all = sum_in_bins<Memory>(
            exec, body.x.count, fields * body.num_cells, {}, [&](Word*) { return body; });
        auto next = all.begin();
        const auto take = [&](std::vector<double>& to) {
            to.assign(next, next + body.num_cells);
            next += body.num_cells;
        };
        if (body.first_axis == 0) take(sums.counts);
        if (body.first_axis == 0 && weighs) take(sums.weights);
        for (int a = body.first_axis; a < body.first_axis + body.num_axes; ++a) {
            take(sums.firsts[static_cast<std::size_t>(a)]);
            take(sums.squares[static_cast<std::size_t>(a)]);
        }
    }
    return sums;
}

/// Returns the moments of a cell along an axis, from sums that are divided by its weight.
inline void set_axis(const LayerTable& table, std::size_t axis, std::size_t layer, double first,
                     double square, double scale, CellMoments& cell) {
    const double side = table.sides[axis][layer];
    const double mean = (table.middles[axis][layer] + first * side) / scale;
    cell.moments.mean[axis] = std::clamp(mean, cell.box.lower[axis], cell.box.upper[axis]);
    cell.moments.deviation[axis] = std::sqrt(std::max(0.0, square - first * first)) * side / scale;
}

/// Returns the moments of every cell that holds weight, as cell_moments(): mean and deviation to
/// within 1e-6 of the sides of a cell unless its points are lighter than a millionth of the
/// heaviest; the same bits in any order of the points.
template <class Memory, class Execution, class T, class W>
std::vector<CellMoments> moments_on(const Execution& exec, const Positions<T>& x,
                                    Weights<W> weights, const SupportMesh& mesh) {
    const LayerTable table = layers_of(mesh);
    const auto packed = copy_in<Memory>(exec, std::span<const double>(table.packed));
    const auto num_cells = static_cast<std::int64_t>(rrcb::num_cells(mesh));
    MomentsBody<T, W> body{x, weights, {}, num_cells, 0, 0};
    set_layers(mesh, packed.data(), body.layers);
    const CellSums sums = sums_of_cells<Memory>(exec, body);
    std::vector<CellMoments> cells;
    for (std::size_t cell = 0; cell < sums.counts.size(); ++cell) {
        const double units =
            sums.weights.empty() ? std::ldexp(sums.counts[cell], weight_bits) : sums.weights[cell];
        if (!(units > 0)) continue;
        CellMoments of{cell, cell_box(mesh, cell), {}};
        of.moments.count = static_cast<GlobalCount>(sums.counts[cell]);
        of.moments.weight = sums.weights.empty() ? sums.counts[cell] : weights.from_units(units);
        std::size_t rest = cell;
        for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
            const auto number = static_cast<std::size_t>(mesh.cells[a]);
            set_axis(table, a, rest % number, sums.firsts[a][cell] / units,
                     std::ldexp(sums.squares[a][cell], weight_bits - square_bits) / units,
                     mesh.scale[a], of);
            rest /= number;
        }
        cells.push_back(of);
    }
    return cells;
}

}  // namespace rrcb::detail
