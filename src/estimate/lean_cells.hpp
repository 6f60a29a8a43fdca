#pragma once

#include <rrcb/method/moments.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

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

/// Appends the cells that were packed, without their counts. `packed` may contain more after them.
void unpack_cells(int exponent, std::span<const std::byte> packed, std::size_t count,
                  const SupportMesh& mesh, std::vector<CellMoments>& cells);

}  // namespace rrcb
