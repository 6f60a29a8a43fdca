#pragma once

#include <rrcb/method/moments.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Packs the cells of a support mesh, in the order of their numbers: 8 bytes each in 2-D, and a few
/// for every gap in the numbers.
///
/// Along each axis one byte for the mean, in 255ths of the cell, and one for the deviation, in half
/// extents of the cell: its root in 255ths, or below 1/16 its logarithm, down to 3e-13. A
/// deviation is 0 only where it was; then a mean on a face stays there. Weights are floats in units
/// of 2^exponent, of 24 digits down to 1e-38 of the heaviest, and not 0 where they were not. Where
/// none has weight the counts are packed in their place.
struct LeanCells {
    bool are_counts = false;
    int exponent = 0;
    std::vector<std::byte> bytes{};
};

LeanCells pack_cells(std::span<const CellMoments> cells, const SupportMesh& mesh);

/// Appends the cells that were packed. `packed` may go on behind them. The count of a cell is known
/// only where it was packed, else 0.
void unpack_cells(const LeanCells& head, std::span<const std::byte> packed, std::size_t count,
                  const SupportMesh& mesh, std::vector<CellMoments>& cells);

}  // namespace rrcb
