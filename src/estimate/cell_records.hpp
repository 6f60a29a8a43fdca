#pragma once

#include <rrcb/detail/moments.hpp>
#include <rrcb/detail/statistical_domain.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Appends the coordinates of a vector.
void append_vector(const Vector& x, int dimension, std::vector<double>& records);

/// Removes doubles from the front of `records` and returns them.
std::span<const double> take(std::span<const double>& records, std::size_t count);

/// Removes a vector from the front of `records` and returns it. Components beyond the dimension are
/// 0.
Vector take_vector(std::span<const double>& records, int dimension);

/// Cells of several ranks: cells of their support meshes, or of a lattice.
///
/// The lattice with exponent e divides all of space into cubes with edge length 2^e and corners at
/// multiples of 2^e. A cube of a lattice is therefore a union of cubes of any lattice with a
/// smaller exponent.
struct CellSet {
    std::vector<CellMoments> cells;
    int exponent = no_lattice;  ///< largest exponent of the lattices on which cells were merged

    static constexpr int no_lattice = std::numeric_limits<int>::min();
};

/// Cells of a support mesh in packed form, in the order of their numbers. A cell takes 8 bytes in
/// 2-D, plus one or more bytes for every gap in the numbers. The weight before a gap has its sign
/// changed.
///
/// Along each axis one byte contains the mean, in 255ths of the cell. Another byte contains the
/// standard deviation, in half extents of the cell: its square root in 255ths, or its logarithm if
/// it is below 1/16, down to 3e-13. Only a deviation of 0 is packed as 0; then a mean on a face of
/// the cell remains there. Weights are floats in units of 2^exponent. They have 24 digits down to
/// 1e-38 of the heaviest cell; only 0 is packed as 0.
struct LeanCells {
    int exponent = 0;
    std::vector<std::byte> bytes{};
};

LeanCells pack_cells(std::span<const CellMoments> cells, const SupportMesh& mesh);

/// Appends the unpacked cells to `cells`, without their counts. `packed` may be longer than the
/// cells.
void unpack_cells(int exponent, std::span<const std::byte> packed, std::size_t count,
                  const SupportMesh& mesh, std::vector<CellMoments>& cells);

/// Appends the cells of a support mesh to the records for the root in the form of LeanCells: the
/// moments are rounded and take an eighth of the doubles. Weights are in units of `unit`.
void append_lean_cells(std::span<const CellMoments> cells, const SupportMesh& mesh, double unit,
                       std::vector<double>& records);

/// Appends cells merged on the lattice of their exponent.
void append_cells(const CellSet& merged, int dimension, double unit, std::vector<double>& records);

/// Returns the cells in the order in which they were appended. The box of a lattice's cell is the
/// cube of its mean; along an axis it is mean +- sqrt(3) sigma if that is wider. If `in_units`,
/// weights are not multiplied by their unit.
CellSet read_cells(std::span<const double> records, int dimension, bool in_units);

/// Returns the cube of the lattice that contains a position, in units of the edge length.
Vector cube_of(const Vector& position, int dimension, int exponent);

/// Returns the exponent of the finest lattice worth trying. Its edge is the value of the last
/// binary digit of the largest coordinate of the means.
int last_digit(std::span<const CellMoments> cells, int dimension);

/// Merges cells on the finest lattice on which at most `most` (>= 8) are left. The result is in the
/// order of this lattice.
///
/// The lattice is never finer than one on which the cells were merged before. The same cells in the
/// same order give bit-identical results. Not collective.
CellSet coarsen(const CellSet& set, int dimension, std::size_t most);

}  // namespace rrcb
