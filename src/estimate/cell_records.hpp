#pragma once

#include <rrcb/method/moments.hpp>
#include <rrcb/method/statistical_domain.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Appends the coordinates of a vector.
void append_vector(const Vector& x, int dimension, std::vector<double>& records);

/// Takes doubles off the front.
std::span<const double> take(std::span<const double>& records, std::size_t count);

/// Takes a vector off the front; 0 beyond the dimension.
Vector take_vector(std::span<const double>& records, int dimension);

/// Cells of several ranks, of their support meshes or of a lattice.
///
/// The lattice of an exponent e divides all of space into cubes with edges of 2^e and corners at
/// multiples of 2^e. The cubes of a greater exponent are therefore unions of those of a smaller
/// one.
struct CellSet {
    std::vector<CellMoments> cells;
    int exponent = no_lattice;  ///< the greatest among the lattices of merged cells

    static constexpr int no_lattice = std::numeric_limits<int>::min();
};

/// Packs the cells of a support mesh, in the order of their numbers: 8 bytes each in 2-D, and one
/// or more for every gap in the numbers. The weight before a gap has its sign changed.
///
/// Along each axis one byte holds the mean, in 255ths of the cell. Another holds the deviation, in
/// half extents of the cell: its root in 255ths, or below 1/16 its logarithm, down to 3e-13. Only a
/// deviation of 0 is packed as 0; a mean on a face then stays there. Weights are floats in units of
/// 2^exponent, of 24 digits down to 1e-38 of the heaviest; only 0 is packed as 0.
struct LeanCells {
    int exponent = 0;
    std::vector<std::byte> bytes{};
};

LeanCells pack_cells(std::span<const CellMoments> cells, const SupportMesh& mesh);

/// Appends the packed cells, without their counts. `packed` may contain more after them.
void unpack_cells(int exponent, std::span<const std::byte> packed, std::size_t count,
                  const SupportMesh& mesh, std::vector<CellMoments>& cells);

/// Appends the cells of a support mesh to the records for the root, as LeanCells: rounded moments
/// in an eighth of the doubles. Their weights are in units of `unit`.
void append_lean_cells(std::span<const CellMoments> cells, const SupportMesh& mesh, double unit,
                       std::vector<double>& records);

/// Appends cells merged on the lattice of their exponent.
void append_cells(const CellSet& merged, int dimension, double unit, std::vector<double>& records);

/// Returns the cells in the order appended. The box of a lattice's cell is the cube of its mean, or
/// along an axis mean +- sqrt(3) sigma if that is wider. `in_units`: weights are not multiplied by
/// their unit.
CellSet read_cells(std::span<const double> records, int dimension, bool in_units);

/// Returns the cube of a position on the lattice of `exponent`, in units of its edge.
Vector cube_of(const Vector& position, int dimension, int exponent);

/// Returns the finest lattice worth trying: that of the last binary digits of the greatest
/// coordinate of the means.
int last_digit(std::span<const CellMoments> cells, int dimension);

/// Merges cells on the finest lattice on which at most `most` (>= 8) are left, in its order.
///
/// The lattice is never finer than one on which they were merged before. The same cells in the same
/// order give the same bits. Not collective.
CellSet coarsen(const CellSet& set, int dimension, std::size_t most);

}  // namespace rrcb
