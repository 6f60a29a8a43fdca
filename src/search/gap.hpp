#pragma once

#include <rrcb/cuts.hpp>

#include <span>

namespace rrcb {

/// Moves a cut to the middle of its Gap; `num_axes` of them may break ties. With points on one side
/// only it moves next to these.
void centre(Cut& cut, int num_axes, std::span<const double> gap);

/// Returns the middle of two coordinates, or `above` if no double is between them.
double middle_of(double below, double above);

}  // namespace rrcb
