#pragma once

#include "arithmetic/uninitialized.hpp"
#include "passes/binned_points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

/// Copy of one rank's points in the order of the cells of its support mesh.
///
/// Points of one cell keep the order they came in. Cell c holds the entries begins[c] up to, not
/// including, begins[c + 1]. Entries of cells that are left out are not written.
struct SortedPoints {
    SupportMesh mesh;
    Uninitialized<double> coordinates;     ///< interleaved
    Uninitialized<double> weights;         ///< empty when every point weighs 1
    Uninitialized<LocalIndex> original;    ///< index of each entry before
    std::vector<LocalIndex> begins;        ///< length num_cells + 1
    std::vector<std::uint8_t> is_sorted;   ///< 1 for each sorted cell; empty: all are
    const BinnedPoints* binned = nullptr;  ///< borrowed if cells are or were left out
    std::vector<double> cell_weights;      ///< likewise; empty when every point weighs 1

    bool is_left_out(LocalIndex cell) const { return !is_sorted.empty() && is_sorted[cell] == 0; }
    int dimension() const { return mesh.dimension; }
    LocalIndex count() const { return original.size(); }
    double weight(LocalIndex i) const { return weights.empty() ? 1.0 : weights[i]; }
    double coordinate(LocalIndex i, int axis) const {
        return coordinates[i * static_cast<LocalIndex>(mesh.dimension) +
                           static_cast<LocalIndex>(axis)];
    }
    Vector position(LocalIndex i) const {
        Vector x{};
        for (int a = 0; a < mesh.dimension; ++a) x[static_cast<std::size_t>(a)] = coordinate(i, a);
        return x;
    }
};

/// Copies binned points in the order of the cells, in one pass, into `memory`. If `is_sorted` is
/// not empty, leaves out the cells for which it is 0 and borrows `binned`. Not collective.
SortedPoints sort_by_cell(const BinnedPoints& binned, SortedPoints memory = {},
                          std::vector<std::uint8_t> is_sorted = {});

/// Sorts the points of the cells that were left out. Throws std::bad_alloc.
void sort_rest(SortedPoints& points);

/// Writes the parts of all points except those of cells with no_part in `parts_of_cells`.
void write_parts_of_cells(const BinnedPoints& binned, std::span<const Part> parts_of_cells,
                          std::span<Part> parts);

/// Returns the box that holds the points sorted into a cell: the cell with a margin for the
/// round-off of finding it. Not collective.
Box enclosing_box(const SupportMesh& mesh, LocalIndex cell);

}  // namespace rrcb
