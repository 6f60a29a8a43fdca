#pragma once

#include <rrcb/method/support_mesh.hpp>
#include <rrcb/options.hpp>
#include <rrcb/passes.hpp>

namespace rrcb {

/// Returns the cells per axis of a rank's mesh if the options leave it open: several for each part,
/// at little cost compared with the points, and not nearly empty.
int automatic_cells_per_axis(int dimension, LocalIndex num_points, const Options& options);

/// Returns the support mesh of the options over the box of the points, of which it reads a few
/// hundred. It resolves most of them, however far a few are. Not collective.
SupportMesh mesh_by_options(PointPasses& points, const Box& box, const Options& options);

}  // namespace rrcb
