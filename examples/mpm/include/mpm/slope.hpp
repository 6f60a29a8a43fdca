#pragma once

#include <mpm/scene.hpp>

namespace mpm {

/// Cells across the slope's 110 m at the size of the paper; see slope_scene.
inline constexpr int paper_slope_cells = 116;

/// A slope too steep for its strength: it fails and runs out.
///
/// Crest at y = 20 m from x = 0 to 30, a 45 degree face to the toe at (50, 0), ground to x = 110,
/// base at y = -15; rollers at the sides, fixed base, gravity applied at once as in the paper.
/// Each cell holds 5 x 4 points. With 116 cells across, of 0.948 m, there are 54,464 points. No
/// other whole number of cells with a nearly square lattice comes nearer to the paper's 54,440.
/// They fill 99.95 % of the exact area.
Scene slope_scene(int cells_across = paper_slope_cells);

}  // namespace mpm
