#pragma once

#include "search/fragments.hpp"

#include <array>
#include <span>

namespace rrcb {

/// The gap between the points on both sides of a cut; ranks join gaps by the maximum of each entry.
///
/// Along the axis number k of its order of positions, entry 2 k is minus the smallest coordinate
/// above the cut and entry 2 k + 1 the largest below. Only points exactly at the cut along the axes
/// before count; without any the entry is -infinity.
using Gap = std::array<double, 2 * max_dimension>;

/// Narrows a gap by the points of the fragments, except those in cells that are left out.
void narrow(const Cut& cut, std::span<const Fragment> fragments, const SortedPoints& points,
            Gap& gap);

/// Moves a cut to the middle of its gap; `num_axes` of them may break ties. With points on one side
/// only it moves next to these.
void centre(Cut& cut, int num_axes, std::span<const double> gap);

/// Returns the middle of two coordinates, or `above` if no double is between them.
double middle_of(double below, double above);

}  // namespace rrcb
