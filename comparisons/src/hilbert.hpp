#pragma once

#include <rrcb/points.hpp>

#include <cstdint>

namespace comparisons {

/// Levels of the curve: bits per axis, so that there are 2^16 or 2^18 cells in all.
constexpr int hilbert_bits(int dimension) {
    return dimension == 2 ? 8 : 6;
}

/// Number of cells along the curve.
constexpr std::size_t hilbert_cells(int dimension) {
    return std::size_t{1} << (hilbert_bits(dimension) * dimension);
}

/// Place on the Hilbert curve through `box`, 0 ... hilbert_cells - 1, of a position inside it.
///
/// Skilling: Programming the Hilbert curve (2004).
std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension);

}  // namespace comparisons
