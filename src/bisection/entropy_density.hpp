#pragma once

#include "bisection/cell_density.hpp"

#include <vector>

namespace rrcb {

/// Returns the density of greatest entropy on [lower, upper] with this mean and deviation, exp(a +
/// b x + c x^2), as a few pieces that keep its moments. For heavy cells, which are cut more than
/// once. If it is almost quadratic, or not found, returns density_of().
///
/// Jaynes: Information theory and statistical mechanics (1957).
std::vector<DensityPiece> entropy_density_of(double mean, double deviation, double lower,
                                             double upper);

}  // namespace rrcb
