#pragma once

#include <rrcb/detail/passes.hpp>
#include <rrcb/detail/support_mesh.hpp>
#include <rrcb/options.hpp>

namespace rrcb {

/// Returns the number of cells per axis of a rank's mesh if the options do not set it: several
/// cells for each part, few enough to cost little compared with the points and not to be nearly
/// empty.
int automatic_cells_per_axis(int dimension, LocalIndex num_points, const Options& options);

/// Returns the support mesh of the options over the box of the points. It resolves most of the
/// points, however far away a few are; for this it reads a few hundred of them. Not collective.
SupportMesh mesh_by_options(PointPasses& points, const Box& box, const Options& options);

}  // namespace rrcb
