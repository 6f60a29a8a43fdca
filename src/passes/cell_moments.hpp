#pragma once

#include <rrcb/method/moments.hpp>

#include <vector>

namespace rrcb {

/// Returns the moments of cells as cell_moments(), of points that are not checked. One pass, or two
/// if the first point of a cell is far off.
std::vector<CellMoments> moments_of_cells(const Points& points, const SupportMesh& mesh);

}  // namespace rrcb
