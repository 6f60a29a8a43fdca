#pragma once

#include <rrcb/passes.hpp>

#include <span>
#include <vector>

// The extent of the points of a rank, or of several: count, weight, first and last of a summary.

namespace rrcb {

/// Adds the points of another extent.
void join(PointSummary& extent, const PointSummary& other, int dimension);

/// Appends an extent as 2 + 2 dimension^2 doubles.
void append_extent(PointSummary extent, int dimension, std::vector<double>& doubles);

/// Returns the extents in the order appended.
std::vector<PointSummary> read_extents(std::span<const double> doubles, int dimension);

}  // namespace rrcb
