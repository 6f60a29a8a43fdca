#pragma once

#include <rrcb/method/support_mesh.hpp>
#include <rrcb/passes.hpp>

namespace rrcb {

/// Returns a support mesh whose layers resolve most of the points, however far a few of them are.
///
/// Along an axis on which a sample of the points spans far less than their box, the layers divide
/// the span of the sample without its ends, and a margin; the outermost two reach to the box. Other
/// axes are as in make_support_mesh(). Reads a few hundred positions. Not collective.
SupportMesh make_framed_mesh(PointPasses& points, const Box& box, int cells_per_axis);

}  // namespace rrcb
